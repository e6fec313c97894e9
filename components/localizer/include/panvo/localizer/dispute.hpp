// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace panvo::localizer {

/// Who is taken to be wrong where two measurements of one motion cannot both be right.
enum class Wrong { kOdometry, kPanoramas };

/// A difference between what odometry and panoramas say of the motion that is too large for either's error. It lasts from the first panorama that
/// shows it to the first that does not, and one of the two is wrong all that time: what differs adds up, not its squares.
class Dispute {
 public:
  /// Of a measurement against the panorama of `reference_ns`; it takes the place of the one before against the same panorama.
  /// `wrong`: only the first of a dispute decides it. What must be allowed for is the variance that the stretch since the reference adds.
  void add(std::int64_t reference_ns, std::int64_t stamp_ns, double difference, Wrong wrong);
  /// Odometry and panoramas agree again.
  void end() { *this = Dispute(); }

  bool is_on() const noexcept { return stamp_ns_.has_value(); }
  /// Of the last measurement that differed. Precondition: on.
  std::int64_t stamp_ns() const { return *stamp_ns_; }
  Wrong wrong() const noexcept { return wrong_; }
  /// All that differed up to now.
  double total() const noexcept { return before_ + last_; }

  /// Variance that the stretch since the reference adds to the sum, if who was found right is so but for a chance of `doubt`.
  double growth(double doubt) const noexcept;

 private:
  double before_ = 0.0;  // up to the reference
  double last_ = 0.0;    // since
  std::int64_t reference_ns_ = 0;
  std::optional<std::int64_t> stamp_ns_;
  Wrong wrong_ = Wrong::kOdometry;
};

}  // namespace panvo::localizer
