// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration_files/camera_info.hpp"

#include <gmock/gmock.h>

#include "panvo/test/temporary_folder.hpp"
#include "refused.hpp"

namespace panvo::calibration_files {
namespace {

using test::refusal;
using test::with;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using vision::LensModel;

constexpr const char* kText = R"(image_width: 640
image_height: 480
camera_matrix: {rows: 3, cols: 3, data: [400, 0, 320, 0, 401, 240, 0, 0, 1]}
distortion_model: plumb_bob
distortion_coefficients: {rows: 1, cols: 5, data: [0.1, 0, 0, 0, 0]}
)";

class CameraInfoFile : public ::testing::Test {
 protected:
  CameraInfo read(const std::string& text) const { return read_camera_info(folder_.write("left.yaml", text)); }
  std::string refused(const std::string& part, const std::string& instead) const {
    return refusal([&] { return read(with(kText, part, instead)).lens(); });
  }

  const panvo::test::TemporaryFolder folder_;
};

TEST_F(CameraInfoFile, IsReadWhole) {
  const auto info = read_camera_info(std::filesystem::path(PANVO_RIGS) / "example" / "right.yaml");
  EXPECT_EQ(info.name, "example_right");
  EXPECT_EQ(info.width, 640);
  EXPECT_EQ(info.height, 480);
  EXPECT_EQ(info.camera_matrix(0, 2), 319.5);
  EXPECT_EQ(info.distortion_model, "plumb_bob");
  EXPECT_THAT(info.distortion_coefficients, ElementsAre(-0.08, 0.06, 0.0005, -0.0003, 0.0));
  EXPECT_EQ(info.rectification_matrix(2, 2), 1.0);
  EXPECT_EQ(info.projection_matrix(0, 3), -60.0);
  EXPECT_THAT(info.model_at, EndsWith("right.yaml:10: distortion_model"));
  const auto lens = info.lens();
  EXPECT_EQ(lens.model, LensModel::kPlumbBob);
  EXPECT_EQ(lens.pinhole.fx, 525.0);
  EXPECT_EQ(lens.pinhole.cy, 239.5);
  EXPECT_EQ(lens.distortion[3], -0.0003);
}

TEST_F(CameraInfoFile, OfASingleCameraNeedsNoRectification) {
  const auto info = read(kText);
  EXPECT_EQ(info.name, "left");
  EXPECT_EQ(info.rectification_matrix, Eigen::Matrix3d::Identity());
  EXPECT_EQ(info.projection_matrix(1, 1), 401.0);
  EXPECT_EQ(info.projection_matrix(0, 2), 320.0);
  EXPECT_EQ(info.projection_matrix(0, 3), 0.0);
  EXPECT_THAT(refusal([&] { read_camera_info(folder_ / "left.yaml", Rectification::kRequired); }),
              AllOf(HasSubstr("left.yaml:1: rectification_matrix is missing; add it\n"),
                    HasSubstr("left.yaml:1: projection_matrix is missing; add it")));
}

TEST_F(CameraInfoFile, MayHaveAnyLens) {
  const auto fisheye = read(with(kText, "plumb_bob", "fisheye"));
  EXPECT_EQ(fisheye.distortion_model, "fisheye") << "as written";
  EXPECT_EQ(fisheye.lens().model, LensModel::kEquidistant);
  EXPECT_NO_THROW(read(with(kText, "plumb_bob", "division"))) << "only its lens is refused";
  EXPECT_EQ(refused("plumb_bob", "''\n#"), folder_.path().string() +
                                               "/left.yaml:4: distortion_model is missing; add it: plumb_bob, "
                                               "rational_polynomial, equidistant, mei");
  auto straight = with(kText, "0.1", "0");
  EXPECT_TRUE(vision::is_straight(read(with(straight, "distortion_model: plumb_bob\n", "")).lens()));
}

TEST_F(CameraInfoFile, KeepsEveryLensInItsFile) {
  const vision::PinholeCamera pinhole{400.25, 401.5, 319.125, 239.875, 640, 480};
  for (const auto& lens :
       {vision::lens_camera("plumb_bob", std::vector{-0.1, 0.02, 0.001, -0.002, 0.003}, pinhole),
        vision::lens_camera("rational_polynomial", std::vector{1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0}, pinhole),
        vision::lens_camera("equidistant", std::vector{0.01, -0.02, 0.003, -0.0004}, pinhole),
        vision::lens_camera("mei", std::vector{0.1, 0.2, 0.3, 0.4, 1.1}, pinhole)}) {
    write_camera_info(folder_ / "head.yaml", single_camera_info("head", lens));
    const auto info = read_camera_info(folder_ / "head.yaml", Rectification::kRequired);
    const auto back = info.lens();
    EXPECT_EQ(back.model, lens.model);
    EXPECT_EQ(back.distortion, lens.distortion);
    EXPECT_EQ(back.pinhole.fx, pinhole.fx);
    EXPECT_EQ(back.pinhole.fy, pinhole.fy);
    EXPECT_EQ(back.pinhole.cx, pinhole.cx);
    EXPECT_EQ(back.pinhole.cy, pinhole.cy);
    EXPECT_EQ(info.name, "head");
  }
}

TEST_F(CameraInfoFile, IsWrittenInRosFormat) {
  auto info = read(kText);
  info.projection_matrix(0, 3) = -0.0;
  write_camera_info(folder_ / "copy.yaml", info);
  EXPECT_EQ(folder_.read("copy.yaml"), R"(image_width: 640
image_height: 480
camera_name: left
camera_matrix:
  rows: 3
  cols: 3
  data: [400, 0, 320, 0, 401, 240, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [0.1, 0, 0, 0, 0]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
projection_matrix:
  rows: 3
  cols: 4
  data: [400, 0, 320, 0, 0, 401, 240, 0, 0, 0, 1, 0]
)");
}

TEST_F(CameraInfoFile, IsRefusedWithFileLineKeyAndRemedy) {
  EXPECT_THAT(refused("image_width: 640\n", ""), HasSubstr("left.yaml:1: image_width is missing; add it"));
  EXPECT_THAT(refused("640", "wide"),
              HasSubstr("left.yaml:1: image_width must be a whole number from 1 to 65536, not 'wide'"));
  EXPECT_THAT(refused("480", "0"), HasSubstr("left.yaml:2: image_height must be a whole number from 1 to 65536"));
  EXPECT_THAT(refused("0, 0, 1]", "0, 0]"),
              HasSubstr("left.yaml:3: camera_matrix must be a list of 9 numbers, not of 8"));
  EXPECT_THAT(refused("[400", "[0"),
              HasSubstr("left.yaml:3: camera_matrix must have positive focal lengths; calibrate the camera"));
  EXPECT_THAT(refused("401", "-401"), HasSubstr("camera_matrix must have positive focal lengths"));
  EXPECT_THAT(refused("[0.1", "[.nan"), HasSubstr("left.yaml:5: distortion_coefficients must be a list of numbers"));
  EXPECT_THAT(refused("plumb_bob", "fov"),
              AllOf(HasSubstr("left.yaml:4: distortion_model cannot be used: the camera has distortion model 'fov'"),
                    HasSubstr("supported are plumb_bob")));
  EXPECT_THAT(refusal([&] { read_camera_info(folder_.path()); }),
              HasSubstr("is a folder; expected a ROS camera_info file"));
}

TEST_F(CameraInfoFile, IsRefusedWithAllProblemsAtOnce) {
  EXPECT_THAT(refusal([&] { read("image_width: 640\nimage_height: many\ncamera_matrix: [1, 2]\n"); }),
              AllOf(HasSubstr("left.yaml:1: distortion_coefficients is missing"),
                    HasSubstr("left.yaml:2: image_height"), HasSubstr("left.yaml:3: camera_matrix")));
}

}  // namespace
}  // namespace panvo::calibration_files
