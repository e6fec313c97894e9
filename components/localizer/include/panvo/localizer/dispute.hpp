// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace panvo::localizer {

/// Which of two contradicting measurements is considered wrong.
enum class Wrong { kOdometry, kPanoramas };

struct Blame {
  Wrong wrong = Wrong::kOdometry;
  double doubt = 0.0;  ///< probability that it is the other one
};

/// A difference between the motion by odometry and by panoramas that exceeds the errors of both. Lasts from the first
/// panorama that shows it to the first that does not; meanwhile one side is constantly wrong, so differences add up
/// linearly, not squared.
class Dispute {
 public:
  /// Adds a measurement against the reference panorama `reference_ns`; replaces the previous one with the same
  /// reference. `blame`: only the first of a dispute counts.
  void add(std::int64_t reference_ns, std::int64_t stamp_ns, double difference, const Blame& blame);
  /// Odometry and panoramas agree again.
  void end() { *this = Dispute(); }

  bool is_on() const noexcept { return stamp_ns_.has_value(); }
  /// Stamp of the last measurement that differed. Precondition: on.
  std::int64_t stamp_ns() const { return *stamp_ns_; }
  const Blame& blame() const noexcept { return blame_; }
  /// Sum of the differences so far.
  double total() const noexcept { return before_ + last_; }

  /// Variance that the stretch since the reference adds to the sum; `doubt`: probability that the side considered right
  /// is wrong.
  double growth(double doubt) const noexcept;

 private:
  double before_ = 0.0;  // up to the reference
  double last_ = 0.0;    // since the reference
  std::int64_t reference_ns_ = 0;
  std::optional<std::int64_t> stamp_ns_;
  Blame blame_;
};

}  // namespace panvo::localizer
