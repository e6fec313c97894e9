// SPDX-License-Identifier: Apache-2.0
#include "panvo/panorama_stitcher/rig_file.hpp"

#include <gmock/gmock.h>

#include <string>

#include "painted_rigs.hpp"
#include "panvo/calibration_files/file_error.hpp"
#include "panvo/panorama_stitcher/panorama_stitcher.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::panorama_stitcher {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kLens = R"(image_width: 480
image_height: 480
camera_matrix: {rows: 3, cols: 3, data: [140.0, 0.0, 239.5, 0.0, 141.0, 238.5, 0.0, 0.0, 1.0]}
distortion_model: equidistant
distortion_coefficients: {rows: 1, cols: 4, data: [0.01, -0.002, 0.0, 0.0]}
)";

class RigFileTest : public ::testing::Test {
 protected:
  RigFileTest() { folder_.write("lens.yaml", kLens); }

  RigFile read(const std::string& text) { return read_rig_file(folder_.write("panorama.yaml", text)); }

  std::string refusal(const std::string& text) {
    try {
      read(text);
    } catch (const calibration_files::FileError& error) {
      return error.what();
    }
    return "accepted";
  }

  panvo::test::TemporaryFolder folder_;
};

TEST_F(RigFileTest, ReadsHeadsThatShareAnImage) {
  const auto rig = read(R"(panorama: {frame_id: top, blend_deg: 8, radius_m: 12, seen_elevation_deg: [-60, 80]}
heads:
- {name: front, image: 0, image_size_px: [960, 480], region_px: [0, 0, 480, 480], camera_info: lens.yaml, field_of_view_deg: 190}
- {name: back, image: 0, image_size_px: [960, 480], region_px: [480, 0, 480, 480], camera_info: lens.yaml, yaw_deg: 180}
)")
                       .rig;
  EXPECT_EQ(rig.frame_id, "top");
  EXPECT_NEAR(rig.blend_rad, 8.0 * kDegree, 1e-12);
  EXPECT_EQ(rig.radius_m, 12.0);
  EXPECT_NEAR(rig.highest_rad, -80.0 * kDegree, 1e-12);
  EXPECT_NEAR(rig.lowest_rad, 60.0 * kDegree, 1e-12);
  ASSERT_EQ(rig.heads.size(), 2u);
  EXPECT_EQ(rig.images(), 1u);
  EXPECT_EQ(rig.heads[1].name, "back");
  EXPECT_EQ(rig.heads[1].region_px, cv::Rect(480, 0, 480, 480));
  const auto& lens = std::get<vision::CameraModel>(rig.heads[0].lens);
  EXPECT_EQ(lens.camera().model, vision::LensModel::kEquidistant);
  EXPECT_EQ(lens.camera().pinhole.fy, 141.0);
  EXPECT_NEAR(lens.widest_rad(), 95.0 * kDegree, 1e-12);
}

/// Rig axes: x forward, y left, z up. Panorama axes: x right, y down, z forward.
TEST_F(RigFileTest, TurnsHeadsAsCamerasOfTheVehicleAre) {
  const auto rig = read(R"(heads:
- {camera_info: lens.yaml, yaw_deg: 90, position_m: [0.1, 0.2, 0.3]}
- {camera_info: lens.yaml, pitch_deg: -90}
- {camera_info: lens.yaml, roll_deg: 90}
- {camera_info: lens.yaml, panorama_from_head: [0, 0, 1, 0.5, 0, 1, 0, 0, -1, 0, 0, 0.25, 0, 0, 0, 1]}
)")
                       .rig;
  const auto forward = [&](std::size_t head) {
    return Eigen::Vector3d(rig.heads[head].panorama_from_head.linear().col(2));
  };
  EXPECT_TRUE(forward(0).isApprox(Eigen::Vector3d(-1, 0, 0), 1e-9)) << "to the left";
  EXPECT_TRUE(rig.heads[0].panorama_from_head.translation().isApprox(Eigen::Vector3d(-0.2, -0.3, 0.1), 1e-9));
  EXPECT_TRUE(forward(1).isApprox(Eigen::Vector3d(0, -1, 0), 1e-9)) << "upwards";
  EXPECT_TRUE(rig.heads[2].panorama_from_head.linear().col(0).isApprox(Eigen::Vector3d(0, 1, 0), 1e-9))
      << "clockwise: its right is down";
  EXPECT_TRUE(forward(3).isApprox(Eigen::Vector3d(1, 0, 0), 1e-9));
  EXPECT_EQ(rig.heads[3].panorama_from_head.translation().x(), 0.5);
}

TEST_F(RigFileTest, NamesEveryProblemWithItsLine) {
  const auto text = refusal(R"(panorama:
  blend_deg: wide
  blent_deg: 5
heads:
- camera_info: lens.yaml
  pitch_deg: 1000
- name: lost
)");
  EXPECT_THAT(text,
              AllOf(HasSubstr("panorama.yaml:2: panorama.blend_deg must be a number from 0 to 90 degrees, not 'wide'"),
                    HasSubstr("panorama.yaml:3: panorama.blent_deg is not a known key; did you mean blend_deg?"),
                    HasSubstr("panorama.yaml:6: heads[0].pitch_deg must be"),
                    HasSubstr("panorama.yaml:7: heads[1].camera_info is missing; add it")));
}

TEST_F(RigFileTest, NamesWhatIsWrongWithACalibration) {
  folder_.write("lens.yaml",
                "image_width: 480\nimage_height: many\ncamera_matrix: [1, 2]\ndistortion_coefficients: [1]\n");
  EXPECT_THAT(refusal("heads: [{camera_info: lens.yaml}]\n"),
              AllOf(HasSubstr("lens.yaml:2: image_height must be a whole number"),
                    HasSubstr("lens.yaml:3: camera_matrix must be a list of 9 numbers, not of 2"),
                    HasSubstr("distortion_model is missing")));
  std::string division = kLens;
  division.replace(division.find("equidistant"), 11, "division");
  folder_.write("lens.yaml", division);
  EXPECT_THAT(refusal("heads: [{camera_info: lens.yaml}]\n"),
              AllOf(HasSubstr("lens.yaml:4: distortion_model"), HasSubstr("'division'")));
  std::string folded = kLens;
  folded.replace(folded.find("0.01"), 4, "-0.3");
  folder_.write("lens.yaml", folded);
  EXPECT_THAT(refusal("heads: [{camera_info: lens.yaml, field_of_view_deg: 200}]\n"),
              AllOf(HasSubstr("panorama.yaml:1: heads[0].camera_info"), HasSubstr("not invertible beyond")));
  EXPECT_THAT(refusal("heads: [{camera_info: nowhere.yaml}]\n"), HasSubstr("nowhere.yaml: cannot be opened"));
}

TEST_F(RigFileTest, RefusesRegionsThatDoNotFit) {
  const auto with = [&](const std::string& region) {
    return refusal("heads:\n- {camera_info: lens.yaml, " + region + "}\n");
  };
  EXPECT_THAT(with("region_px: [0, 0, 480, 480]"), HasSubstr("region_px needs image_size_px"));
  EXPECT_THAT(with("region_px: [0, 0, 400, 480], image_size_px: [960, 480]"),
              AllOf(HasSubstr("400 x 480"), HasSubstr("calibrated for 480 x 480")));
  EXPECT_THAT(with("region_px: [500, 0, 480, 480], image_size_px: [960, 480]"),
              HasSubstr("reaches beyond the image of 960 x 480"));
  EXPECT_THAT(with("equirectangular_px: [100, 60]"), HasSubstr("twice as wide as high"));
  EXPECT_THAT(with("image_size_px: [960, 480]"), HasSubstr("image_size_px needs region_px"));
  EXPECT_THAT(with("image: 1"), HasSubstr("heads has no head with image 0"));
}

TEST_F(RigFileTest, RefusesPosesThatContradictOrAreNone) {
  EXPECT_THAT(
      refusal(
          "heads:\n- {camera_info: lens.yaml, yaw_deg: 3, panorama_from_head: [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}\n"),
      HasSubstr("yaw_deg conflicts with panorama_from_head"));
  EXPECT_THAT(refusal("heads:\n- {camera_info: lens.yaml, panorama_from_head: [2,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}\n"),
              HasSubstr("is not a rigid transform"));
}

TEST_F(RigFileTest, RefusesWhatIsNoRig) {
  EXPECT_THAT(refusal("heads: []\n"), HasSubstr("heads must be a list of at least one map"));
  EXPECT_THAT(refusal("- a\n- b\n"), HasSubstr("contains no `key: value` lines"));
  EXPECT_THAT(refusal("a: [1\n"), HasSubstr("is not YAML"));
}

class ShippedRig : public ::testing::TestWithParam<const char*> {};

TEST_P(ShippedRig, SeesAllThatItPromises) {
  const auto file = read_rig_file(std::filesystem::path(PANVO_CONFIG) / "rigs" / GetParam() / "panorama.yaml");
  EXPECT_NO_THROW(PanoramaStitcher(file.rig, {360, false, {}})) << file.seen_elevation_at;
}

INSTANTIATE_TEST_SUITE_P(Rigs, ShippedRig,
                         ::testing::Values("six_head", "two_fisheyes", "dual_fisheye", "ladybug3", "mirror"),
                         [](const auto& shipped) { return std::string(shipped.param); });

}  // namespace
}  // namespace panvo::panorama_stitcher
