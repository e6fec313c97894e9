// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "component_parameters.hpp"
#include "gnss_messages.hpp"
#include "panvo/conversions/sensor_mount.hpp"
#include "panvo/conversions/transform_listener.hpp"
#include "panvo/interfaces/gnss_topics.hpp"
#include "panvo/localizer/localizer.hpp"
#include "panvo/runtime/context.hpp"

namespace panvo::localizer {

/// gnss/fix -> localizer; gnss/enhanced, the transform from the map to the satellites' frame, and the services fromLL
/// and toLL.
class Satellites {
 public:
  /// All must outlive it.
  Satellites(runtime::Context& context, const ComponentParameters& parameters, Localizer& localizer);

  /// Adds the fixes whose stamps the odometry has reached. True if the pose changed.
  bool work_off();
  /// To be called with each pose of new odometry, also to keep the georeference.
  void publish(std::int64_t stamp_ns, const std::string& base_frame);
  /// To be called after a clock change: forgets the fixes that wait.
  void forget_stamps() { waiting_.clear(); }

 private:
  void on_fix(const sensor_msgs::msg::NavSatFix& message);
  bool begins_anew(const vision::GeoPoint& point);
  void tell(const FixOutcome& outcome);
  void refuse(const std::string& reason);
  void serve();
  void read_georeference();
  void keep_georeference(const LocalizedPose& pose);

  static constexpr std::size_t kMaxWaiting = 200;  // ten seconds of the fastest receivers

  runtime::Context& context_;
  const ComponentParameters& parameters_;
  Localizer& localizer_;
  conversions::TransformListener transforms_;
  runtime::Output<sensor_msgs::msg::NavSatFix> enhanced_;
  runtime::Output<tf2_msgs::msg::TFMessage> tf_;
  std::optional<vision::TangentPlane> plane_;  // at the first position
  std::optional<vision::TangentPlane> far_;    // at the last position, if that is too far from the first
  // The last one that was stated. East and north of a position without altitude depend on it: a hundred metres of
  // altitude are 8 cm at 5 km from the plane's origin.
  double altitude_m_ = 0.0;
  bool is_origin_known_ = false;  // the plane is that of an earlier journey
  std::deque<GnssFix> waiting_;
  std::optional<std::int64_t> kept_ns_;
  conversions::SensorMount antenna_;
  std::string base_frame_;
  bool has_told_scale_ = false;
};

}  // namespace panvo::localizer
