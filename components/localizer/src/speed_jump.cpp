// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/speed_jump.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "panvo/vision/seconds.hpp"

namespace panvo::localizer {
namespace {

// Road vehicles brake by at most 10 m/s^2: the two terms together exceed that for images up to a second apart. At high
// rates, only the first one counts, which exceeds the errors of two steps.
constexpr double kAtOnce = 2.0;   // m/s
constexpr double kBraking = 8.0;  // m/s^2
// Before and after a jump. Single steps show it at once; the jitter of stamps matters less to several steps.
constexpr std::array<std::size_t, 2> kSteps = {1, 4};

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

/// The smallest change of speed that explains two motions of equally many steps, m/s: stamps that jitter tell another
/// interval, but the camera takes images at equal intervals, or loses some.
double least_change_m_s(const Motion& a, const Motion& b) {
  if (a.time_s > b.time_s) return least_change_m_s(b, a);
  const double by_stamps_m_s = (b.way_m / b.time_s - a.way_m / a.time_s).norm();
  const auto by_images_m_s = [&](double intervals) { return (b.way_m - intervals * a.way_m).norm() / b.time_s; };
  return std::min({by_stamps_m_s, by_images_m_s(1.0), by_images_m_s(std::round(b.time_s / a.time_s))});
}

}  // namespace

std::optional<double> speed_jump_m_s(const OdometryBuffer& chain, std::optional<std::int64_t> agreed_ns) {
  std::optional<double> jump_m_s;
  for (const std::size_t steps : kSteps) {
    const auto begin_ns = chain.stamp_before_latest(2 * steps);
    if (!begin_ns || (agreed_ns && *chain.stamp_before_latest(steps - 1) <= *agreed_ns)) break;
    const std::int64_t middle_ns = *chain.stamp_before_latest(steps), end_ns = *chain.stamp_before_latest(0);
    const auto before = motion(chain, *begin_ns, middle_ns), after = motion(chain, middle_ns, end_ns);
    if (!before || !after) break;
    const double change_m_s = least_change_m_s(*before, *after);
    const double most_m_s = kAtOnce + kBraking * 0.5 * vision::seconds(*begin_ns, end_ns);
    if (change_m_s > most_m_s) jump_m_s = std::max(jump_m_s.value_or(0.0), change_m_s);
  }
  return jump_m_s;
}

}  // namespace panvo::localizer
