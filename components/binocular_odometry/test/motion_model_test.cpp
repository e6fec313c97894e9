// SPDX-License-Identifier: Apache-2.0
#include "../src/motion_model.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace panvo::binocular_odometry {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

/// Predicted forward motion in the next 100 ms after motions at 1 m/s with these stamp intervals; the stamp interval of
/// the last one is too short by `jitter_ms`.
double expected_m(const std::vector<std::int64_t>& intervals_ms, std::int64_t jitter_ms = 0) {
  MotionModel model;
  for (const auto interval_ms : intervals_ms) {
    const bool is_last = &interval_ms == &intervals_ms.back();
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    motion.translation().z() = 1e-3 * static_cast<double>(interval_ms + (is_last ? jitter_ms : 0));
    model.update(motion, interval_ms * kMillisecond_ns);
  }
  return model.predict(100 * kMillisecond_ns).translation().z();
}

TEST(MotionModel, GoesOnAsItWent) { EXPECT_NEAR(expected_m({100, 100, 100}), 0.1, 1e-12); }

TEST(MotionModel, IsNotHurriedByAStampThatCameLate) {
  EXPECT_LT(expected_m({100, 100, 198, 2}, 98), 0.25);
  EXPECT_LT(expected_m({198, 2}, 98), 0.25);
  EXPECT_LT(expected_m({2}, 98), 0.25);
}

TEST(MotionModel, IsNotSlowedByFramesThatWereLost) {
  EXPECT_NEAR(expected_m({100, 100, 1000, 100}), 0.1, 1e-12);
  EXPECT_NEAR(expected_m({100, 200, 100}), 0.1, 1e-12);
}

}  // namespace
}  // namespace panvo::binocular_odometry
