// SPDX-License-Identifier: Apache-2.0
#include "last_pose_keeper.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "panvo/vision/seconds.hpp"

namespace panvo::localizer {
namespace {

constexpr double kKeepPeriod_s = 1.0;

}  // namespace

void LastPoseKeeper::begin(Localizer& localizer, std::int64_t stamp_ns) const {
  const auto last = read();
  if (last && go_on(localizer, *last, stamp_ns)) return;
  if (!is_again_) return;
  std::string reason = "restarted after a crash, no last pose is known";
  if (last) {
    const Eigen::Vector3d position = last->pose.map_from_base.translation();
    reason = fmt::format("restarted after a crash; last known position ({:.1f}, {:.1f}) m in {}, {:.1f} s before",
                         position.x(), position.y(), last->map_frame, vision::seconds(last->stamp_ns, stamp_ns));
  }
  const bool is_of_map = last && last->map_frame == parameters_.map_frame;
  localizer.forget_start(is_of_map ? std::optional(last->pose) : std::nullopt, reason);
}

std::optional<LastPose> LastPoseKeeper::read() const {
  if (parameters_.last_pose_file.empty()) return std::nullopt;
  try {
    return read_last_pose(parameters_.last_pose_file);
  } catch (const std::runtime_error& error) {
    log_.warn("{}", error.what());
  }
  return std::nullopt;
}

bool LastPoseKeeper::go_on(Localizer& localizer, const LastPose& last, std::int64_t stamp_ns) const {
  const double gap_s = vision::seconds(last.stamp_ns, stamp_ns);
  if (last.map_frame != parameters_.map_frame || gap_s < 0.0 || gap_s > parameters_.last_pose_s) {
    log_.info("{}: ignored: frame '{}', age {:.1f} s (last_pose_s: {:.1f})", parameters_.last_pose_file, last.map_frame,
              gap_s, parameters_.last_pose_s);
    return false;
  }
  const auto now = after_gap(last, gap_s);
  if (!localizer.set_initial_pose(now, stamp_ns)) {
    log_.warn("{}: ignored: invalid pose or covariance; delete the file, a new one will be written",
              parameters_.last_pose_file);
    return false;
  }
  const Eigen::Vector3d position = now.map_from_base.translation();
  log_.info("{}: resuming from ({:.1f}, {:.1f}) m, age {:.1f} s", parameters_.last_pose_file, position.x(),
            position.y(), gap_s);
  return true;
}

void LastPoseKeeper::keep(const LocalizedPose& pose, const geometry_msgs::msg::Twist& twist) {
  const bool is_known = pose.state == State::kTracking || pose.state == State::kRelocalised;
  if (parameters_.last_pose_file.empty() || !is_known) return;
  if (kept_ns_ && std::abs(vision::seconds(*kept_ns_, pose.stamp_ns)) < kKeepPeriod_s) return;
  kept_ns_ = pose.stamp_ns;
  const auto& speed = twist.linear();
  try {
    write_last_pose(parameters_.last_pose_file, {pose.stamp_ns,
                                                 parameters_.map_frame,
                                                 {pose.map_from_base, pose.covariance},
                                                 std::hypot(speed.x(), speed.y(), speed.z())});
  } catch (const std::runtime_error& error) {
    log_.warn_throttled("write", "{}", error.what());
  }
}

}  // namespace panvo::localizer
