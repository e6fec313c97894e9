// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/speed_jump.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "panvo/vision/median.hpp"
#include "panvo/vision/seconds.hpp"

namespace panvo::localizer {
namespace {

// Road vehicles brake by at most 10 m/s^2: the two terms together exceed that for images up to a second apart. At high
// rates, only the first one counts, which exceeds the errors of two steps.
constexpr double kAtOnce = 2.0;   // m/s
constexpr double kBraking = 8.0;  // m/s^2
// Before and after a jump. Single steps show it at once; the jitter of stamps matters less to several steps.
constexpr std::array<std::size_t, 2> kSteps = {1, 4};
constexpr std::size_t kKnownIntervals = 30;  // that tell the camera's, as long as less than half of them lack images
constexpr std::size_t kLeastIntervals = 6;   // the same, at the start
constexpr int kRefinements = 3;              // of the mean interval
constexpr double kJitter = 0.7;              // intervals by which two stamps together are usually off at most
constexpr double kMostJitter = 0.85;         // the same, if no image is lost
constexpr double kIntervalError = 0.08;      // of the camera's interval, relative
constexpr double kInDoubtNone = 0.2;         // of an interval: so much less than two of them is one

struct Motion {
  Eigen::Vector2d way_m;  // in the vehicle's axes at its end
  double time_s;
};

std::optional<Motion> motion(const OdometryBuffer& chain, std::int64_t from_ns, std::int64_t to_ns) {
  const auto from = chain.at(from_ns), to = chain.at(to_ns);
  if (!from || !to) return std::nullopt;
  const Eigen::Isometry3d to_from = to->pose.odom_from_base.inverse() * from->pose.odom_from_base;
  return Motion{-to_from.translation().head<2>(), vision::seconds(from_ns, to_ns)};
}

/// Interval at which the camera takes images; nullopt while it is not known. Of the recent ones, the median tells how
/// many images were lost in the others.
std::optional<double> image_interval_s(const OdometryBuffer& chain) {
  std::vector<double> intervals_s;
  for (std::size_t i = 0; i < kKnownIntervals; ++i) {
    const auto from_ns = chain.stamp_before_latest(i + 1);
    if (!from_ns) break;
    intervals_s.push_back(vision::seconds(*from_ns, *chain.stamp_before_latest(i)));
  }
  if (intervals_s.size() < kLeastIntervals) return std::nullopt;
  const double time_s = std::accumulate(intervals_s.begin(), intervals_s.end(), 0.0);
  double interval_s = vision::median(intervals_s);
  for (int i = 0; i < kRefinements; ++i) {
    double images = 0.0;
    for (const double one_s : intervals_s) images += std::max(1.0, std::floor(one_s / interval_s + kInDoubtNone));
    interval_s = time_s / images;
  }
  return interval_s;
}

/// How many images after the first one the camera may have taken in a time: one number, or two where stamps jitter.
std::array<double, 2> images_in(double time_s, double image_interval_s) {
  const double intervals = time_s / image_interval_s;
  return {std::max(1.0, std::ceil(intervals - kJitter)), std::max(1.0, std::floor(intervals + kJitter))};
}

/// The smallest change of speed that explains two motions, m/s: stamps that jitter tell another interval, but the camera
/// takes images at equal intervals, and loses some.
double least_change_m_s(const Motion& a, const Motion& b, std::size_t steps, double image_interval_s) {
  const auto change_m_s = [&](double a_s, double b_s) { return (b.way_m / b_s - a.way_m / a_s).norm(); };
  double least_m_s = change_m_s(a.time_s, b.time_s);
  const double unlost_s = static_cast<double>(steps) * image_interval_s;
  const double off_s = std::max(std::abs(a.time_s - unlost_s), std::abs(b.time_s - unlost_s));
  if (off_s < kMostJitter * image_interval_s + kIntervalError * unlost_s) {
    least_m_s = std::min(least_m_s, change_m_s(unlost_s, unlost_s));
  }
  for (const double of_a : images_in(a.time_s, image_interval_s)) {
    for (const double of_b : images_in(b.time_s, image_interval_s)) {
      least_m_s = std::min(least_m_s, change_m_s(of_a * image_interval_s, of_b * image_interval_s));
    }
  }
  return least_m_s;
}

}  // namespace

std::optional<double> speed_jump_m_s(const OdometryBuffer& chain, std::optional<std::int64_t> agreed_ns) {
  const auto interval_s = image_interval_s(chain);
  if (!interval_s) return std::nullopt;
  std::optional<double> jump_m_s;
  for (const std::size_t steps : kSteps) {
    const auto begin_ns = chain.stamp_before_latest(2 * steps);
    if (!begin_ns || (agreed_ns && *chain.stamp_before_latest(steps - 1) <= *agreed_ns)) break;
    const std::int64_t middle_ns = *chain.stamp_before_latest(steps), end_ns = *chain.stamp_before_latest(0);
    const auto before = motion(chain, *begin_ns, middle_ns), after = motion(chain, middle_ns, end_ns);
    if (!before || !after) break;
    const double change_m_s = least_change_m_s(*before, *after, steps, *interval_s);
    const double most_m_s = kAtOnce + kBraking * 0.5 * vision::seconds(*begin_ns, end_ns);
    if (change_m_s > most_m_s) jump_m_s = std::max(jump_m_s.value_or(0.0), change_m_s);
  }
  return jump_m_s;
}

}  // namespace panvo::localizer
