// SPDX-License-Identifier: Apache-2.0
#include "panvo/all_round_odometry/camera_rotation.hpp"

#include <gtest/gtest.h>

#include "park.hpp"

namespace panvo::all_round_odometry {
namespace {

class RotatedCamera : public ::testing::Test {
 protected:
  /// Panoramas `from` to `to`, each against the one two before, by a camera that is rotated otherwise than stated.
  void go(int from, int to, const Eigen::Vector3d& rotation) {
    const Eigen::Matrix3d stated_from_base = vision::so3_exp(rotation).transpose();
    for (int now = from; now <= to; ++now) {
      PointTracks tracks = park_.seen(now, {now - 2}).tracks[0];
      for (Sighting& sighting : tracks.sightings) {
        sighting.then = stated_from_base * sighting.then;
        sighting.now = stated_from_base * sighting.now;
      }
      camera_.add(tracks, Eigen::Translation3d(-kCamera) * Park::vehicle(now - 2).inverse() * Park::vehicle(now) *
                              Eigen::Translation3d(kCamera));
    }
  }

  Eigen::Vector3d error(const Eigen::Vector3d& rotation) const {
    return vision::so3_log(camera_.base_from_stated() * vision::so3_exp(rotation).transpose());
  }

  Park park_;
  CameraRotation camera_;
};

TEST_F(RotatedCamera, IsFoundByTheDirectionOfMotion) {
  const Eigen::Vector3d rotation(0.02, -0.03, 0.05);
  go(2, 30, rotation);
  EXPECT_LT(error(rotation).norm(), 3e-3) << error(rotation).transpose();
  EXPECT_LT(camera_.covariance().trace(), 3 * 0.005 * 0.005);
}

TEST_F(RotatedCamera, IsFoundAlsoIfItIsFarOff) {
  const Eigen::Vector3d rotation(0.0, 0.05, 0.6);
  go(2, 80, rotation);
  EXPECT_LT(error(rotation).norm(), 0.01) << error(rotation).transpose();
}

TEST_F(RotatedCamera, IsFoundAgainAfterAKnock) {
  go(2, 60, Eigen::Vector3d::Zero());
  EXPECT_LT(error(Eigen::Vector3d::Zero()).norm(), 3e-3);
  const Eigen::Vector3d rotation(0.0, 0.0, -0.3);
  go(61, 140, rotation);
  EXPECT_LT(error(rotation).norm(), 0.01) << error(rotation).transpose();
}

TEST_F(RotatedCamera, IsUnknownAtStandstill) {
  const PointTracks tracks = park_.seen(5, {5}).tracks[0];
  for (int i = 0; i < 50; ++i) camera_.add(tracks, Eigen::Isometry3d::Identity());
  EXPECT_EQ(camera_.base_from_stated(), Eigen::Matrix3d::Identity());
  EXPECT_GT(camera_.covariance().trace(), 3 * 0.05 * 0.05);
}

TEST_F(RotatedCamera, IsNotLearnedFromPointsThatMove) {
  for (int now = 2; now <= 60; ++now) {
    PointTracks tracks = park_.seen(now, {now - 2}).tracks[0];
    for (std::size_t i = 0; i < tracks.sightings.size(); i += 4) {  // aside, alike
      tracks.sightings[i].now = (tracks.sightings[i].now + Eigen::Vector3d(0.0, 0.05, 0.0)).normalized();
    }
    camera_.add(tracks, Eigen::Translation3d(-kCamera) * Park::vehicle(now - 2).inverse() * Park::vehicle(now) *
                            Eigen::Translation3d(kCamera));
  }
  EXPECT_LT(error(Eigen::Vector3d::Zero()).norm(), 6e-3) << error(Eigen::Vector3d::Zero()).transpose();
}

}  // namespace
}  // namespace panvo::all_round_odometry
