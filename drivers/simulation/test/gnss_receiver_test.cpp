// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/gnss_receiver.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace panvo::simulation {
namespace {

constexpr std::int64_t kStep_ns = 100'000'000;

Eigen::Vector3d true_position_m(int step) { return {0.5 * step, 3.0, 1.0}; }

/// At 5 m/s along x.
std::vector<GnssReceiver::Fix> fixes_of(const GnssErrors& errors, int steps, std::uint64_t seed = 1) {
  GnssReceiver receiver(errors, seed);
  std::vector<GnssReceiver::Fix> all;
  for (int i = 0; i < steps; ++i) {
    if (const auto fix = receiver.step(i * kStep_ns, true_position_m(i))) all.push_back(*fix);
  }
  return all;
}

TEST(GnssReceiver, StatesTruePositionsWithoutErrors) {
  const auto all =
      fixes_of({.noise_m = 0.0, .slow_error_m = 0.0, .reflections_per_km = 0.0, .outages_per_km = 0.0}, 100);
  ASSERT_EQ(all.size(), 10U);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].stamp_ns, static_cast<std::int64_t>(i) * 1'000'000'000);
    EXPECT_TRUE(all[i].has_position);
    EXPECT_TRUE(all[i].world_m.isApprox(true_position_m(10 * static_cast<int>(i))));
  }
}

TEST(GnssReceiver, HasTheStatedErrors) {
  GnssErrors errors{.slow_error_s = 3.0, .reflections_per_km = 0.0, .outages_per_km = 0.0};
  const auto all = fixes_of(errors, 40'000);
  Eigen::Vector3d square = Eigen::Vector3d::Zero();
  for (const auto& fix : all) {
    const Eigen::Vector3d error = fix.world_m - true_position_m(static_cast<int>(fix.stamp_ns / kStep_ns));
    square += error.cwiseQuotient(fix.sigma_m).cwiseAbs2() / static_cast<double>(all.size());
  }
  for (const double mean : square) EXPECT_NEAR(mean, 1.0, 0.15);
}

TEST(GnssReceiver, IsReflectedAndInterruptedAlongStretches) {
  const auto all =
      fixes_of({.noise_m = 0.1, .slow_error_m = 0.0, .reflections_per_km = 2.0, .outages_per_km = 2.0}, 100'000);
  int displaced = 0, missing = 0;
  for (const auto& fix : all) {
    const Eigen::Vector3d error = fix.world_m - true_position_m(static_cast<int>(fix.stamp_ns / kStep_ns));
    displaced += error.head<2>().norm() > 1.0 ? 1 : 0;
    missing += fix.has_position ? 0 : 1;
  }
  // Two stretches of 40 m per 1000 m: 8 in 100.
  EXPECT_NEAR(displaced / static_cast<double>(all.size()), 0.08, 0.03);
  EXPECT_NEAR(missing / static_cast<double>(all.size()), 0.08, 0.03);
}

}  // namespace
}  // namespace panvo::simulation
