// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "all_round_messages.hpp"
#include "panvo/all_round_odometry/all_round_odometry.hpp"
#include "panvo/conversions/odometry_listener.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/stage_timer.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_listener.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/component.hpp"
#include "panvo/vision/stamp_sequence.hpp"
#include "panvo/vision/usual_interval.hpp"

namespace panvo::all_round_odometry {

/// odometry/binocular, odometry/quality, compass/points, /tf_static -> odometry/all_round, odometry/all_round_quality.
class AllRoundOdometryComponent final : public runtime::Component {
 public:
  explicit AllRoundOdometryComponent(runtime::Context& context)
      : context_(context),
        parameters_(context.parameters<Parameters>()),
        timer_(context.times()),
        transforms_(context),
        odometry_output_(context.output(topics::kOdometryAllRound)),
        quality_output_(context.output(topics::kOdometryAllRoundQuality)) {
    odometry_.emplace(parameters_, base_from_camera_);
    stereo_input_.emplace(context, [this](const auto& joined) { on_stereo(joined); });
    context.input(topics::kPanoramaPoints, [this](const auto& message) { on_points(*message); });
  }

 private:
  static constexpr int kMaxRefused = 5;  // consecutive stereo poses: their clock was set back, if only a little
  static constexpr std::size_t kMaxWaiting = 100;
  static constexpr double kSilence_s = 0.3, kSilent = 3.0;  // at least, and in intervals

  void on_stereo(const conversions::OdometryJoin::Joined& joined) {
    const auto pose = conversions::to_isometry(joined.odometry->pose().pose());
    if (!pose) return refuse(context_.resolved_name(topics::kOdometryBinocular), pose.reason());
    const StereoPose stereo{conversions::stamp_ns(*joined.odometry), *pose,
                            conversions::to_matrix(joined.odometry->pose().covariance()), joined.quality.is_reliable};
    if (stereo_.size() >= kMaxWaiting) stereo_.erase(stereo_.begin());
    stereo_[stereo.stamp_ns] = joined;
    if (last_) interval_.add(1e-9 * static_cast<double>(stereo.stamp_ns - conversions::stamp_ns(*last_)));
    last_ = joined.odometry;
    stereo_at_ns_ = context_.passing_ns();
    const vision::Stage stage(&timer_, "join");
    const bool is_set_back = stamps_.add(stereo.stamp_ns) == vision::StampOrder::kSetBack;
    if (!odometry_->add(stereo)) {
      if (++refused_ < kMaxRefused && !is_set_back) {
        return refuse(context_.resolved_name(topics::kOdometryBinocular), "is not later than the previous one");
      }
      context_.log().warn("the clock of {} was set back: learning distances again",
                          context_.resolved_name(topics::kOdometryBinocular));
      odometry_->begin_again(stereo, refused_);
      before_.reset();
      stereo_ = {{stereo.stamp_ns, joined}};
    }
    refused_ = 0;
    publish();
  }

  void on_points(const panvo_msgs::msg::PanoramaPoints& message) {
    const auto points = to_points(message);
    if (!points) return refuse(context_.resolved_name(topics::kPanoramaPoints), points.reason());
    if (!last_) return;
    take_mounting(message.header().frame_id());
    const vision::Stage stage(&timer_, "follow");
    odometry_->add(*points, is_stereo_silent(points->stamp_ns));
    publish();
  }

  /// Whether stereo poses have not arrived for several times their usual interval, and are late by their stamps, too:
  /// after a pause of the whole process, both kinds of messages wait, in any order.
  bool is_stereo_silent(std::int64_t panorama_ns) const {
    const double late_s = 1e-9 * static_cast<double>(panorama_ns - conversions::stamp_ns(*last_));
    const double silence_s = 1e-9 * static_cast<double>(context_.passing_ns() - stereo_at_ns_);
    return std::min(late_s, silence_s) > std::max(kSilence_s, kSilent * interval_.median_s());
  }

  /// Learns distances again if the position of the panoramic camera in /tf_static differs from the current one.
  void take_mounting(const std::string& frame) {
    const auto base_from_camera =
        transforms_.lookup(last_->child_frame_id(), frame, "assuming the panoramic camera at the vehicle's origin");
    if (!base_from_camera || base_from_camera->translation().isApprox(base_from_camera_, 1e-9)) return;
    base_from_camera_ = base_from_camera->translation();
    odometry_->set_camera(base_from_camera_);
  }

  void publish() {
    while (const auto pose = odometry_->next()) {
      vision::Vector6d twist = vision::Vector6d::Zero();
      if (before_) {
        twist = vision::se3_log(before_->odom_from_base.inverse() * pose->odom_from_base) * 1e9 /
                static_cast<double>(pose->stamp_ns - before_->stamp_ns);
      }
      const auto stereo = stereo_.find(pose->stamp_ns);
      const bool is_stereo = !pose->agreeing_share && stereo != stereo_.end();
      const auto quality = is_stereo ? stereo->second.quality : conversions::OdometryJoin::Quality{};
      quality_output_.publish(to_quality(*pose, quality, last_->child_frame_id()));
      odometry_output_.publish(to_odometry(*pose, is_stereo ? *stereo->second.odometry : *last_, twist));
      tell(*pose);
      before_ = *pose;
      stereo_.erase(stereo_.begin(), stereo_.upper_bound(pose->stamp_ns));
    }
  }

  void tell(const AllRoundPose& pose) {
    const bool is_by_panoramas = pose.agreeing_share.has_value();
    if (is_by_panoramas && !is_by_panoramas_) {
      context_.log().warn_throttled("blind", "the stereo camera measures no motion: panoramas continue the odometry");
    }
    if (!is_by_panoramas && is_by_panoramas_ && pose.is_reliable) {
      context_.log().info_throttled("sees", "the stereo camera measures the motion again");
    }
    is_by_panoramas_ = is_by_panoramas;
  }

  /// Reports an unusable message in the log and in diagnostics.
  void refuse(const std::string& topic, const std::string& reason) {
    if (context_.rejections().add(topic, reason)) context_.log().warn("{} {}; message skipped", topic, reason);
  }

  runtime::Context& context_;
  const Parameters parameters_;
  conversions::StageTimer timer_;
  conversions::TransformListener transforms_;
  runtime::Output<nav_msgs::msg::Odometry> odometry_output_;
  runtime::Output<panvo_msgs::msg::OdometryQuality> quality_output_;
  Eigen::Vector3d base_from_camera_ = Eigen::Vector3d::Zero();
  std::optional<AllRoundOdometry> odometry_;
  std::optional<conversions::OdometryListener> stereo_input_;
  std::map<std::int64_t, conversions::OdometryJoin::Joined> stereo_;  // by stamp, of poses that are not published yet
  std::shared_ptr<const nav_msgs::msg::Odometry> last_;
  std::int64_t stereo_at_ns_ = 0;   // arrival
  vision::UsualInterval interval_;  // of stereo poses
  std::optional<AllRoundPose> before_;
  bool is_by_panoramas_ = false;
  int refused_ = 0;
  vision::StampSequence stamps_{2};  // few, as each pose that is refused is motion lost
};

PANVO_REGISTER_COMPONENT(AllRoundOdometryComponent)

}  // namespace panvo::all_round_odometry
