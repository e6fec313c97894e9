// SPDX-License-Identifier: Apache-2.0
#include "odometry_lines.hpp"

#include <array>
#include <cmath>
#include <cstdlib>

#include "panvo/runtime/parameters.hpp"

namespace panvo::runner {
namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;

std::int64_t stamp_ns(const nav_msgs::msg::Odometry& odometry) {
  const auto& stamp = odometry.header().stamp();
  return std::int64_t{stamp.sec()} * kSecondNs + stamp.nanosec();
}

/// Appends numbers until one is not finite.
class Line {
 public:
  Line(std::string begin, char separator) : text_(std::move(begin)), separator_(separator) {}

  template <class Numbers>
  void add(const Numbers& numbers) {
    for (const double number : numbers) {
      text_ += separator_ + runtime::to_text(number);
      finite_ = finite_ && std::isfinite(number);
    }
  }

  std::optional<std::string> take() { return finite_ ? std::optional(std::move(text_)) : std::nullopt; }

 private:
  std::string text_;
  char separator_;
  bool finite_ = true;
};

}  // namespace

std::string stamp_text(std::int64_t stamp_ns) {
  const auto whole = std::to_string(std::abs(stamp_ns / kSecondNs));
  const auto decimals = std::to_string(std::abs(stamp_ns % kSecondNs));
  return (stamp_ns < 0 ? "-" : "") + whole + "." + std::string(9 - decimals.size(), '0') + decimals;
}

std::optional<std::string> tum_line(const nav_msgs::msg::Odometry& odometry) {
  const auto& p = odometry.pose().pose().position();
  const auto& q = odometry.pose().pose().orientation();
  Line line(stamp_text(stamp_ns(odometry)), ' ');
  line.add(std::array{p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()});
  return line.take();
}

std::string covariance_header() {
  std::string header = "stamp_ns";
  for (const char part : {'p', 't'}) {
    for (const char row : {'0', '1', '2', '3', '4', '5'}) {
      for (const char column : {'0', '1', '2', '3', '4', '5'}) {
        header += {',', part, row, column};
      }
    }
  }
  return header + ",vx,vy,vz,wx,wy,wz";
}

std::optional<std::string> covariance_line(const nav_msgs::msg::Odometry& odometry) {
  const auto& v = odometry.twist().twist().linear();
  const auto& w = odometry.twist().twist().angular();
  Line line(std::to_string(stamp_ns(odometry)), ',');
  line.add(odometry.pose().covariance());
  line.add(odometry.twist().covariance());
  line.add(std::array{v.x(), v.y(), v.z(), w.x(), w.y(), w.z()});
  return line.take();
}

}  // namespace panvo::runner
