// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "panvo/calibration_files/mount.hpp"
#include "panvo/calibration_files/rigid_transform.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "refused.hpp"

namespace panvo::calibration_files {
namespace {

using test::refusal;
using ::testing::AllOf;
using ::testing::HasSubstr;

class RigParts : public ::testing::Test {
 protected:
  YamlMap load(const std::string& text) const { return YamlMap(folder_.write("rig.yaml", text), "a rig file"); }

  const panvo::test::TemporaryFolder folder_;
};

TEST_F(RigParts, ReadATransformAndMakeItsRotationExact) {
  auto map = load("T: [[0, 0, 1.0001, 0.5], [0, 1, 0, 0], [-1, 0, 0, 0.25], [0, 0, 0, 1]]\n");
  const auto matrix = read_rigid_matrix(map, "T");
  EXPECT_EQ(matrix(0, 2), 1.0001) << "as written";
  const auto pose = read_rigid_transform(map, "T");
  map.finish();
  EXPECT_TRUE((pose.linear() * pose.linear().transpose()).isIdentity(1e-14));
  EXPECT_TRUE((pose.linear() * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX(), 1e-12));
  EXPECT_EQ(pose.translation(), Eigen::Vector3d(0.5, 0.0, 0.25));
}

TEST_F(RigParts, RefuseATransformThatIsNotRigid) {
  const auto refused = [&](const std::string& matrix) {
    auto map = load("T: " + matrix + "\n");
    EXPECT_TRUE(read_rigid_transform(map, "T").matrix().isIdentity());
    return refusal([&] { map.check(); });
  };
  for (const char* wrong : {"[2,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]", "[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]",
                            "[1,0,0,0, 0,1,0,0, 0,0,1,0, 1,0,0,1]", "[0,0,0,0, 0,0,0,0, 0,0,0,0, 0,0,0,0]"})
    EXPECT_THAT(refused(wrong), HasSubstr("rig.yaml:1: T is not a rigid transform; give the 4 x 4 matrix row by row"));
  EXPECT_EQ(refused("[1, 2]"), (folder_ / "rig.yaml").string() + ":1: T must be a list of 16 numbers, not of 2");
}

/// Vehicle axes: x forward, y left, z up.
TEST_F(RigParts, TurnAMountedCameraLeftDownAndClockwise) {
  const auto forward = [](const Mount& mount) { return Eigen::Vector3d(base_from_camera(mount).linear().col(2)); };
  EXPECT_EQ(forward({}), Eigen::Vector3d::UnitX());
  EXPECT_TRUE(forward({.yaw_deg = 90.0}).isApprox(Eigen::Vector3d::UnitY(), 1e-12)) << "to the left";
  EXPECT_TRUE(forward({.pitch_deg = 90.0}).isApprox(-Eigen::Vector3d::UnitZ(), 1e-12)) << "downwards";
  const Eigen::Vector3d right = base_from_camera({.roll_deg = 90.0}).linear().col(0);
  EXPECT_TRUE(right.isApprox(-Eigen::Vector3d::UnitZ(), 1e-12)) << "clockwise: its right is down";
  EXPECT_EQ(base_from_camera({.position_m = {1, 2, 3}}).translation(), Eigen::Vector3d(1, 2, 3));
}

TEST_F(RigParts, ReadAMountWithDefaults) {
  auto map = load("position_m: [0.1, 0.2, 0.3]\npitch_deg: 12\n");
  const auto mount = read_mount(map, {.position_m = {9, 9, 9}, .yaw_deg = 5.0, .pitch_deg = 6.0, .roll_deg = 7.0});
  map.finish();
  EXPECT_EQ(mount.position_m, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(mount.yaw_deg, 5.0);
  EXPECT_EQ(mount.pitch_deg, 12.0);
  EXPECT_EQ(mount.roll_deg, 7.0);
}

TEST_F(RigParts, RefuseAMountThatIsImpossible) {
  auto map = load("position_m: [0.1, 0.2, 300]\nyaw_deg: 1000\n");
  read_mount(map);
  EXPECT_THAT(refusal([&] { map.finish(); }),
              AllOf(HasSubstr("rig.yaml:1: position_m must be a list of 3 numbers from -100 to 100 m, not 300"),
                    HasSubstr("rig.yaml:2: yaw_deg must be a number from -360 to 360 degrees, not '1000'")));
}

}  // namespace
}  // namespace panvo::calibration_files
