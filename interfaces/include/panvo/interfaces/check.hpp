// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace panvo::interfaces {

/// Farther from its origin than any map or projected frame on Earth reaches (UTM: 1e7 m), and a double still resolves 15 nm there.
inline constexpr double kFarthest_m = 1e8;
/// Beyond what anything on wheels, tracks or wings does; twists are rates of these.
inline constexpr double kFastest = 1e4;
/// The square of what a covariance can mean: 3e7 m. "Not known" is written as 1e6 to 1e12 by ROS nodes; DBL_MAX overflows in every product.
inline constexpr double kLargestVariance = 1e15;
/// The square of what a sensor can measure: a micrometre, a microradian. Less is not a measurement, and outweighs all others.
inline constexpr double kSmallestVariance = 1e-12;
/// Of a quaternion's or bearing's length from 1.
inline constexpr double kUnitTolerance = 1e-3;
/// Of texts that name something (a frame, a state, an encoding), and of those that explain something.
inline constexpr std::size_t kLongestName = 256;
inline constexpr std::size_t kLongestText = 65536;

/// Where a value is: "pose.covariance" is member "covariance" of "pose".
struct MemberName {
  MemberName(std::string_view a_member) : member(a_member) {}       // NOLINT(google-explicit-constructor): a plain name
  MemberName(const char* a_member) : member(a_member) {}            // NOLINT(google-explicit-constructor)
  MemberName(std::string_view a_parent, std::string_view a_member)  // of a message in a message
      : parent(a_parent), member(a_member) {}
  std::string_view parent, member;
};

/// What values may be, one rule after another; the first that is broken is kept. Its text names member and rule and never a value, so that there
/// are few texts and they can be counted. Costs nothing but the comparisons while all holds.
class Check {
 public:
  /// "<name> <broken>": `broken` says what is wrong.
  Check& require(bool holds, MemberName name, std::string_view broken);

  Check& finite(MemberName name, std::span<const double> values);
  Check& finite(MemberName name, std::span<const float> values);
  Check& finite(MemberName name, std::initializer_list<double> values);
  /// Each is finite and no farther from 0 than `largest`.
  Check& bounded(MemberName name, std::span<const double> values, double largest);
  Check& bounded(MemberName name, std::initializer_list<double> values, double largest);
  /// Within both, which belong to it; not a NaN.
  Check& within(MemberName name, double value, double least, double most);
  Check& quaternion(MemberName name, double x, double y, double z, double w);
  /// Row-major, symmetric, positive semidefinite up to rounding, no variance beyond kLargestVariance. All zeros: not known, as ROS has it.
  Check& covariance(MemberName name, std::span<const double> row_major);
  /// One that says how good a measurement is: each variance at least kSmallestVariance, too.
  Check& measured_covariance(MemberName name, std::span<const double> row_major);
  Check& at_most(MemberName name, std::size_t size, std::size_t most);
  Check& name(MemberName name, std::string_view text) { return at_most(name, text.size(), kLongestName); }
  Check& text(MemberName name, std::string_view text) { return at_most(name, text.size(), kLongestText); }

  /// Whether nothing is wrong so far: before a loop that needs what was checked.
  bool holds() const noexcept { return !problem_; }
  /// What is wrong: "pose.covariance is not finite"; nullopt: nothing.
  const std::optional<std::string>& problem() const noexcept { return problem_; }

 private:
  Check& fail(MemberName name, std::string_view broken);

  std::optional<std::string> problem_;
};

}  // namespace panvo::interfaces
