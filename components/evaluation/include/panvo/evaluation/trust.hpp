// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace panvo::evaluation {

/// A published pose compared with ground truth, with the state and integrity reported at its stamp.
struct TrustSample {
  std::int64_t stamp_ns = 0;
  double error_m = 0.0;         ///< horizontal
  double error_over_sigma = 0;  ///< horizontal Mahalanobis distance: sqrt(e' C^-1 e)
  bool is_tracking = true;      ///< the state was tracking or relocalised
  bool is_usable = true;        ///< according to the integrity message; is_tracking if there is none
  std::optional<double> protection_level_m;
};

/// Time interval of a fault in the input of the run.
struct Disturbance {
  std::int64_t from_ns = 0;
  std::optional<std::int64_t> to_ns;  ///< nullopt: to the end of the run
};

/// Integrity scores of a run, over all poses as published.
struct TrustScore {
  std::size_t poses = 0;
  double max_error_m = 0.0;
  double max_error_over_sigma = 0.0;
  std::size_t outside_95 = 0;   ///< poses with an error beyond the 95 % chi-square bound, 2 degrees of freedom
  std::size_t outside_999 = 0;  ///< the same for 99.9 %
  std::size_t with_level = 0;   ///< poses with a protection level
  std::size_t beyond_level = 0;
  std::optional<double> worst_over_level;  ///< largest ratio of error to protection level

  /// Longest time in state tracking with an error over 3 sigma, s.
  double max_misleading_s = 0.0;
  /// Largest time from the start of an error over 3 sigma or beyond the level to the alarm, or the duration of such an
  /// error if it ended without an alarm; errors without alarm of at most kAlarmTime_s do not count. nullopt: no alarm
  /// was due.
  std::optional<double> time_to_alarm_s;
  /// From the start of the disturbance to the first alarm, whether due or not. nullopt: no alarm, or no disturbance.
  std::optional<double> noticed_s;
  bool is_never_noticed = false;
  /// From the end of the disturbance to the end of the last alarm or the last error over 3 sigma longer than
  /// kAlarmTime_s. nullopt for a disturbance without an end.
  std::optional<double> time_to_recover_s;
  bool is_never_recovered = false;
  std::vector<double> levels_while_tracking_m;
};

/// An alarm must be raised within this time; a longer time without a pose is itself an alarm.
constexpr double kAlarmTime_s = 0.5;

/// Errors above this are misleading.
constexpr double kMisleadingSigmas = 3.0;

/// Samples must be in order of stamp. A pose is valid until the next one, at most for kAlarmTime_s. An alarm is a pose
/// that is not tracking or not usable, or more than kAlarmTime_s without a pose.
TrustScore score_trust(std::span<const TrustSample> samples, const std::optional<Disturbance>& disturbance);

}  // namespace panvo::evaluation
