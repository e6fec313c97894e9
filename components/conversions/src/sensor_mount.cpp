// SPDX-License-Identifier: Apache-2.0
#include "panvo/conversions/sensor_mount.hpp"

namespace panvo::conversions {

Result<Eigen::Isometry3d> SensorMount::find(const std::string& topic, const std::string& base, const std::string& frame,
                                            const TransformListener& transforms, const runtime::Logger& log,
                                            const std::string& assumption) {
  if (!frame_) frame_ = frame;
  if (*frame_ != frame) {
    return Reason{"comes from several sensors, '" + *frame_ + "' and '" + frame + "': publish one of them"};
  }
  if (frame.empty() || frame == base) return Eigen::Isometry3d(Eigen::Isometry3d::Identity());
  if (const auto known = transforms.buffer().lookup(base, frame)) return *known;
  if (!has_warned_) {
    log.warn("{}: no transform from {} to {} in /tf_static; assuming that {}", topic, base, frame, assumption);
    has_warned_ = true;
  }
  return Eigen::Isometry3d(Eigen::Isometry3d::Identity());
}

}  // namespace panvo::conversions
