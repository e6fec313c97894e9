// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/speed_jump.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace panvo::localizer {
namespace {

/// Way of a vehicle at a time, m.
using WayAt = std::function<Eigen::Vector2d(double)>;

struct Camera {
  double rate_hz = 25.0;
  double jitter_s = 0.0;  // standard deviation of the stamps
  double off_s = 0.0;     // largest further error of the stamps
  unsigned seed = 1;
  double phase = 0.0;           // of the first image, in intervals
  std::set<int> lost_images{};  // by number
};

/// Images at which the speed jumps, within some seconds.
std::set<int> jumps(const Camera& camera, double seconds, const WayAt& way_at) {
  std::mt19937_64 random(camera.seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  OdometryBuffer chain(60.0);
  std::set<int> images;
  for (int i = 0; i < seconds * camera.rate_hz; ++i) {
    const double taken_s = (i + camera.phase) / camera.rate_hz;
    const double jitter_s = camera.jitter_s * normal(random);
    const double stamp_s = taken_s + jitter_s + (camera.off_s > 0.0 ? camera.off_s * uniform(random) : 0.0);
    if (camera.lost_images.contains(i)) continue;
    OdometryPose pose;
    pose.stamp_ns = static_cast<std::int64_t>(std::llround((100.0 + stamp_s) * 1e9));
    pose.odom_from_base.translation().head<2>() = way_at(taken_s);
    if (chain.add(pose) && speed_jump_m_s(chain, std::nullopt)) images.insert(i);
  }
  return images;
}

/// Numbers of images that get lost, at random.
std::set<int> tenth_of(int images, unsigned seed) {
  std::mt19937_64 random(1000 + seed);
  std::set<int> lost;
  for (int i = 0; i < images; ++i) {
    if (random() % 10 == 0) lost.insert(i);
  }
  return lost;
}

WayAt straight_at(double speed_m_s) {
  return [=](double t) { return Eigen::Vector2d(speed_m_s * t, 0.0); };
}

/// Goes on with another velocity after the first second.
WayAt jumping(const Eigen::Vector2d& before_m_s, const Eigen::Vector2d& after_m_s) {
  return
      [=](double t) -> Eigen::Vector2d { return before_m_s * std::min(t, 1.0) + after_m_s * std::max(t - 1.0, 0.0); };
}

/// Brakes to a stop after two seconds.
WayAt braking(double speed_m_s, double braking_m_s2) {
  return [=](double t) {
    const double braked_s = std::min(std::max(t - 2.0, 0.0), speed_m_s / braking_m_s2);
    return Eigen::Vector2d(speed_m_s * (std::min(t, 2.0) + braked_s) - 0.5 * braking_m_s2 * braked_s * braked_s, 0.0);
  };
}

TEST(SpeedJump, IsNotTheJitterOfStamps) {
  for (const double jitter_ms : {0.0, 1.0, 2.0, 4.0}) {
    for (const double speed_m_s : {0.0, 10.0, 20.0}) {
      const Camera camera{.jitter_s = 1e-3 * jitter_ms};
      EXPECT_EQ(jumps(camera, 60.0, straight_at(speed_m_s)).size(), 0U) << jitter_ms << " ms, " << speed_m_s << " m/s";
    }
  }
}

TEST(SpeedJump, IsNotAStampThatIsOffByAThirdOfAnInterval) {
  int drives = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const Camera camera{.off_s = 0.013, .seed = seed};
    drives += jumps(camera, 4.0, straight_at(5.0)).empty() ? 0 : 1;
  }
  EXPECT_EQ(drives, 0);
}

TEST(SpeedJump, IsNotTheBrakingOfARoadVehicle) {
  for (const double rate_hz : {1.0, 5.0, 25.0}) {
    for (const double braking_m_s2 : {6.0, 9.9}) {
      for (const double phase : {0.0, 0.25, 0.5, 0.75}) {
        const Camera camera{.rate_hz = rate_hz, .jitter_s = 0.002, .phase = phase};
        EXPECT_EQ(jumps(camera, 12.0, braking(25.0, braking_m_s2)).size(), 0U)
            << rate_hz << " Hz, " << braking_m_s2 << " m/s^2, " << phase;
      }
    }
  }
}

TEST(SpeedJump, IsNotALostImage) {
  for (const double jitter_ms : {0.0, 1.0}) {
    const Camera camera{.jitter_s = 1e-3 * jitter_ms, .lost_images = {10, 40, 60, 61, 90, 91, 92, 93, 94}};
    EXPECT_EQ(jumps(camera, 8.0, straight_at(20.0)).size(), 0U) << jitter_ms;
  }
}

TEST(SpeedJump, IsNotALostImageWhereStampsJitterAsWell) {
  for (const double rate_hz : {25.0, 50.0}) {
    for (const double speed_m_s : {5.0, 10.0}) {
      int drives = 0;
      for (unsigned seed = 1; seed <= 100; ++seed) {
        const Camera camera{.rate_hz = rate_hz,
                            .jitter_s = 0.1 / rate_hz,  // 4 ms at 25 Hz
                            .seed = seed,
                            .lost_images = tenth_of(80, seed)};
        drives += jumps(camera, 1.6, straight_at(speed_m_s)).empty() ? 0 : 1;
      }
      EXPECT_LE(drives, 1) << "of 100, " << rate_hz << " Hz, " << speed_m_s << " m/s";
    }
  }
}

TEST(SpeedJump, ShowsWithinFourImagesWhereTheFirstOnesAreLost) {
  for (const auto& [before_m_s, after_m_s] : {std::pair{10.0, 5.0}, {20.0, 10.0}, {5.0, 10.0}, {5.0, 0.0}}) {
    for (const std::set<int>& lost : {std::set<int>{26}, {26, 27}, {25}, {25, 26}}) {
      const auto images = jumps({.lost_images = lost}, 3.0, jumping({before_m_s, 0.0}, {after_m_s, 0.0}));
      ASSERT_FALSE(images.empty()) << before_m_s << " to " << after_m_s << ", lost from " << *lost.begin();
      EXPECT_GE(*images.begin(), 26) << before_m_s << " to " << after_m_s << ", lost from " << *lost.begin();
      EXPECT_LE(*images.begin(), *lost.rbegin() + 4) << before_m_s << " to " << after_m_s;
    }
  }
}

TEST(SpeedJump, IsTheFirstImageAtWhichOdometryFollowsAnotherVehicle) {
  const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> changes = {
      {{0.0, 0.0}, {5.0, 0.0}},   {{0.0, 0.0}, {0.0, 3.0}},   {{10.0, 0.0}, {15.0, 0.0}}, {{10.0, 0.0}, {5.0, 0.0}},
      {{20.0, 0.0}, {25.0, 0.0}}, {{20.0, 0.0}, {14.0, 0.0}}, {{5.0, 0.0}, {0.0, 3.0}},   {{15.0, 0.0}, {-15.0, 0.0}},
  };
  for (const auto& [before_m_s, after_m_s] : changes) {
    const auto images = jumps({}, 3.0, jumping(before_m_s, after_m_s));
    ASSERT_FALSE(images.empty()) << before_m_s.transpose() << " to " << after_m_s.transpose();
    EXPECT_EQ(*images.begin(), 26) << "the first after 1 s";
    EXPECT_LE(*images.rbegin(), 26 + 6) << "not for ever";
  }
  const auto images = jumps({.rate_hz = 5.0}, 3.0, jumping({10.0, 0.0}, {15.0, 0.0}));
  EXPECT_TRUE(images.contains(6)) << "5 Hz";
}

TEST(SpeedJump, ShowsWithinFourImagesWhereStampsJitterAsWell) {
  for (const double jitter_ms : {1.0, 2.0, 4.0}) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
      for (const double speed_m_s : {10.0, 20.0}) {
        const Camera camera{.jitter_s = 1e-3 * jitter_ms, .seed = seed};
        const auto images = jumps(camera, 3.0, jumping({speed_m_s, 0.0}, {speed_m_s + 5.0, 0.0}));
        ASSERT_FALSE(images.empty()) << jitter_ms << " ms, " << speed_m_s << " m/s, " << seed;
        EXPECT_GE(*images.begin(), 26) << jitter_ms << " ms, " << speed_m_s << " m/s, " << seed;
        EXPECT_LE(*images.begin(), 29) << jitter_ms << " ms, " << speed_m_s << " m/s, " << seed;
      }
    }
  }
}

TEST(SpeedJump, IsNotWhatPanoramasHaveConfirmedSince) {
  OdometryBuffer chain(60.0);
  const WayAt way_at = jumping({10.0, 0.0}, {15.0, 0.0});
  for (int i = 20; i <= 28; ++i) {
    OdometryPose pose;
    pose.stamp_ns = i * 40'000'000;
    pose.odom_from_base.translation().head<2>() = way_at(0.04 * i);
    chain.add(pose);
  }
  EXPECT_NEAR(speed_jump_m_s(chain, std::nullopt).value_or(0.0), 3.75, 1e-6) << "of four images, one was before it";
  EXPECT_TRUE(speed_jump_m_s(chain, 24 * 40'000'000));
  EXPECT_FALSE(speed_jump_m_s(chain, 27 * 40'000'000));
}

}  // namespace
}  // namespace panvo::localizer
