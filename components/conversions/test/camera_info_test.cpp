// SPDX-License-Identifier: Apache-2.0
#include "panvo/conversions/camera_info.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace panvo::conversions {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

vision::StereoCalibration raw_pair() {
  vision::StereoCalibration pair;
  pair.left.pinhole = {400, 401, 320, 240, 640, 480};
  pair.right.pinhole = {402, 403, 318, 242, 640, 480};
  pair.left.distortion = {-0.3, 0.1, 0.001, -0.002, 0.01};
  pair.right_from_left.linear() = Eigen::AngleAxisd(0.02, Eigen::Vector3d(0.3, 1, 0.2).normalized()).toRotationMatrix();
  pair.right_from_left.translation() = Eigen::Vector3d(-0.12, 0.001, -0.002);
  return pair;
}

sensor_msgs::msg::CameraInfo right_info() {
  const auto pair = raw_pair();
  return to_camera_info(right_camera(pair, vision::rectify(pair)), 42, "right");
}

TEST(CameraInfo, ComesBackAsItWas) {
  const auto pair = raw_pair();
  const auto rectified = vision::rectify(pair);
  const auto left = left_camera(pair, rectified);
  const auto right = right_camera(pair, rectified);
  EXPECT_TRUE(*to_camera(to_camera_info(left, 0, "left")) == left);
  const auto stereo =
      to_stereo(*to_camera(to_camera_info(left, 0, "left")), *to_camera(to_camera_info(right, 0, "right")));
  ASSERT_TRUE(stereo);
  EXPECT_NEAR(stereo->baseline_m, rectified.baseline_m, 1e-12);
  EXPECT_TRUE(stereo->rectified_right_from_right.isApprox(rectified.rectified_right_from_right));
}

TEST(CameraInfo, HasRosMeaningOfP) {
  const auto pair = raw_pair();
  const auto rectified = vision::rectify(pair);
  const auto info = right_info();
  EXPECT_DOUBLE_EQ(info.p()[3], -rectified.camera.fx * rectified.baseline_m);
  EXPECT_LT(info.p()[3], 0.0);
  EXPECT_EQ(to_camera_info(left_camera(pair, rectified), 0, "left").p()[3], 0.0);
  EXPECT_EQ(info.k()[0], 402.0);
  EXPECT_EQ(info.distortion_model(), "plumb_bob");
  EXPECT_EQ(info.d().size(), 5u);
}

TEST(CameraInfo, SaysWhyItCannotBeUsed) {
  const auto reason = [](auto change) {
    auto info = right_info();
    change(info);
    const auto camera = to_camera(info);
    EXPECT_FALSE(camera);
    return camera.reason();
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(reason([](auto& i) { i.k({}); }), AllOf(HasSubstr("not calibrated"), HasSubstr("calibrate")));
  EXPECT_THAT(reason([](auto& i) { i.p({}); }), HasSubstr("as a stereo pair"));
  EXPECT_THAT(reason([](auto& i) { i.r({}); }), HasSubstr("as a stereo pair"));
  EXPECT_THAT(reason([](auto& i) { i.r({2, 0, 0, 0, 1, 0, 0, 0, 1}); }), HasSubstr("not a rotation"));
  EXPECT_THAT(reason([](auto& i) { i.k()[2] = kNan; }), HasSubstr("not a number"));
  EXPECT_THAT(reason([](auto& i) { i.d()[1] = kNan; }), HasSubstr("not a number"));
  EXPECT_THAT(reason([](auto& i) {
                i.distortion_model("division");
                i.d({0.1, 0, 0, 0});
              }),
              HasSubstr("'division'"));
  EXPECT_THAT(reason([](auto& i) { i.d({0.1, 0, 0, 0, 0, 0.2, 0, 0}); }), HasSubstr("plumb_bob"));
  EXPECT_THAT(reason([](auto& i) { i.binning_x(2); }), HasSubstr("binning"));
}

TEST(CameraInfo, MayLeaveOutTheDistortionOfAPerfectLens) {
  auto info = right_info();
  info.d().clear();
  info.distortion_model("");
  EXPECT_TRUE(to_camera(info));
}

TEST(CameraInfo, ComesBackAsItWasWhateverTheLens) {
  const auto pair = raw_pair();
  auto camera = right_camera(pair, vision::rectify(pair));
  camera.raw.model = vision::LensModel::kEquidistant;
  camera.raw.distortion = {0.1, -0.02, 0.003, 0.0004};
  const auto fisheye = to_camera_info(camera, 0, "right");
  EXPECT_EQ(fisheye.distortion_model(), "equidistant");
  EXPECT_EQ(fisheye.d().size(), 4u);
  EXPECT_TRUE(*to_camera(fisheye) == camera);
  camera.raw.model = vision::LensModel::kMei;
  camera.raw.distortion[4] = 1.1;
  EXPECT_TRUE(*to_camera(to_camera_info(camera, 0, "right")) == camera);
  auto other = camera;
  other.raw.distortion[4] = 1.2;
  EXPECT_FALSE(other == camera);
  camera.raw = {camera.raw.pinhole, vision::LensModel::kRational, {0.1, 0.2, 0.0, 0.0, 0.3, 0.4, 0.5, 0.6}};
  EXPECT_TRUE(*to_camera(to_camera_info(camera, 0, "right")) == camera);
}

TEST(CameraPair, NeedsABaselineAndOneRectifiedCamera) {
  const auto pair = raw_pair();
  const auto rectified = vision::rectify(pair);
  const auto left = left_camera(pair, rectified);
  EXPECT_THAT(to_stereo(left, left).reason(), HasSubstr("baseline"));
  auto right = right_camera(pair, rectified);
  EXPECT_THAT(to_stereo(right, left).reason(), HasSubstr("swapped"));
  right.rectified.fx += 1.0;
  EXPECT_THAT(to_stereo(left, right).reason(), HasSubstr("stereo pair"));
}

TEST(RectifiedCamera, HasNothingToCorrect) {
  vision::StereoCalibration pair;
  pair.left.pinhole = pair.right.pinhole = {400, 400, 320, 240, 640, 480};
  vision::RectifiedStereo rectified;
  rectified.camera = pair.left.pinhole;
  rectified.baseline_m = 0.12;
  auto camera = right_camera(pair, rectified);
  EXPECT_TRUE(is_rectified(camera));
  camera.raw.distortion[2] = 1e-6;
  EXPECT_FALSE(is_rectified(camera));
  camera = right_camera(pair, rectified);
  camera.raw.model = vision::LensModel::kEquidistant;
  EXPECT_FALSE(is_rectified(camera)) << "a fisheye is not perspective even without distortion";
  camera = right_camera(pair, rectified);
  camera.rectified.cx += 0.1;
  EXPECT_FALSE(is_rectified(camera));
  camera = right_camera(pair, rectified);
  camera.rectified_from_raw = Eigen::AngleAxisd(1e-4, Eigen::Vector3d::UnitX()).toRotationMatrix();
  EXPECT_FALSE(is_rectified(camera));
}

}  // namespace
}  // namespace panvo::conversions
