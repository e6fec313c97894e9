// SPDX-License-Identifier: Apache-2.0
#include "observation_model.hpp"

#include <gtest/gtest.h>

#include "panvo/vision/pose.hpp"
#include "panvo/vision/stereo_geometry.hpp"

namespace panvo::binocular_odometry {
namespace {

const vision::RectifiedStereo kModelStereo{{400.0, 410.0, 320.0, 240.0, 640, 480}, 0.12};
const Eigen::Isometry3d kLeftFromAnchor =
    vision::se3_exp((vision::Vector6d() << 0.3, -0.2, -0.8, 0.1, -0.2, 0.05).finished());

TEST(ObservationModel, SeesAPointAsTheCameraDoes) {
  const Eigen::Vector3d point_in_anchor(0.8, -0.5, 6.0);
  const Eigen::Vector3d inverse_depth(0.8 / 6.0, -0.5 / 6.0, 1.0 / 6.0);
  const auto seen = predict(kModelStereo, kLeftFromAnchor, inverse_depth);
  ASSERT_TRUE(seen);
  EXPECT_LT((*seen - vision::observe(kModelStereo, kLeftFromAnchor * point_in_anchor)).norm(), 1e-9);
}

TEST(ObservationModel, SeesAPointAtInfinityByItsDirectionAlone) {
  const auto seen = predict(kModelStereo, kLeftFromAnchor, {0.1, 0.05, 0.0});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->z(), 0.0);
  const Eigen::Vector3d direction = kLeftFromAnchor.linear() * Eigen::Vector3d(0.1, 0.05, 1.0);
  EXPECT_LT((seen->head<2>() - kModelStereo.camera.project(direction)).norm(), 1e-9);
}

TEST(ObservationModel, SeesNothingBehindTheCamera) {
  Eigen::Isometry3d beyond = Eigen::Isometry3d::Identity();
  beyond.translation().z() = -7.0;
  EXPECT_FALSE(predict(kModelStereo, beyond, {0.1, 0.1, 1.0 / 6.0}));
  EXPECT_FALSE(predict_with_jacobians(kModelStereo, beyond, {0.1, 0.1, 1.0 / 6.0}));
}

TEST(ObservationModel, DerivativesAgreeWithDifferences) {
  constexpr double kStep = 1e-6;
  for (const double inverse_z : {0.0, 0.02, 0.4}) {
    const Eigen::Vector3d point(0.12, -0.08, inverse_z);
    const auto at = predict_with_jacobians(kModelStereo, kLeftFromAnchor, point);
    ASSERT_TRUE(at);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(k);
      const Eigen::Vector3d difference = (*predict(kModelStereo, kLeftFromAnchor, point + step) -
                                          *predict(kModelStereo, kLeftFromAnchor, point - step)) /
                                         (2.0 * kStep);
      EXPECT_LT((at->by_point.col(k) - difference).norm(), 1e-5 * (1.0 + difference.norm())) << k;
    }
    for (int k = 0; k < 6; ++k) {
      const vision::Vector6d step = kStep * vision::Vector6d::Unit(k);
      const Eigen::Vector3d difference = (*predict(kModelStereo, vision::se3_exp(step) * kLeftFromAnchor, point) -
                                          *predict(kModelStereo, vision::se3_exp(-step) * kLeftFromAnchor, point)) /
                                         (2.0 * kStep);
      EXPECT_LT((at->by_pose.col(k) - difference).norm(), 1e-5 * (1.0 + difference.norm())) << k;
    }
  }
}

}  // namespace
}  // namespace panvo::binocular_odometry
