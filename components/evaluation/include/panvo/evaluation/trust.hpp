// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace panvo::evaluation {

/// A pose as it was published, against the truth of its time, and what was said of it then.
struct TrustSample {
  std::int64_t stamp_ns = 0;
  double error_m = 0.0;         ///< horizontal
  double error_over_sigma = 0;  ///< horizontal, by its own covariance: sqrt(e' C^-1 e)
  bool is_tracking = true;      ///< the state said so: tracking or relocalised
  bool is_usable = true;        ///< the integrity said so; where there is none: is_tracking
  std::optional<double> protection_level_m;
};

/// When something was wrong with what the run was given.
struct Disturbance {
  std::int64_t from_ns = 0;
  std::optional<std::int64_t> to_ns;  ///< nullopt: to the end of the run
};

/// Scores of a run for a user who relied on each pose as it was published.
struct TrustScore {
  std::size_t poses = 0;
  double largest_error_m = 0.0;
  double largest_error_over_sigma = 0.0;
  std::size_t outside_95 = 0;   ///< poses with an error beyond what 95 % of all should have, of two dimensions
  std::size_t outside_999 = 0;  ///< the same for 99.9 %
  std::size_t with_level = 0;   ///< poses with a protection level
  std::size_t beyond_level = 0;
  std::optional<double> worst_over_level;  ///< largest error as a multiple of its level

  /// The longest time in which the state was tracking and the error over 3 sigma, s.
  double longest_misleading_s = 0.0;
  /// From the first moment with an error over 3 sigma or beyond the level to the alarm: the largest of all such stretches, or the length of one that
  /// ended without; those without alarm that last no longer than kAlarmTime_s do not count. nullopt: none was due.
  std::optional<double> time_to_alarm_s;
  /// From the beginning of the disturbance to the first alarm, due or not. nullopt: none, or no disturbance.
  std::optional<double> noticed_s;
  bool is_never_noticed = false;
  /// From the end of the disturbance until there is neither an alarm nor a stretch over 3 sigma of more than kAlarmTime_s any more. nullopt for a
  /// disturbance without an end.
  std::optional<double> time_to_recover_s;
  bool is_never_recovered = false;
  std::vector<double> levels_while_tracking_m;
};

/// Within it an alarm has to come; and a pose that stays away for longer is an alarm of its own.
constexpr double kAlarmTime_s = 0.5;

/// More than this is misleading.
constexpr double kMisleadingSigmas = 3.0;

/// Samples in order of stamp. A pose stands until the next one, at most for kAlarmTime_s. An alarm is a pose that is not tracking or not usable, or
/// the silence after kAlarmTime_s without a pose.
TrustScore score_trust(std::span<const TrustSample> samples, const std::optional<Disturbance>& disturbance);

}  // namespace panvo::evaluation
