// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "panvo/conversions/result.hpp"
#include "panvo/conversions/transform_listener.hpp"
#include "panvo/runtime/logger.hpp"

namespace panvo::conversions {

/// Pose of one sensor on the vehicle. Its frame is that of its first message: messages with another one are another
/// sensor's.
class SensorMount {
 public:
  /// base_from_sensor by /tf_static; without a transform the identity, with a warning that names what is assumed. The
  /// reason for a message of another sensor. `topic`: resolved name, for the log.
  Result<Eigen::Isometry3d> find(const std::string& topic, const std::string& base, const std::string& frame,
                                 const TransformListener& transforms, const runtime::Logger& log,
                                 const std::string& assumption);
  bool has_frame() const noexcept { return frame_.has_value(); }

 private:
  std::optional<std::string> frame_;
  bool has_warned_ = false;
};

}  // namespace panvo::conversions
