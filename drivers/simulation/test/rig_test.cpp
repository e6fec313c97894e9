// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/rig.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <string>

#include "panvo/test/temporary_folder.hpp"

namespace panvo::simulation {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class RigFile : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) const { return folder_.write("rig.yaml", text); }
  std::string refusal(const std::string& text) {
    try {
      read_rig(write(text));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "taken";
  }

  panvo::test::TemporaryFolder folder_;
};

TEST(PaperRig, IsThatOfThePaper) {
  const auto rig = paper_rig();
  EXPECT_EQ(rig.stereo.calibration.left.pinhole.width, 640);
  EXPECT_EQ(rig.stereo.calibration.left.pinhole.height, 480);
  EXPECT_EQ(rig.stereo.rate_hz, 25.0);
  const Eigen::Isometry3d left_from_right = rig.stereo.calibration.right_from_left.inverse();
  EXPECT_NEAR((left_from_right.translation() - Eigen::Vector3d(0.12, 0, 0)).norm(), 0.0, 1e-12);
  ASSERT_EQ(rig.panorama.heads.size(), 1u);
  EXPECT_EQ(rig.panorama.heads[0].width, 1080);
  EXPECT_EQ(rig.panorama.heads[0].height, 540);
  EXPECT_EQ(rig.panorama.rate_hz, 5.0);
}

TEST(PaperRig, TheStereoCameraLooksForwardAndDownWithItsRightEyeOnTheRight) {
  const auto rig = paper_rig();
  const Eigen::Vector3d forward = rig.stereo.base_from_left.linear() * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(forward.x(), std::cos(12.0 * std::numbers::pi / 180.0), 1e-12);
  EXPECT_NEAR(forward.y(), 0.0, 1e-12);
  EXPECT_NEAR(forward.z(), -std::sin(12.0 * std::numbers::pi / 180.0), 1e-12);
  const Eigen::Vector3d right = rig.stereo.base_from_right().translation() - rig.stereo.base_from_left.translation();
  EXPECT_NEAR((right - Eigen::Vector3d(0, -0.12, 0)).norm(), 0.0, 1e-12);
}

TEST(PaperRig, TheShippedFileSaysTheSame) {
  const auto file = std::filesystem::path(PANVO_CONFIG) / "rigs" / "paper" / "rig.yaml";
  const auto shipped = read_rig(file);
  const auto built_in = paper_rig();
  EXPECT_EQ(shipped.stereo.calibration.left.pinhole.fx, built_in.stereo.calibration.left.pinhole.fx);
  EXPECT_EQ(shipped.stereo.calibration.left.pinhole.cy, built_in.stereo.calibration.left.pinhole.cy);
  EXPECT_TRUE(shipped.stereo.base_from_left.isApprox(built_in.stereo.base_from_left));
  EXPECT_TRUE(shipped.panorama.base_from_panorama.isApprox(built_in.panorama.base_from_panorama));
  EXPECT_EQ(shipped.stereo.exposure_s, built_in.stereo.exposure_s);
}

TEST_F(RigFile, ChangesWhatItSaysAndLeavesTheRest) {
  const auto rig = read_rig(write("stereo: {baseline_m: 0.3, colour: true}\n"));
  EXPECT_NEAR(rig.stereo.calibration.right_from_left.translation().x(), -0.3, 1e-12);
  EXPECT_TRUE(rig.stereo.sensor.colour);
  EXPECT_EQ(rig.stereo.calibration.left.pinhole.width, 640);
}

TEST_F(RigFile, SixHeadsLookAroundClockwiseAndUp) {
  const auto rig = read_rig(write("panorama: {kind: six_head}\n"));
  ASSERT_EQ(rig.panorama.heads.size(), 6u);
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector3d forward =
        rig.panorama.heads[static_cast<std::size_t>(i)].base_from_head.linear() * Eigen::Vector3d::UnitZ();
    const double yaw_rad = -2.0 * std::numbers::pi * i / 5.0;
    EXPECT_NEAR((forward - Eigen::Vector3d(std::cos(yaw_rad), std::sin(yaw_rad), 0)).norm(), 0.0, 1e-9) << i;
  }
  EXPECT_NEAR((rig.panorama.heads[5].base_from_head.linear() * Eigen::Vector3d::UnitZ()).z(), 1.0, 1e-9);
}

TEST_F(RigFile, TwoFisheyesSeeEverythingTwiceAtTheSeam) {
  const auto rig = read_rig(write("panorama: {kind: dual_fisheye}\n"));
  ASSERT_EQ(rig.panorama.heads.size(), 2u);
  const auto rays = rays_of(rig.panorama, rig.panorama.heads[0]);
  EXPECT_EQ(rays.width, 960);
  float backwards = 0.0f;
  for (const auto& direction : rays.directions) backwards = std::min(backwards, direction.z());
  EXPECT_LT(backwards, -0.1f);  // more than 90 degrees off the axis
}

TEST_F(RigFile, EveryProblemIsToldWithItsLineAndKey) {
  const auto told = refusal(
      "stereo:\n  baseline_m: 0\n  field_of_view_deg: 200\n  colour: true\npanorama:\n  size_px: [100, 100]\n  knid: "
      "x\n");
  EXPECT_THAT(told,
              AllOf(HasSubstr(":2: stereo.baseline_m"), HasSubstr(":3: stereo.field_of_view_deg"),
                    HasSubstr(":6: panorama.size_px"), HasSubstr(":7: panorama.knid"), Not(HasSubstr("colour must"))));
}

TEST_F(RigFile, APanoramaWithinTheVehicleIsRefusedUnlessThereIsNone) {
  EXPECT_THAT(
      refusal("panorama:\n  position_m: [0.1, 0.2, 1.3]\n"),
      AllOf(HasSubstr(":2: panorama.position_m"), HasSubstr("1.55 m high there"), HasSubstr("vehicle.has_body")));
  EXPECT_EQ(refusal("panorama: {position_m: [1.6, 0.2, 1.3]}\n"), "taken");  // over the bonnet
  EXPECT_EQ(refusal("panorama: {position_m: [0.1, 0.9, 1.3]}\n"), "taken");  // beside it
  EXPECT_EQ(refusal("panorama: {position_m: [0.1, 0.2, 0.5]}\nvehicle: {has_body: false}\n"), "taken");
}

TEST_F(RigFile, GivesTheVehiclesSpeed) {
  EXPECT_EQ(read_rig(write("vehicle: {speed_m_per_s: 0.8}\n")).vehicle.speed_m_per_s, 0.8);
  EXPECT_TRUE(read_rig(write("vehicle: {turns_in_place: true}\n")).vehicle.turns_in_place);
  EXPECT_THAT(refusal("vehicle:\n  speed_m_per_s: 0\n"),
              AllOf(HasSubstr(":2: vehicle.speed_m_per_s"), HasSubstr("0.1 to 30 m/s")));
}

TEST_F(RigFile, AFileThatIsNotThereOrNoYamlIsNamed) {
  EXPECT_THAT(refusal("stereo: [\n"), HasSubstr("is not YAML"));
  EXPECT_THROW(read_rig("/nowhere/rig.yaml"), std::runtime_error);
}

}  // namespace
}  // namespace panvo::simulation
