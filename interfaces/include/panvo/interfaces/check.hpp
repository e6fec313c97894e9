// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace panvo::interfaces {

/// Limit of coordinates, m. Beyond any map or projected frame on Earth (UTM: 1e7 m); a double still resolves 15 nm
/// there.
inline constexpr double kMaxCoordinate_m = 1e8;
/// Limit of the components of twists (m/s, rad/s) and accelerations (m/s^2). No vehicle reaches it.
inline constexpr double kMaxRate = 1e4;
/// Largest valid variance, the square of 3e7 m or rad. ROS nodes write 1e6 to 1e12 for "unknown"; DBL_MAX would
/// overflow in every product.
inline constexpr double kMaxVariance = 1e15;
/// Smallest valid variance of a measurement, the square of a micrometre or microradian. A smaller one would outweigh
/// all other measurements.
inline constexpr double kMinVariance = 1e-12;
/// Allowed deviation of the length of a quaternion or bearing from 1.
inline constexpr double kUnitTolerance = 1e-3;
/// Maximum length of a name (of a frame, state or encoding), bytes.
inline constexpr std::size_t kMaxNameLength = 256;
/// Maximum length of an explanatory text, bytes.
inline constexpr std::size_t kMaxTextLength = 65536;

/// Path of a value in a message: "pose.covariance" is member "covariance" of "pose".
struct MemberName {
  MemberName(std::string_view a_member) : member(a_member) {}       // NOLINT(google-explicit-constructor): a plain name
  MemberName(const char* a_member) : member(a_member) {}            // NOLINT(google-explicit-constructor)
  MemberName(std::string_view a_parent, std::string_view a_member)  // of a nested message
      : parent(a_parent), member(a_member) {}
  std::string_view parent, member;
};

/// Checks values against rules and keeps the first violation. The text names member and rule but never a value, so that
/// there are few different texts and they can be counted. Valid values cost only the comparisons.
class Check {
 public:
  /// If not `holds`, the violation is "<name> <broken>", e.g. "id is 0".
  Check& require(bool holds, MemberName name, std::string_view broken);

  Check& finite(MemberName name, std::span<const double> values);
  Check& finite(MemberName name, std::span<const float> values);
  Check& finite(MemberName name, std::initializer_list<double> values);
  /// Every value is finite and within +-`largest`.
  Check& bounded(MemberName name, std::span<const double> values, double largest);
  Check& bounded(MemberName name, std::initializer_list<double> values, double largest);
  /// `value` is from `least` to `most`, limits included, and not NaN.
  Check& within(MemberName name, double value, double least, double most);
  /// Length 1 up to kUnitTolerance.
  Check& quaternion(MemberName name, double x, double y, double z, double w);
  /// Row-major, at most 6x6: symmetric, positive semidefinite up to rounding, no variance above kMaxVariance. All
  /// zeros are valid and mean unknown, as in ROS.
  Check& covariance(MemberName name, std::span<const double> row_major);
  /// A covariance whose variances are all at least kMinVariance.
  Check& measured_covariance(MemberName name, std::span<const double> row_major);
  Check& at_most(MemberName name, std::size_t size, std::size_t most);
  Check& name(MemberName name, std::string_view text) { return at_most(name, text.size(), kMaxNameLength); }
  Check& text(MemberName name, std::string_view text) { return at_most(name, text.size(), kMaxTextLength); }

  /// Whether there is no violation so far. Ask before a loop that relies on checked sizes.
  bool holds() const noexcept { return !problem_; }
  /// The first violation, e.g. "pose.covariance is not finite"; nullopt if there is none.
  const std::optional<std::string>& problem() const noexcept { return problem_; }

 private:
  Check& fail(MemberName name, std::string_view broken);

  std::optional<std::string> problem_;
};

}  // namespace panvo::interfaces
