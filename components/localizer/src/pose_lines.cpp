// SPDX-License-Identifier: Apache-2.0
#include "pose_lines.hpp"

#include <fmt/ranges.h>

#include <span>

#include "panvo/interfaces/check.hpp"

namespace panvo::localizer {

std::optional<std::string> problem_of(const PoseInMap& pose) {
  const Eigen::Vector3d position = pose.map_from_base.translation();
  interfaces::Check check;
  check.bounded("position", std::span(position.data(), 3), interfaces::kMaxCoordinate_m);
  check.covariance("covariance", std::span(pose.covariance.data(), 36));
  return check.problem();
}

std::string to_lines(const PoseInMap& pose) {
  const Eigen::Vector3d position = pose.map_from_base.translation();
  const Eigen::Quaterniond rotation(pose.map_from_base.linear());
  return fmt::format("position {} {} {}\norientation {} {} {} {}\ncovariance {}\n", position.x(), position.y(),
                     position.z(), rotation.x(), rotation.y(), rotation.z(), rotation.w(),
                     fmt::join(std::span(pose.covariance.data(), 36), " "));
}

PoseInMap pose_of(const Lines& lines) {
  const auto position = numbers<double>(lines, "position", 3);
  const auto orientation = numbers<double>(lines, "orientation", 4);
  const auto covariance = numbers<double>(lines, "covariance", 36);
  const Eigen::Map<const Eigen::Quaterniond> rotation(orientation.data());
  interfaces::Check check;
  check.quaternion("orientation", rotation.x(), rotation.y(), rotation.z(), rotation.w());
  if (check.problem()) throw std::runtime_error(*check.problem());
  PoseInMap pose;
  pose.map_from_base = Eigen::Isometry3d(rotation.normalized());
  pose.map_from_base.translation() = Eigen::Map<const Eigen::Vector3d>(position.data());
  pose.covariance = Eigen::Map<const vision::Matrix6d>(covariance.data());
  if (const auto problem = problem_of(pose)) throw std::runtime_error(*problem);
  return pose;
}

}  // namespace panvo::localizer
