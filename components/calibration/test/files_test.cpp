// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "panvo/calibration/calibration_error.hpp"
#include "panvo/calibration/camchain_file.hpp"
#include "panvo/calibration/camera_info_file.hpp"
#include "panvo/calibration/lens_parameters.hpp"
#include "panvo/calibration/rectified_pair.hpp"
#include "panvo/calibration/rig_file.hpp"
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
    } catch (const CalibrationError& error) {
      return error.what();
    }
    return "read";
  }
};

constexpr const char* kCameraInfo = R"(image_width: 640
image_height: 480
camera_matrix: {rows: 3, cols: 3, data: [400, 0, 320, 0, 400, 240, 0, 0, 1]}
distortion_model: plumb_bob
distortion_coefficients: {rows: 1, cols: 5, data: [0.1, 0, 0, 0, 0]}
)";

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

TEST_F(CalibrationFiles, KeepEveryLensAsItIs) {
  for (const auto& lens :
       {test::plumb_bob(), test::fisheye(), test::lens(LensModel::kRational, 400.0, {1, 2, 3, 4, 5, 6, 7, 8}),
        test::lens(LensModel::kMei, 400.0, {0.1, 0.2, 0.3, 0.4, 1.1})}) {
    const auto truth = test::stereo_pair(lens);
    const auto infos = stereo_camera_infos(
        truth[0].lens, truth[1].lens,
        {truth[0].lens.pinhole, 0.12, Eigen::Matrix3d::Identity(), truth[1].camera_from_reference.linear()});
    write_camera_info(folder_ / "right.yaml", infos.second);
    const auto back = read_camera_info(folder_ / "right.yaml");
    EXPECT_EQ(back.lens.model, lens.model);
    EXPECT_EQ(back.name, "right");
    EXPECT_TRUE(lens_parameters(back.lens).isApprox(lens_parameters(truth[1].lens), 1e-11));
    EXPECT_TRUE(back.rectified_from_raw.isApprox(infos.second.rectified_from_raw, 1e-11));
    EXPECT_TRUE(back.projection.isApprox(infos.second.projection, 1e-11));
    EXPECT_NEAR(back.projection(0, 3), -0.12 * lens.pinhole.fx, 1e-9);
    EXPECT_NEAR(rectified_pair(infos.first, back, "rig").baseline_m, 0.12, 1e-12);
  }
}

TEST_F(CalibrationFiles, ReadTheExampleOfTheRigs) {
  const std::filesystem::path folder = PANVO_RIGS "/example";
  const auto pair =
      rectified_pair(read_camera_info(folder / "left.yaml"), read_camera_info(folder / "right.yaml"), folder);
  EXPECT_NEAR(pair.baseline_m, 0.12, 1e-9);
  EXPECT_EQ(pair.camera.fx, 500.0);
}

TEST_F(CalibrationFiles, ReadACameraInfoOfASingleCamera) {
  folder_.write("file.yaml", kCameraInfo);
  const auto info = read_camera_info(folder_ / "file.yaml");
  EXPECT_EQ(info.name, "file");
  EXPECT_EQ(info.rectified_from_raw, Eigen::Matrix3d::Identity());
  EXPECT_EQ(info.projection(0, 0), 400.0);
}

TEST_F(CalibrationFiles, RefuseCameraInfosWithFileLineKeyAndRemedy) {
  const auto refused = [&](const std::string& text) { return refusal(text, read_camera_info); };
  EXPECT_THAT(refused(without(kCameraInfo, "image_width: 640\n")),
              AllOf(HasSubstr("file.yaml:1: image_width is missing"), HasSubstr("add it")));
  EXPECT_THAT(refused(without(kCameraInfo, "640", "wide")),
              AllOf(HasSubstr("file.yaml:1: image_width"), HasSubstr("'wide'")));
  EXPECT_THAT(refused(without(kCameraInfo, "0, 0, 1]", "0, 0]")),
              AllOf(HasSubstr("file.yaml:3: camera_matrix"), HasSubstr("9 numbers, not 8")));
  EXPECT_THAT(refused(without(kCameraInfo, "[400", "[0")),
              AllOf(HasSubstr("file.yaml:3: camera_matrix"), HasSubstr("calibrate")));
  EXPECT_THAT(refused(without(kCameraInfo, "[0.1", "[.nan")), HasSubstr("file.yaml:5: distortion_coefficients"));
  EXPECT_THAT(refused(without(kCameraInfo, "plumb_bob", "fov")),
              AllOf(HasSubstr("file.yaml:4: distortion_model"), HasSubstr("'fov'"), HasSubstr("equidistant")));
  EXPECT_THAT(refusal("", [](const auto& file) { read_camera_info(file.parent_path()); }), HasSubstr("is a folder"));
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
              AllOf(HasSubstr("file.yaml:3: camera_model"), HasSubstr("'eucm'"), HasSubstr("omni")));
  EXPECT_THAT(refused(without(kCamchain, "[458.6, ", "[")),
              AllOf(HasSubstr("file.yaml:6: intrinsics"), HasSubstr("4 numbers, not 3")));
  EXPECT_THAT(refused(without(kCamchain, "radtan", "fov")), AllOf(HasSubstr("distortion_model"), HasSubstr("'fov'")));
  EXPECT_THAT(refused(without(kCamchain, "[1.0, 0.0, 0.0, -0.11]", "[2.0, 0.0, 0.0, -0.11]")),
              HasSubstr("file.yaml:10: T_cn_cnm1 is not a rigid transform"));
  EXPECT_THAT(refused("cam1: {}\n"), HasSubstr("cam0 is missing"));
  EXPECT_THAT(refused("cam0: 3\n"), HasSubstr("file.yaml:1: cam0"));
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
    write_camera_info(folder_ / (std::string(name) + ".yaml"), single_camera_info(name, camera.lens));
  const auto text = extrinsics_text({{"left", truth[0]}, {"right", truth[1]}}, 0, Eigen::Matrix<double, 6, 1>::Zero());
  folder_.write("extrinsics.yaml", text);
  const auto back = read_extrinsics(folder_ / "extrinsics.yaml");
  ASSERT_THAT(back, SizeIs(2));
  EXPECT_TRUE(back[1].camera.camera_from_reference.isApprox(truth[1].camera_from_reference, 1e-8));
  EXPECT_EQ(back[1].camera.lens.pinhole.cx, truth[1].lens.pinhole.cx);
  EXPECT_THAT(refusal(without(text, "[1, 0, 0, 0,", "[3, 0, 0, 0,"), read_extrinsics),
              AllOf(HasSubstr("file.yaml:7: reference_from_camera"), HasSubstr("4 x 4")));
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
