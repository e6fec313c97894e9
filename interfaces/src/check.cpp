// SPDX-License-Identifier: Apache-2.0
#include "panvo/interfaces/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace panvo::interfaces {
namespace {

constexpr std::size_t kMaxCovariance = 6;  // rows
// Tolerance of a correlation, for rounding by single precision and by the composition of poses.
constexpr double kRounding = 1e-6;
// Precision of a small variance, relative to the largest, after a rotation has mixed the two.
constexpr double kMixed = 1e-15;

template <class Number>
bool are_finite(std::span<const Number> values) {
  return std::ranges::all_of(values, [](Number value) { return std::isfinite(value); });
}

bool are_bounded(std::span<const double> values, double largest) {
  return std::ranges::all_of(values, [&](double value) { return std::abs(value) <= largest; });  // false for NaN
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

template <class Values>
std::span<const double> span_of(const Values& values) {
  return {values.begin(), values.size()};
}

class Covariance {
 public:
  explicit Covariance(std::span<const double> row_major)
      : values_(row_major),
        rows_(static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(row_major.size()))))) {
    for (std::size_t i = 0; i < rows_; ++i) largest_ = std::max(largest_, at(i, i));
  }

  double min_variance() const {
    double smallest = largest_;
    for (std::size_t i = 0; i < rows_; ++i) smallest = std::min(smallest, at(i, i));
    return smallest;
  }
  double max_variance() const noexcept { return largest_; }
  double mixed_in() const noexcept { return kMixed * largest_; }

  bool is_symmetric() const {
    double largest = 0.0, difference = 0.0;
    for (std::size_t i = 0; i < rows_; ++i) {
      for (std::size_t j = 0; j < rows_; ++j) {
        largest = std::max(largest, std::abs(at(i, j)));
        difference = std::max(difference, std::abs(at(i, j) - at(j, i)));
      }
    }
    return difference <= kRounding * largest;
  }

  /// Cholesky decomposition of the correlations, so that metres, radians and huge "unknown" variances can be mixed.
  bool is_positive_semidefinite() const {
    std::array<double, kMaxCovariance> sigma{};
    for (std::size_t i = 0; i < rows_; ++i) sigma[i] = std::sqrt(std::max(at(i, i), mixed_in()));
    std::array<std::array<double, kMaxCovariance>, kMaxCovariance> lower{};
    for (std::size_t i = 0; i < rows_; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        double rest = i == j ? 1.0 + kRounding : 0.5 * (at(i, j) + at(j, i)) / (sigma[i] * sigma[j]);
        for (std::size_t k = 0; k < j; ++k) rest -= lower[i][k] * lower[j][k];
        if (i == j && !(rest > 0.0)) return false;
        lower[i][j] = i == j ? std::sqrt(rest) : rest / lower[j][j];
      }
    }
    return true;
  }

 private:
  double at(std::size_t row, std::size_t column) const { return values_[row * rows_ + column]; }

  std::span<const double> values_;
  std::size_t rows_;
  double largest_ = 0.0;
};

bool are_zero(std::span<const double> values) {
  return std::ranges::all_of(values, [](double value) { return value == 0.0; });
}

}  // namespace

Check& Check::fail(MemberName name, std::string_view broken) {
  std::string text(name.parent);
  if (!text.empty() && !name.member.empty()) text += '.';
  text += name.member;
  text += ' ';
  text += broken;
  problem_ = std::move(text);
  return *this;
}

Check& Check::require(bool holds, MemberName name, std::string_view broken) {
  return problem_ || holds ? *this : fail(name, broken);
}

Check& Check::finite(MemberName name, std::span<const double> values) {
  return problem_ || are_finite(values) ? *this : fail(name, "is not finite");
}

Check& Check::finite(MemberName name, std::span<const float> values) {
  return problem_ || are_finite(values) ? *this : fail(name, "is not finite");
}

Check& Check::finite(MemberName name, std::initializer_list<double> values) { return finite(name, span_of(values)); }

Check& Check::bounded(MemberName name, std::span<const double> values, double largest) {
  if (problem_ || are_bounded(values, largest)) return *this;
  return fail(name, are_finite(values) ? "is beyond +-" + number(largest) : "is not finite");
}

Check& Check::bounded(MemberName name, std::initializer_list<double> values, double largest) {
  return bounded(name, span_of(values), largest);
}

Check& Check::within(MemberName name, double value, double least, double most) {
  if (problem_ || (value >= least && value <= most)) return *this;
  return fail(name,
              std::isfinite(value) ? "is not between " + number(least) + " and " + number(most) : "is not finite");
}

Check& Check::quaternion(MemberName name, double x, double y, double z, double w) {
  if (problem_) return *this;
  const double length = std::hypot(std::hypot(x, y), std::hypot(z, w));
  if (std::abs(length - 1.0) <= kUnitTolerance) return *this;
  return fail(name, std::isfinite(length) ? "is not a unit quaternion" : "is not finite");
}

Check& Check::covariance(MemberName name, std::span<const double> row_major) {
  if (problem_ || are_zero(row_major)) return *this;
  if (!are_finite(row_major)) return fail(name, "is not finite");
  const Covariance covariance(row_major);
  if (covariance.min_variance() < -covariance.mixed_in()) return fail(name, "has a negative variance");
  if (covariance.max_variance() > kMaxVariance) {
    return fail(name, "has a variance above " + number(kMaxVariance));
  }
  if (!covariance.is_symmetric()) return fail(name, "is not symmetric");
  if (!covariance.is_positive_semidefinite()) return fail(name, "is not positive semidefinite");
  return *this;
}

Check& Check::measured_covariance(MemberName name, std::span<const double> row_major) {
  covariance(name, row_major);
  if (problem_ || Covariance(row_major).min_variance() >= kMinVariance) return *this;
  return fail(name, "has a variance below " + number(kMinVariance));
}

Check& Check::at_most(MemberName name, std::size_t size, std::size_t most) {
  return problem_ || size <= most ? *this : fail(name, "is longer than " + std::to_string(most));
}

}  // namespace panvo::interfaces
