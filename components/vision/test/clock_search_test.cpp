// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/clock_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace panvo::vision {
namespace {

constexpr double kPeriod_s = 0.2;
constexpr double kNoise_rad = 0.001;

std::int64_t ns(double time_s) { return std::llround(1e9 * time_s); }

/// Of a vehicle that takes a bend every 20 s, to the left and to the right in turns.
double yaw(double time_s) {
  const double in_bend_s = std::fmod(time_s, 20.0) - 10.0;
  const double bend = std::floor(time_s / 20.0);
  const double side = std::fmod(bend, 2.0) == 0.0 ? 1.0 : -1.0;
  return (side > 0.0 ? 0.0 : 1.5) + side * 0.75 * (1.0 + std::tanh(in_bend_s));
}

/// Of one that winds with a period of 1.5 s.
double winding_yaw(double time_s) { return 0.1 * std::sin(2.0 * M_PI / 1.5 * time_s); }

class Search {
 public:
  /// Drives until an offset is found; nullopt if there is none until `to_s`.
  std::optional<ClockSearch::Found> drive(double from_s, double to_s, double ahead_s) {
    for (double t = from_s; t < to_s; t += kPeriod_s) {
      const double begin_s = t - kPeriod_s * (1 + static_cast<int>(t / kPeriod_s) % 5);  // the reference panorama
      const double change = is_stuck_ ? 0.0 : yaw_at(t) - yaw_at(begin_s);
      search_.add(ns(begin_s + ahead_s), ns(t + ahead_s), {change + noise_(random_), kNoise_rad * kNoise_rad});
      const auto reference = [this](std::int64_t a_ns, std::int64_t b_ns) {
        const double change_rad = yaw_at(1e-9 * static_cast<double>(b_ns)) - yaw_at(1e-9 * static_cast<double>(a_ns));
        return std::optional(
            ClockSearch::Turn{(is_blind_ ? 0.0 : change_rad) + noise_(random_), kNoise_rad * kNoise_rad});
      };
      const auto found = search_.find(ns(t + ahead_s), reference, doubted_s_);
      if (!found) continue;
      at_s_ = t;
      return found;
    }
    return std::nullopt;
  }

  bool is_winding_ = false;
  bool is_stuck_ = false;  // the other sensor sees no turn
  bool is_blind_ = false;  // nor does the reference
  std::optional<double> doubted_s_;
  double at_s_ = 0.0;

 private:
  double yaw_at(double time_s) const { return is_winding_ ? winding_yaw(time_s) : yaw(time_s); }

  ClockSearch search_;
  std::mt19937 random_{1};
  std::normal_distribution<double> noise_{0.0, kNoise_rad};
};

TEST(ClockSearch, FindsTheOffsetWithinOneBend) {
  for (const double ahead_s : {0.0, 0.03, 0.2, -0.2, 0.35, -0.5, 0.117, 1.4, -1.8}) {
    Search search;
    const auto found = search.drive(3.0, 60.0, ahead_s);
    ASSERT_TRUE(found) << ahead_s;
    EXPECT_NEAR(found->ahead_s, ahead_s, ClockSearch::kSigma_s);
    EXPECT_LT(search.at_s_, std::abs(ahead_s) <= ClockSearch::kUsual_s ? 14.0 : 15.5) << ahead_s;
  }
}

TEST(ClockSearch, FindsNoneOnAStraightRoad) { EXPECT_FALSE(Search().drive(0.5, 6.0, 0.3)); }

TEST(ClockSearch, FindsNoneBeyondItsReach) {
  EXPECT_FALSE(Search().drive(3.0, 120.0, 2.5));
  EXPECT_FALSE(Search().drive(3.0, 120.0, -5.0));
}

TEST(ClockSearch, IsNotMisledByASensorThatSeesNoTurn) {
  Search stuck;
  stuck.is_stuck_ = true;
  EXPECT_FALSE(stuck.drive(3.0, 120.0, 0.0));
  Search blind;
  blind.is_blind_ = true;
  EXPECT_FALSE(blind.drive(3.0, 120.0, 0.0));
}

TEST(ClockSearch, TakesAUsualOffsetWhereTheVehicleWindsRegularly) {
  Search winding;
  winding.is_winding_ = true;
  const auto found = winding.drive(5.0, 60.0, 0.1);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->ahead_s, 0.1, ClockSearch::kSigma_s) << "or a period of it more or less";
}

TEST(ClockSearch, FindsACoarseOffsetSoonerWhereTheOneSoFarIsContradicted) {
  for (const double ahead_s : {0.2, -0.2, 0.4}) {
    Search usual, contradicted;
    ASSERT_TRUE(usual.drive(3.0, 60.0, ahead_s));
    contradicted.doubted_s_ = 0.0;
    const auto found = contradicted.drive(3.0, 60.0, ahead_s);
    ASSERT_TRUE(found) << ahead_s;
    EXPECT_LT(contradicted.at_s_, usual.at_s_) << ahead_s;
    EXPECT_GT(found->sigma_s, ClockSearch::kSigma_s) << ahead_s;
    EXPECT_LT(std::abs(found->ahead_s - ahead_s), 2.0 * found->sigma_s) << ahead_s;
  }
}

TEST(ClockSearch, FindsNothingSoonerWhereTheOffsetSoFarIsRight) {
  Search usual, doubted;
  ASSERT_TRUE(usual.drive(3.0, 60.0, 0.2));
  doubted.doubted_s_ = 0.2;
  ASSERT_TRUE(doubted.drive(3.0, 60.0, 0.2));
  EXPECT_EQ(doubted.at_s_, usual.at_s_);
}

TEST(ClockSearch, FollowsAClockThatIsSet) {
  Search search;
  ASSERT_TRUE(search.drive(3.0, 45.0, 0.0));
  while (search.drive(search.at_s_ + kPeriod_s, 45.0, 0.0)) {
  }
  const auto found = search.drive(45.0, 120.0, 0.25);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->ahead_s, 0.25, ClockSearch::kSigma_s);
}

}  // namespace
}  // namespace panvo::vision
