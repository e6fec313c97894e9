// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "panvo/calibration/calibration_error.hpp"
#include "panvo/calibration/camchain_file.hpp"
#include "panvo/calibration/lens_parameters.hpp"
#include "panvo/calibration/rectified_pair.hpp"
#include "panvo/calibration/rig_file.hpp"
#include "panvo/calibration_files/camera_info.hpp"
#include "written_images.hpp"

namespace panvo::calibration {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using vision::LensModel;

class CalibrationFiles : public test::CommandTest {
 protected:
  template <class Read>
  std::string refusal(const std::string& text, Read read) const {
    folder_.write("file.yaml", text);
    try {
      read(folder_ / "file.yaml");
    } catch (const calibration_files::FileError& error) {
      return error.what();
    }
    return "read";
  }
};

constexpr const char* kCamchain = R"(cam0:
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [-0.28, 0.07, 0.0001, 0.0002]
  distortion_model: radtan
  intrinsics: [458.6, 457.3, 367.2, 248.4]
  resolution: [752, 480]
  rostopic: /cam0/image_raw
cam1:
  T_cn_cnm1:
  - [1.0, 0.0, 0.0, -0.11]
  - [0.0, 1.0, 0.0, 0.0]
  - [0.0, 0.0, 1.0, 0.0]
  - [0.0, 0.0, 0.0, 1.0]
  cam_overlaps: [0, 2]
  camera_model: omni
  distortion_coeffs: [-0.1, 0.03, 0.0001, 0.0002]
  distortion_model: radtan
  intrinsics: [1.2, 420.0, 421.0, 360.0, 240.0]
  resolution: [752, 480]
cam2:
  T_cn_cnm1: [[0, 0, -1, 0.0], [0, 1, 0, 0], [1, 0, 0, 0.5], [0, 0, 0, 1]]
  camera_model: pinhole
  distortion_coeffs: [0.01, 0.02, 0.003, 0.004]
  distortion_model: equidistant
  intrinsics: [300.0, 301.0, 360.0, 240.0]
  resolution: [752, 480]
)";

std::string without(std::string text, const std::string& part, const std::string& instead = "") {
  return text.replace(text.find(part), part.size(), instead);
}

TEST_F(CalibrationFiles, ReadACamchain) {
  folder_.write("chain.yaml", kCamchain);
  const auto cameras = read_camchain(folder_ / "chain.yaml");
  ASSERT_THAT(cameras, SizeIs(3));
  EXPECT_EQ(cameras[0].camera.lens.model, LensModel::kPlumbBob);
  EXPECT_EQ(cameras[0].camera.lens.distortion[3], 0.0002);
  EXPECT_EQ(cameras[0].camera.lens.pinhole.width, 752);
  EXPECT_EQ(cameras[1].camera.lens.model, LensModel::kMei);
  EXPECT_EQ(cameras[1].camera.lens.distortion[4], 1.2);
  EXPECT_EQ(cameras[1].camera.lens.pinhole.fy, 421.0);
  EXPECT_EQ(cameras[2].camera.lens.model, LensModel::kEquidistant);
  EXPECT_EQ(cameras[1].camera.camera_from_reference.translation().x(), -0.11);
  // T_cn_cnm1 of cam2 maps cam1's origin offset of -0.11 m along x to z, plus 0.5 m
  EXPECT_TRUE(
      cameras[2].camera.camera_from_reference.translation().isApprox(Eigen::Vector3d(0.0, 0.0, 0.5 - 0.11), 1e-12));
}

TEST_F(CalibrationFiles, WriteTheCamchainTheyRead) {
  folder_.write("chain.yaml", kCamchain);
  const auto cameras = read_camchain(folder_ / "chain.yaml");
  folder_.write("again.yaml", camchain_text(cameras));
  const auto again = read_camchain(folder_ / "again.yaml");
  ASSERT_THAT(again, SizeIs(3));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(lens_parameters(again[i].camera.lens).isApprox(lens_parameters(cameras[i].camera.lens), 1e-11));
    EXPECT_TRUE(again[i].camera.camera_from_reference.isApprox(cameras[i].camera.camera_from_reference, 1e-9));
  }
  EXPECT_THROW(camchain_text({{"left", {test::lens(LensModel::kRational, 400.0, {1, 2, 3, 4, 5, 6, 7, 8})}}}),
               CalibrationError);
  EXPECT_THROW(camchain_text({{"left", {test::lens(LensModel::kPlumbBob, 400.0, {1, 2, 3, 4, 5})}}}), CalibrationError);
}

TEST_F(CalibrationFiles, RefuseCamchainsWithFileLineKeyAndRemedy) {
  const auto refused = [&](const std::string& text) { return refusal(text, read_camchain); };
  EXPECT_THAT(refused(without(kCamchain, "pinhole", "eucm")),
              AllOf(HasSubstr("file.yaml:3: cam0.camera_model"), HasSubstr("'eucm'"), HasSubstr("omni")));
  EXPECT_THAT(refused(without(kCamchain, "[458.6, ", "[")),
              AllOf(HasSubstr("file.yaml:6: cam0.intrinsics"), HasSubstr("4 numbers, not of 3")));
  EXPECT_THAT(refused(without(kCamchain, "radtan", "fov")), AllOf(HasSubstr("distortion_model"), HasSubstr("'fov'")));
  EXPECT_THAT(refused(without(kCamchain, "[1.0, 0.0, 0.0, -0.11]", "[2.0, 0.0, 0.0, -0.11]")),
              HasSubstr("file.yaml:10: cam1.T_cn_cnm1 is not a rigid transform"));
  EXPECT_THAT(refused("cam1: {}\n"), AllOf(HasSubstr("file.yaml:1: cam0 is missing"), HasSubstr("camchain")));
  EXPECT_THAT(refused("cam0: 3\n"), HasSubstr("file.yaml:1: cam0 must be a map"));
  const auto both = without(without(kCamchain, "[752, 480]", "[0, 480]"), "[1.2, 420.0", "[1.2, -420.0");
  EXPECT_THAT(refused(both), AllOf(HasSubstr("file.yaml:7: cam0.resolution must be [width, height]"),
                                   HasSubstr("file.yaml:19: cam1.intrinsics must have positive focal lengths")));
}

TEST_F(CalibrationFiles, TellMountsAsTheDriversTakeThem) {
  // The second camera is 0.2 m to the right of the first, turned left by 90 degrees, then pitched up by 10.
  Eigen::Isometry3d reference_from_camera = Eigen::Isometry3d::Identity();
  reference_from_camera.translation().x() = 0.2;
  reference_from_camera.linear() = (Eigen::AngleAxisd(-90 * test::kDegree, Eigen::Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(10 * test::kDegree, Eigen::Vector3d::UnitX()))
                                       .toRotationMatrix();
  Eigen::Matrix<double, 6, 1> mount;
  mount << 0.1, 0.05, 1.2, 0.0, 0.0, 0.0;
  const auto text = extrinsics_text(
      {{"left", {test::plumb_bob()}}, {"side", {test::fisheye(), reference_from_camera.inverse()}}}, 0, mount);
  EXPECT_THAT(
      text, AllOf(HasSubstr("reference: left"), HasSubstr("mount: [0.10000, 0.05000, 1.20000, 0.0000, 0.0000, 0.0000]"),
                  HasSubstr("mount: [0.10000, -0.15000, 1.20000, 0.0000, -10.0000, 90.0000]")));
}

TEST_F(CalibrationFiles, KeepExtrinsicsAndRefuseBrokenOnes) {
  const auto truth = test::stereo_pair(test::plumb_bob());
  for (const auto& [name, camera] : {std::pair("left", truth[0]), std::pair("right", truth[1])})
    calibration_files::write_camera_info(folder_ / (std::string(name) + ".yaml"),
                                         calibration_files::single_camera_info(name, camera.lens));
  const auto text = extrinsics_text({{"left", truth[0]}, {"right", truth[1]}}, 0, Eigen::Matrix<double, 6, 1>::Zero());
  folder_.write("extrinsics.yaml", text);
  const auto back = read_extrinsics(folder_ / "extrinsics.yaml");
  ASSERT_THAT(back, SizeIs(2));
  EXPECT_TRUE(back[1].camera.camera_from_reference.isApprox(truth[1].camera_from_reference, 1e-8));
  EXPECT_EQ(back[1].camera.lens.pinhole.cx, truth[1].lens.pinhole.cx);
  EXPECT_THAT(refusal(without(text, "[1, 0, 0, 0,", "[3, 0, 0, 0,"), read_extrinsics),
              AllOf(HasSubstr("file.yaml:7: cameras[0].reference_from_camera"), HasSubstr("4 x 4")));
  EXPECT_THAT(refusal(without(text, "right.yaml", "gone.yaml"), read_extrinsics),
              HasSubstr("gone.yaml: cannot be opened"));
  EXPECT_THAT(refusal("cameras: 4\n", read_extrinsics), HasSubstr("file.yaml:1: cameras"));
}

TEST_F(CalibrationFiles, KnowWhichElevationsAreSeenAllRound) {
  const auto lens =
      test::lens(LensModel::kEquidistant, 200.0, {0, 0, 0, 0}, 640, 640);  // slightly more than 90 degrees to each side
  std::vector<NamedCamera> heads;
  for (int i = 0; i < 2; ++i)
    heads.push_back({std::to_string(i), {lens, test::camera_at({0, 0, 0}, {0.0, 180.0 * i, 0.0})}});
  const auto two = seen_elevations_deg(heads);
  ASSERT_TRUE(two);
  EXPECT_EQ(*two, std::pair(-90.0, 90.0));
  heads.pop_back();
  EXPECT_FALSE(seen_elevations_deg(heads));
}

}  // namespace
}  // namespace panvo::calibration
