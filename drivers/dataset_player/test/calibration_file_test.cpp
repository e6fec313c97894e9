// SPDX-License-Identifier: Apache-2.0
#include "panvo/dataset_player/calibration_file.hpp"

#include <gmock/gmock.h>

#include <cstring>

#include "written_dataset.hpp"

namespace panvo::dataset_player {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using CalibrationFile = testing::WrittenDataset;

constexpr const char* kOpencvCameras =
    "%YAML:1.0\n---\nM1: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 50., 0., 32., 0., 51., 24., 0., "
    "0., 1. ]\n"
    "D1: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n   data: [ -0.1, 0.02, 0.001, 0.002, 0.003 ]\n"
    "M2: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 52., 0., 33., 0., 53., 25., 0., 0., 1. ]\n"
    "D2: !!opencv-matrix\n   rows: 1\n   cols: 8\n   dt: d\n   data: [ -0.1, 0.02, 0., 0., 0., 0., 0., 0. ]\n";
constexpr const char* kOpencvExtrinsics =
    "R: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 1., 0., 0., 0., 1., 0., 0., 0., 1. ]\n"
    "T: !!opencv-matrix\n   rows: 3\n   cols: 1\n   dt: d\n   data: [ -0.12, 0., 0. ]\n";

std::string camera_info(double tx_px, const std::string& model = "plumb_bob",
                        const std::string& coefficients = "[-0.1, 0.02, 0.0, 0.0, 0.0]") {
  return "image_width: 64\nimage_height: 48\ncamera_name: stereo\ncamera_matrix:\n  rows: 3\n  cols: 3\n  data: [50, "
         "0, 32, 0, 50, 24, 0, 0, 1]\n"
         "distortion_model: " +
         model + "\ndistortion_coefficients:\n  rows: 1\n  cols: 5\n  data: " + coefficients +
         "\n"
         "rectification_matrix:\n  rows: 3\n  cols: 3\n  data: [0.8, 0, 0.6, 0, 1, 0, -0.6, 0, 0.8]\n"
         "projection_matrix:\n  rows: 3\n  cols: 4\n  data: [40, 0, 30, " +
         std::to_string(tx_px) + ", 0, 40, 20, 0, 0, 0, 1, 0]\n";
}

template <class Read>
std::string error_of(Read read) {
  try {
    read();
  } catch (const calibration_files::FileError& problem) {
    return problem.what();
  }
  ADD_FAILURE() << "the calibration was accepted";
  return {};
}

TEST_F(CalibrationFile, OfBoofcvStatesRightToLeft) {
  write("c.xml", boofcv_calibration(0.12));
  const auto stereo = read_boofcv_calibration(root_ / "c.xml");
  EXPECT_TRUE(stereo.calibration.right_from_left.translation().isApprox(Eigen::Vector3d(-0.12, 0, 0)));
  EXPECT_DOUBLE_EQ(stereo.calibration.right.pinhole.fx, 51.0);
  EXPECT_DOUBLE_EQ(stereo.calibration.left.distortion[1], 0.02);
  EXPECT_NEAR(stereo.rectified.baseline_m, 0.12, 1e-12);
}

TEST_F(CalibrationFile, OfBoofcvIsReadInEitherSpelling) {
  auto text = boofcv_calibration();
  for (auto [from, to] : {std::pair{"<R>", "<r>"}, {"</R>", "</r>"}, {"<T>", "<t>"}, {"</T>", "</t>"}})
    text.replace(text.find(from), std::strlen(from), to);
  write("c.xml", text);
  EXPECT_NEAR(read_boofcv_calibration(root_ / "c.xml").rectified.baseline_m, 0.12, 1e-12);
}

TEST_F(CalibrationFile, OfBoofcvNamesTheLineOfWhatIsMissing) {
  auto text = boofcv_calibration();
  text.replace(text.find("<fy>50</fy>"), 11, "");
  write("c.xml", text);
  EXPECT_THAT(error_of([&] { read_boofcv_calibration(root_ / "c.xml"); }),
              AllOf(HasSubstr("c.xml:2:"), HasSubstr("<fy>")));
}

TEST_F(CalibrationFile, OfBoofcvThatWasCutOffIsRefused) {
  write("c.xml", boofcv_calibration().substr(0, 300));
  EXPECT_THAT(error_of([&] { read_boofcv_calibration(root_ / "c.xml"); }),
              AllOf(HasSubstr("c.xml"), HasSubstr("cut off")));
}

TEST_F(CalibrationFile, OfBoofcvNamesTheLineOfASizeThatNoImageHas) {
  for (const char* width : {"1e300", "-64", "NaN"}) {
    auto text = boofcv_calibration();
    text.replace(text.find("<width>64</width>"), 17, std::string("<width>") + width + "</width>");
    write("c.xml", text);
    EXPECT_THAT(error_of([&] { read_boofcv_calibration(root_ / "c.xml"); }),
                AllOf(HasSubstr("c.xml:3:"), HasSubstr("<width> must be from 1 to 65536 px")));
  }
}

TEST_F(CalibrationFile, WithABaselineOfZeroIsRefused) {
  write("c.xml", boofcv_calibration(0.0));
  EXPECT_THAT(error_of([&] { read_boofcv_calibration(root_ / "c.xml"); }),
              AllOf(HasSubstr("c.xml"), HasSubstr("baseline")));
}

TEST_F(CalibrationFile, WithExchangedCamerasIsRefused) {
  write("c.xml", boofcv_calibration(-0.12));
  EXPECT_THAT(error_of([&] { read_boofcv_calibration(root_ / "c.xml"); }), HasSubstr("swapped"));
}

TEST_F(CalibrationFile, WithoutNumbersIsRefused) {
  auto text = boofcv_calibration();
  text.replace(text.find("<cx>32</cx>"), 11, "<cx>NaN</cx>");
  write("c.xml", text);
  EXPECT_THAT(error_of([&] { read_boofcv_calibration(root_ / "c.xml"); }), HasSubstr("c.xml"));
}

TEST_F(CalibrationFile, OfRosKeepsItsRectification) {
  write("left.yaml", camera_info(0.0));
  write("right.yaml", camera_info(-4.8));
  const auto stereo = read_ros_calibration(root_ / "left.yaml", root_ / "right.yaml");
  EXPECT_DOUBLE_EQ(stereo.rectified.baseline_m, 0.12);
  EXPECT_DOUBLE_EQ(stereo.rectified.camera.cy, 20.0);
  EXPECT_DOUBLE_EQ(stereo.calibration.left.pinhole.fx, 50.0);
  EXPECT_DOUBLE_EQ(stereo.rectified.rectified_left_from_left(0, 2), 0.6);
  // Both cameras have the same rotation, so the right one is displaced along the rectified X axis in the left frame.
  EXPECT_TRUE(stereo.calibration.right_from_left.linear().isIdentity(1e-12));
  EXPECT_TRUE(stereo.calibration.right_from_left.translation().isApprox(-0.12 * Eigen::Vector3d(0.8, 0, 0.6), 1e-12));
}

TEST_F(CalibrationFile, OfTheExampleRigIsRead) {
  const fs::path rig = PANVO_EXAMPLE_RIG;
  EXPECT_DOUBLE_EQ(read_ros_calibration(rig / "left.yaml", rig / "right.yaml").rectified.baseline_m, 0.12);
}

TEST_F(CalibrationFile, OfRosForSingleCamerasIsNoStereoCalibration) {
  write("left.yaml", camera_info(0.0));
  write("right.yaml", camera_info(0.0));
  EXPECT_THAT(error_of([&] { read_ros_calibration(root_ / "left.yaml", root_ / "right.yaml"); }),
              AllOf(HasSubstr("right.yaml"), HasSubstr("baseline")));
}

TEST_F(CalibrationFile, OfRosNamesTheFileThatIsMissing) {
  write("left.yaml", camera_info(0.0));
  EXPECT_THAT(error_of([&] { read_ros_calibration(root_ / "left.yaml", root_ / "right.yaml"); }),
              HasSubstr("right.yaml: cannot be opened"));
}

TEST_F(CalibrationFile, OfRosMayBeOfAnyLens) {
  write("left.yaml", camera_info(0.0, "equidistant", "[-0.01, 0.002, 0.0, 0.0005]"));
  write("right.yaml", camera_info(-4.8, "rational_polynomial", "[0.1, 0.02, 0.0, 0.0, 0.0, 0.3, 0.0, 0.01]"));
  const auto pair = read_ros_calibration(root_ / "left.yaml", root_ / "right.yaml").calibration;
  EXPECT_EQ(pair.left.model, vision::LensModel::kEquidistant);
  EXPECT_DOUBLE_EQ(pair.left.distortion[3], 0.0005);
  EXPECT_EQ(pair.right.model, vision::LensModel::kRational);
  EXPECT_DOUBLE_EQ(pair.right.distortion[7], 0.01);
}

TEST_F(CalibrationFile, OfRosWithAnUnknownLensIsRefused) {
  write("left.yaml", camera_info(0.0, "division"));
  write("right.yaml", camera_info(-4.8));
  EXPECT_THAT(
      error_of([&] { read_ros_calibration(root_ / "left.yaml", root_ / "right.yaml"); }),
      AllOf(HasSubstr("left.yaml:8: distortion_model"), HasSubstr("'division'"), HasSubstr("supported are plumb_bob")));
}

TEST_F(CalibrationFile, OfOpencvIsReadFromOneFileOrTwo) {
  write("stereo.yaml", std::string(kOpencvCameras) + kOpencvExtrinsics);
  write("intrinsics.yml", kOpencvCameras);
  write("extrinsics.yml", std::string("%YAML:1.0\n---\n") + kOpencvExtrinsics);
  for (const auto& stereo : {read_opencv_calibration(root_ / "stereo.yaml", root_ / "stereo.yaml", {64, 48}),
                             read_opencv_calibration(root_ / "intrinsics.yml", root_ / "extrinsics.yml", {64, 48})}) {
    EXPECT_DOUBLE_EQ(stereo.calibration.left.pinhole.fy, 51.0);
    EXPECT_DOUBLE_EQ(stereo.calibration.left.distortion[4], 0.003);
    EXPECT_DOUBLE_EQ(stereo.calibration.right_from_left.translation().x(), -0.12);
    EXPECT_NEAR(stereo.rectified.baseline_m, 0.12, 1e-12);
  }
}

TEST_F(CalibrationFile, OfOpencvHasTheRationalModelWhereItHasEightCoefficients) {
  std::string text = std::string(kOpencvCameras) + kOpencvExtrinsics;
  text.replace(text.find("[ -0.1, 0.02, 0., 0., 0., 0., 0., 0. ]"), 38, "[ 0.1, 0.02, 0., 0., 0., 0.3, 0., 0.01 ]");
  write("stereo.yaml", text);
  const auto pair = read_opencv_calibration(root_ / "stereo.yaml", root_ / "stereo.yaml", {64, 48}).calibration;
  EXPECT_EQ(pair.left.model, vision::LensModel::kPlumbBob);
  EXPECT_EQ(pair.right.model, vision::LensModel::kRational);
  EXPECT_DOUBLE_EQ(pair.right.distortion[7], 0.01);
}

TEST_F(CalibrationFile, OfOpencvNamesWhatIsMissing) {
  write("stereo.yaml", kOpencvCameras);
  EXPECT_THAT(error_of([&] {
                read_opencv_calibration(root_ / "stereo.yaml", root_ / "stereo.yaml", {64, 48});
              }),
              AllOf(HasSubstr("stereo.yaml:3: R is missing"), HasSubstr("stereo.yaml:3: T is missing")));
}

TEST_F(CalibrationFile, OfOpencvNamesTheOtherNamesOfAKey) {
  std::string text = std::string(kOpencvCameras) + kOpencvExtrinsics;
  write("stereo.yaml", text.replace(text.find("M1:"), 3, "N1:"));
  EXPECT_THAT(error_of([&] {
                read_opencv_calibration(root_ / "stereo.yaml", root_ / "stereo.yaml", {64, 48});
              }),
              HasSubstr("stereo.yaml:3: M1 or K1 or cameraMatrix1 or camera_matrix_1 is missing; add it"));
}

TEST_F(CalibrationFile, ThatIsNoYamlNamesTheLine) {
  write("stereo.yaml", "%YAML:1.0\nM1: [1, 2\nM2: }\n");
  EXPECT_THAT(error_of([&] {
                read_opencv_calibration(root_ / "stereo.yaml", root_ / "stereo.yaml", {64, 48});
              }),
              AllOf(HasSubstr("stereo.yaml:"), HasSubstr("is not YAML")));
}

}  // namespace
}  // namespace panvo::dataset_player
