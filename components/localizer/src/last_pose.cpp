// SPDX-License-Identifier: Apache-2.0
#include "last_pose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "panvo/interfaces/check.hpp"
#include "panvo/interfaces/stamp_range.hpp"
#include "panvo/localizer/dead_reckoning.hpp"
#include "pose_lines.hpp"

namespace panvo::localizer {
namespace {

constexpr double kMinSpeed = 0.5;  // m/s: a stationary vehicle may start
constexpr double kTurnRate = 0.3;  // rad/s, of a vehicle in a bend
constexpr double kTilt = 0.05;     // rad

const FileKind kLastPoseFile{"pose",
                             {"map_frame", "stamp_ns", "speed_m_per_s", "position", "orientation", "covariance"}};

std::optional<std::string> problem_of_last(const LastPose& last) {
  interfaces::Check check;
  check.require(last.stamp_ns > -interfaces::kEndOfStamps_ns && last.stamp_ns < interfaces::kEndOfStamps_ns, "stamp_ns",
                "is out of the range of stamps");
  check.within("speed_m_per_s", last.speed_m_per_s, 0.0, interfaces::kMaxRate);
  return check.problem() ? check.problem() : problem_of(last.pose);
}

LastPose from_lines(const Lines& lines) {
  LastPose last;
  last.stamp_ns = numbers<std::int64_t>(lines, "stamp_ns", 1)[0];
  last.speed_m_per_s = numbers<double>(lines, "speed_m_per_s", 1)[0];
  const auto frame = lines.find("map_frame");
  if (frame != lines.end()) last.map_frame = frame->second;
  last.pose = pose_of(lines);
  if (const auto problem = problem_of_last(last)) throw std::runtime_error(*problem);
  return last;
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
  if (const auto problem = problem_of_last(last)) {
    throw std::runtime_error(fmt::format("{} not written, invalid pose: {}", file.string(), *problem));
  }
  write_kept(file, kLastPoseFile,
             fmt::format("map_frame {}\nstamp_ns {}\nspeed_m_per_s {}\n{}", last.map_frame, last.stamp_ns,
                         last.speed_m_per_s, to_lines(last.pose)));
}

std::optional<LastPose> read_last_pose(const std::filesystem::path& file) {
  return read_kept(file, kLastPoseFile, from_lines);
}

}  // namespace panvo::localizer
