// SPDX-License-Identifier: Apache-2.0
#include "last_pose.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>
#include <span>
#include <stdexcept>

#include "number_lines.hpp"
#include "panvo/interfaces/check.hpp"
#include "panvo/localizer/dead_reckoning.hpp"

namespace panvo::localizer {
namespace {

constexpr double kMinSpeed = 0.5;  // m/s: a stationary vehicle may start
constexpr double kTurnRate = 0.3;  // rad/s, of a vehicle in a bend
constexpr double kTilt = 0.05;     // rad

/// Applies the rules of odometry messages, the origin of the values.
void check_numbers(interfaces::Check& check, std::span<const double> position, std::span<const double> covariance,
                   double speed_m_per_s) {
  check.bounded("position", position, interfaces::kMaxCoordinate_m);
  check.covariance("covariance", covariance);
  check.within("speed_m_per_s", speed_m_per_s, 0.0, interfaces::kMaxRate);
}

LastPose from_lines(const Lines& lines) {
  LastPose last;
  last.stamp_ns = numbers<std::int64_t>(lines, "stamp_ns", 1)[0];
  last.speed_m_per_s = numbers<double>(lines, "speed_m_per_s", 1)[0];
  const auto frame = lines.find("map_frame");
  if (frame != lines.end()) last.map_frame = frame->second;
  const auto position = numbers<double>(lines, "position", 3);
  const auto orientation = numbers<double>(lines, "orientation", 4);  // x, y, z, w
  const auto covariance = numbers<double>(lines, "covariance", 36);
  const Eigen::Map<const Eigen::Quaterniond> rotation(orientation.data());
  interfaces::Check check;
  check.quaternion("orientation", rotation.x(), rotation.y(), rotation.z(), rotation.w());
  check_numbers(check, position, covariance, last.speed_m_per_s);
  if (check.problem()) throw std::runtime_error(*check.problem());
  last.pose.map_from_base = Eigen::Isometry3d(rotation.normalized());
  last.pose.map_from_base.translation() = Eigen::Map<const Eigen::Vector3d>(position.data());
  last.pose.covariance = Eigen::Map<const vision::Matrix6d>(covariance.data());
  return last;
}

/// Numbers in the shortest form that reads back exactly.
std::string file_text(const LastPose& last) {
  const Eigen::Vector3d position = last.pose.map_from_base.translation();
  const Eigen::Quaterniond rotation(last.pose.map_from_base.linear());
  return fmt::format(
      "map_frame {}\nstamp_ns {}\nspeed_m_per_s {}\nposition {} {} {}\norientation {} {} {} {}\ncovariance {}\n",
      last.map_frame, last.stamp_ns, last.speed_m_per_s, position.x(), position.y(), position.z(), rotation.x(),
      rotation.y(), rotation.z(), rotation.w(), fmt::join(std::span(last.pose.covariance.data(), 36), " "));
}

}  // namespace

PoseInMap after_gap(const LastPose& last, double gap_s) {
  const double way_m = std::max(last.speed_m_per_s, kMinSpeed) * gap_s;
  const double turn_rad = std::min(kTurnRate * gap_s, std::numbers::pi);
  vision::Vector6d sigma;
  sigma << way_m, way_m, kClimb * way_m, kTilt, kTilt, turn_rad;
  PoseInMap now = last.pose;
  now.covariance.diagonal() += sigma.cwiseAbs2();
  return now;
}

void write_last_pose(const std::filesystem::path& file, const LastPose& last) {
  interfaces::Check check;
  const Eigen::Vector3d position = last.pose.map_from_base.translation();
  check_numbers(check, std::span(position.data(), 3), std::span(last.pose.covariance.data(), 36), last.speed_m_per_s);
  if (check.problem()) {
    throw std::runtime_error(fmt::format("{} not written, invalid pose: {}", file.string(), *check.problem()));
  }
  write_lines(file, file_text(last));
}

std::optional<LastPose> read_last_pose(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  try {
    return from_lines(read_lines(file));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{} contains no valid pose: {}; delete the file, a new one will be written",
                                         file.string(), error.what()));
  }
}

}  // namespace panvo::localizer
