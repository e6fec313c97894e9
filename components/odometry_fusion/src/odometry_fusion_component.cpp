// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "fusion_messages.hpp"
#include "panvo/conversions/odometry_listener.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/sensor_mount.hpp"
#include "panvo/conversions/stage_timer.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_listener.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/odometry_fusion/map_anchor.hpp"
#include "panvo/odometry_fusion/odometry_fusion.hpp"
#include "panvo/runtime/component.hpp"
#include "sensor_notices.hpp"

namespace panvo::odometry_fusion {

/// odometry/binocular, odometry/quality, imu/data, wheel/odometry or wheel/twist, and /tf_static -> odometry/fused,
/// odometry/fused_quality; with odometry/enhanced also -> odometry/fast, in the map.
class OdometryFusionComponent final : public runtime::Component {
 public:
  explicit OdometryFusionComponent(runtime::Context& context)
      : context_(context),
        parameters_(context.parameters<FusionParameters>()),
        timer_(context.times()),
        transforms_(context),
        odometry_(context.output(topics::kOdometryFused)),
        quality_(context.output(topics::kOdometryFusedQuality)),
        fast_(context.output(topics::kOdometryFast)),
        fusion_(parameters_),
        gyro_notices_(context.log()),
        wheel_notices_(context.log()),
        yaw_notices_(context.log()) {
    stereo_input_.emplace(context, [this](const auto& joined) { on_stereo(joined); });
    context.input(topics::kImu, [this](const auto& message) { on_imu(*message); });
    context.input(topics::kWheelOdometry, [this](const auto& message) {
      on_wheels(topics::kWheelOdometry.name, message->child_frame_id(), conversions::stamp_ns(*message),
                message->twist());
    });
    context.input(topics::kWheelTwist, [this](const auto& message) {
      on_wheels(topics::kWheelTwist.name, message->header().frame_id(), conversions::stamp_ns(*message),
                message->twist());
    });
    context.input(topics::kOdometryEnhanced, [this](const auto& message) { on_enhanced(message); });
    context.on_end([this] { say_what_was_learned(); });
  }

 private:
  static constexpr int kMaxRefused = 5;  // consecutive stereo poses, after which their clock counts as set back
  static constexpr std::size_t kMaxQualities = 100;

  void on_stereo(const conversions::OdometryJoin::Joined& joined) {
    const auto pose = conversions::to_isometry(joined.odometry->pose().pose());
    if (!pose) return refuse(topics::kOdometryBinocular.name, pose.reason());
    const std::int64_t stamp_ns = conversions::stamp_ns(*joined.odometry);
    const StereoPose stereo{stamp_ns, *pose, conversions::to_matrix(joined.odometry->pose().covariance()),
                            joined.quality.is_reliable};
    if (!fusion_.add(stereo)) {
      if (++refused_ < kMaxRefused) {
        return refuse(topics::kOdometryBinocular.name, "is not later than the previous one, or not finite");
      }
      if (!fusion_.begin_again(stereo, refused_)) {
        return refuse(topics::kOdometryBinocular.name, "is not finite");
      }
      context_.log().warn("the clock of {} was set back: sensors are on trial again",
                          name_of(topics::kOdometryBinocular.name));
      predicted_ns_ = INT64_MIN;
      qualities_.clear();
    }
    refused_ = 0;
    last_stereo_ = joined.odometry;
    qualities_[stamp_ns] = joined.quality;
    if (qualities_.size() > kMaxQualities) qualities_.erase(qualities_.begin());
    publish();
  }

  void on_imu(const sensor_msgs::msg::Imu& message) {
    const auto base_from_imu = base_from(imu_, topics::kImu.name, message.header().frame_id());
    if (!base_from_imu) return;
    const auto sample = to_gyro(message, *base_from_imu);
    if (!sample) return refuse(topics::kImu.name, sample.reason());
    if (!fusion_.add(*sample)) return refuse(topics::kImu.name, "is too old, or has the stamp of another one");
    publish();
    publish_prediction();
  }

  void on_enhanced(const std::shared_ptr<const nav_msgs::msg::Odometry>& message) {
    const auto pose = conversions::to_isometry(message->pose().pose());
    if (!pose) return refuse(topics::kOdometryEnhanced.name, pose.reason());
    // What the localizer publishes between two poses of the odometry has none to start from.
    if (map_anchor_.set(conversions::stamp_ns(*message), *pose, conversions::to_matrix(message->pose().covariance())))
      enhanced_ = message;
  }

  void on_wheels(std::string_view topic, const std::string& frame, std::int64_t stamp_ns,
                 const geometry_msgs::msg::TwistWithCovariance& twist) {
    if (!wheels_.has_frame()) wheel_topic_ = topic;
    if (wheel_topic_ != topic) {
      context_.log().warn_throttled("two wheel topics", "{} is not used, because {} is received, too", name_of(topic),
                                    name_of(wheel_topic_));
      return;
    }
    const auto base_from_wheels = base_from(wheels_, topic, frame);
    if (!base_from_wheels) return;
    const auto sample = to_wheels(stamp_ns, twist, *base_from_wheels);
    if (!sample) return refuse(topic, sample.reason());
    if (!fusion_.add(*sample)) return refuse(topic, "is too old, or has the stamp of another one");
    publish();
  }

  /// Pose of a sensor on the vehicle; without one in /tf_static that of base_link, which the trial against the cameras
  /// then confirms or refutes. nullopt for the message of another sensor, or before the cameras.
  std::optional<Eigen::Isometry3d> base_from(conversions::SensorMount& mount, std::string_view topic,
                                             const std::string& frame) {
    if (!last_stereo_) return std::nullopt;
    const auto found = mount.find(name_of(topic), last_stereo_->child_frame_id(), frame, transforms_, context_.log(),
                                  "their axes are equal");
    if (found) return *found;
    refuse(topic, found.reason());
    return std::nullopt;
  }

  void publish() {
    const vision::Stage stage(&timer_, "fuse");
    while (const auto fused = fusion_.next()) {
      map_anchor_.add(*fused);
      const auto own = qualities_.find(fused->stamp_ns);
      const auto of_stereo = own == qualities_.end() ? conversions::OdometryJoin::Quality{} : own->second;
      qualities_.erase(qualities_.begin(), qualities_.upper_bound(fused->stamp_ns));
      quality_.publish(to_quality(*fused, of_stereo, last_stereo_->child_frame_id()));
      odometry_.publish(to_odometry(*fused, *last_stereo_));
    }
    gyro_notices_.report(name_of(topics::kImu.name), fusion_.gyro());
    wheel_notices_.report(name_of(wheel_topic_), fusion_.wheels());
    yaw_notices_.report("yaw rates of " + name_of(wheel_topic_), fusion_.wheel_yaw());
  }

  void publish_prediction() {
    const auto predicted = fusion_.predicted();
    if (!predicted || predicted->stamp_ns <= predicted_ns_) return;
    const auto in_map = map_anchor_.in_map(*predicted);
    if (!in_map) return;
    predicted_ns_ = predicted->stamp_ns;
    fast_.publish(to_odometry(*in_map, *enhanced_));
  }

  void say_what_was_learned() const {
    const auto& learned = fusion_.filter().learned();
    const Eigen::Vector3d bias = fusion_.gyro_bias();
    if (imu_.has_frame() && fusion_.gyro().fault.empty()) {
      context_.log().info("gyroscope: bias {:.4f} {:.4f} {:.4f} rad/s{}", bias.x(), bias.y(), bias.z(),
                          fusion_.gyro().is_used ? "" : "; not used, because the vehicle has not turned enough");
    }
    if (fusion_.wheels().is_used) {
      context_.log().info("wheels: {:+.2f} % farther than they measure, {:.0f} ms late", 100.0 * learned[kWheelScale],
                          1000.0 * fusion_.wheels_late_s());
    }
  }

  std::string name_of(std::string_view topic) const { return context_.resolved_name(topic); }

  /// Reports an unusable message in the log and in diagnostics.
  void refuse(std::string_view topic, const std::string& reason) {
    if (context_.rejections().add(name_of(topic), reason))
      context_.log().warn("{} {}; message skipped", name_of(topic), reason);
  }

  runtime::Context& context_;
  const FusionParameters parameters_;
  conversions::StageTimer timer_;
  conversions::TransformListener transforms_;
  runtime::Output<nav_msgs::msg::Odometry> odometry_;
  runtime::Output<panvo_msgs::msg::OdometryQuality> quality_;
  runtime::Output<nav_msgs::msg::Odometry> fast_;
  OdometryFusion fusion_;
  MapAnchor map_anchor_;
  std::shared_ptr<const nav_msgs::msg::Odometry> enhanced_;  // of which map_anchor_ is
  std::int64_t predicted_ns_ = INT64_MIN;                    // stamp of the last prediction
  SensorNotices gyro_notices_, wheel_notices_, yaw_notices_;
  std::optional<conversions::OdometryListener> stereo_input_;
  conversions::SensorMount imu_, wheels_;
  std::string_view wheel_topic_ = topics::kWheelOdometry.name;  // of the first message
  std::shared_ptr<const nav_msgs::msg::Odometry> last_stereo_;
  std::map<std::int64_t, conversions::OdometryJoin::Quality> qualities_;  // by stamp, of poses that are not fused yet
  int refused_ = 0;
};

PANVO_REGISTER_COMPONENT(OdometryFusionComponent)

}  // namespace panvo::odometry_fusion
