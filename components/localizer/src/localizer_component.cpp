// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>

#include "alignment_notices.hpp"
#include "component_parameters.hpp"
#include "last_pose_keeper.hpp"
#include "localizer_messages.hpp"
#include "odometry_clock.hpp"
#include "panorama_queue.hpp"
#include "panvo/conversions/odometry_listener.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/stage_timer.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/interfaces/time_topics.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/localizer/localizer.hpp"
#include "panvo/localizer/odometry_origin.hpp"
#include "panvo/localizer/soundness.hpp"
#include "panvo/runtime/component.hpp"
#include "panvo/vision/seconds.hpp"
#include "path_record.hpp"
#include "pose_publisher.hpp"
#include "satellites.hpp"
#include "self_calibration_keeper.hpp"

namespace panvo::localizer {

/// odometry/binocular, odometry/quality, compass/azimuth_change, correction, landmarks, gnss/fix, /initialpose ->
/// odometry/enhanced, /tf, localization/state, localization/integrity, correction/outcome, landmarks/poses, path/*,
/// panorama/time_reference, gnss/enhanced. Odometry waits for its quality; measurements of a panorama wait until odometry reaches its stamp.
class LocalizerComponent final : public runtime::Component {
 public:
  explicit LocalizerComponent(runtime::Context& context)
      : context_(context),
        parameters_(context.parameters<ComponentParameters>()),
        timer_(context.times()),
        localizer_(parameters_.fusion),
        last_pose_(parameters_, context.is_again(), context.log()),
        self_calibration_(context, parameters_.self_calibration_file, localizer_),
        notices_(context.log()),
        path_binocular_(parameters_.path_step_m, parameters_.path_period_s),
        path_enhanced_(parameters_.path_step_m, parameters_.path_period_s),
        publisher_(context, parameters_),
        satellites_(context, parameters_, localizer_),
        outcome_(context.output(topics::kCorrectionOutcome)),
        poses_(context.output(topics::kLandmarkPoses)),
        panorama_time_(context.output(topics::kPanoramaTimeReference)),
        path_binocular_output_(context.output(topics::kPathBinocular)),
        path_enhanced_output_(context.output(topics::kPathEnhanced)) {
    odometry_input_.emplace(context, [this](const auto& joined) { on_odometry(joined); });
    context.input(topics::kLandmarks, [this](const auto& message) { on_landmark(*message); });
    context.input(topics::kAzimuthChange, [this](const auto& message) { on_azimuth(*message); });
    context.input(topics::kCorrection, [this](const auto& message) { on_correction(*message); });
    context.input(topics::kInitialPose, [this](const auto& message) { on_initial_pose(*message); });
    context.every(std::chrono::milliseconds(kTick_ms), [this] { on_tick(); });
  }

 private:
  static constexpr int kTick_ms = 100;
  static constexpr std::int64_t kNotableOffset_ns = 20'000'000;  // a vehicle moves a few centimetres in that time
  static constexpr double kOfNow_s = 0.4;  // largest age of odometry whose stamps are of the host's clock

  /// The odometry's clock was set back, or forward if negative: shifts all stored stamps. What waits is of the time
  /// before.
  void set_clock_back(std::int64_t by_ns) {
    localizer_.set_clock_back(by_ns);
    if (by_ns > 0) *begin_ns_ -= by_ns;  // else landmarks of this journey may still come with earlier stamps
    azimuth_ns_.reset();
    is_panorama_time_told_ = false;
    waiting_.clear();
    satellites_.forget_stamps();
    publisher_.forget_stamps();
    context_.log().warn("the clock of {} was set {} by {:.1f} s: continuing with the new time",
                        context_.resolved_name(topics::kOdometryBinocular), by_ns > 0 ? "back" : "forward",
                        std::abs(static_cast<double>(by_ns)) / vision::kSecond_ns);
  }

  /// Reports an unusable message in the log and in diagnostics.
  void refuse(std::string_view topic, const std::string& reason) {
    if (context_.rejections().add(topic, reason)) context_.log().warn("{} {}; message skipped", topic, reason);
  }

  void on_odometry(const conversions::OdometryJoin::Joined& joined) {
    const auto& message = *joined.odometry;
    const auto pose = conversions::to_isometry(message.pose().pose());
    if (!pose) return refuse(context_.resolved_name(topics::kOdometryBinocular), pose.reason());
    const std::int64_t stamp_ns = conversions::stamp_ns(message);
    const auto latest_ns = begin_ns_ ? std::optional(localizer_.latest().stamp_ns) : std::nullopt;
    if (!clock_.add(stamp_ns, context_.passing_ns(), latest_ns)) {
      return refuse(context_.resolved_name(topics::kOdometryBinocular), "has a stamp not later than the previous one");
    }
    if (clock_.set_back_ns() != 0) set_clock_back(clock_.set_back_ns());
    localizer_.correct_set_back(clock_.less_back_ns());
    const auto host_ns = context_.host_ns();
    if (host_ns && std::abs(vision::seconds(stamp_ns, *host_ns)) < kOfNow_s) localizer_.trust_stamps();
    const OdometryPose received{stamp_ns, *pose, conversions::to_matrix(message.pose().covariance()),
                                joined.quality.is_reliable, joined.quality.lean_sigma_rad_per_m};
    {
      const vision::Stage stage(&timer_, "localize");
      const auto outcome = localizer_.add(received);
      if (!outcome.is_taken) return refuse(context_.resolved_name(topics::kOdometryBinocular), outcome.reason);
      if (outcome.has_begun_anew) {
        context_.log().warn("{} restarted from another origin: the pose in the map continues",
                            context_.resolved_name(topics::kOdometryBinocular));
      }
      odometry_at_ns_ = context_.passing_ns();
      last_odometry_ = joined.odometry;
      if (!begin_ns_) {
        begin_ns_ = stamp_ns;
        if (!parameters_.last_pose_file.empty()) context_.about_to_read(parameters_.last_pose_file);
        last_pose_.begin(localizer_, stamp_ns);
      }
      work_off();
    }
    const auto& localized = localizer_.latest();
    publish_pose(true);
    satellites_.publish(stamp_ns, message.child_frame_id());
    publish_paths(stamp_ns, *pose);
    last_pose_.keep(localized, message.twist().twist());
    self_calibration_.keep(stamp_ns);
    notices_.report_missing(localizer_, azimuth_ns_);
  }

  /// In the map's frame, or in that of the vehicle, as viewers publish it that follow the vehicle.
  void on_initial_pose(const geometry_msgs::msg::PoseWithCovarianceStamped& message) {
    const std::string topic = context_.resolved_name(topics::kInitialPose);
    if (!begin_ns_) return context_.log().warn("{} ignored: no odometry received yet", topic);
    const auto& frame = message.header().frame_id();
    const bool is_in_map = frame == parameters_.map_frame;
    if (!is_in_map && frame != last_odometry_->child_frame_id()) {
      return context_.log().warn("{} ignored: frame is '{}', expected '{}' or '{}'", topic, frame,
                                 parameters_.map_frame, last_odometry_->child_frame_id());
    }
    const auto pose = conversions::to_isometry(message.pose().pose());
    if (!pose) return context_.log().warn("{} {}", topic, pose.reason());
    PoseInMap said{*pose, conversions::to_matrix(message.pose().covariance())};
    if (!is_in_map) {
      const Eigen::Isometry3d& map_from_base = localizer_.latest().map_from_base;
      said = {map_from_base * *pose, vision::rotate_covariance(map_from_base.linear(), said.covariance)};
    }
    // A click on a map refers to the present; its stamp, by another clock, is ignored.
    if (!localizer_.set_initial_pose(said, localizer_.latest().stamp_ns)) {
      return context_.log().warn("{} ignored: invalid pose or covariance", topic);
    }
    context_.log().info("{}: position set to ({:.1f}, {:.1f}) m in {}", topic, said.map_from_base.translation().x(),
                        said.map_from_base.translation().y(), parameters_.map_frame);
    publish_pose();
  }

  /// Landmarks stamped before the journey come from a store; the others were built from a panorama of this journey.
  void on_landmark(const panvo_msgs::msg::PanoramicLandmark& message) {
    if (landmarks_.contains(message.id())) return;
    const std::int64_t stamp_ns = conversions::stamp_ns(message);
    if (begin_ns_ && stamp_ns >= *begin_ns_) {
      landmarks_.insert(message.id());
      return wait(Built{message.id(), stamp_ns});
    }
    const auto pose = conversions::to_isometry(message.pose().pose());
    if (!pose)
      return context_.log().warn_throttled(fmt::format("landmark {}", message.id()), "landmark {} {}", message.id(),
                                           pose.reason());
    const vision::Matrix6d covariance = conversions::to_matrix(message.pose().covariance());
    if (const auto fault = fault_of(*pose, covariance))
      return refuse(context_.resolved_name(topics::kLandmarks), *fault);
    landmarks_.insert(message.id());
    localizer_.add_known({message.id(), stamp_ns, *pose, covariance});
  }

  void on_azimuth(const panvo_msgs::msg::AzimuthChange& message) {
    azimuth_ns_ = conversions::stamp_ns(message);
    if (!parameters_.use_compass || !message.valid()) return;
    const auto azimuth = to_azimuth(message);
    const auto fault = fault_of_angle(azimuth.change_rad, azimuth.variance_rad2);
    if (fault) return refuse(context_.resolved_name(topics::kAzimuthChange), *fault);
    wait(azimuth);
  }

  void on_correction(const panvo_msgs::msg::PositionCorrection& message) {
    if (!parameters_.use_corrections || message.state() == panvo_msgs::msg::PositionCorrection_Constants::REJECTED)
      return;
    const auto sighting = to_sighting(message);
    if (!sighting) return refuse(context_.resolved_name(topics::kCorrection), sighting.reason());
    const auto fault = fault_of(sighting->landmark_from_base, sighting->covariance);
    if (fault) return refuse(context_.resolved_name(topics::kCorrection), *fault);
    wait(*sighting);
  }

  void wait(const PanoramaFact& fact) {
    const auto clock = clock_.panoramas_clock(stamp_of(fact), localizer_.latest().stamp_ns);
    if (clock == OdometryClock::PanoramasClock::kAlike) localizer_.trust_stamps();
    if (clock == OdometryClock::PanoramasClock::kAnother) {
      return context_.log().warn_throttled(
          "panoramas of another clock",
          "the clock of {} was set, but not that of the panoramas: they are not used until it is set, too",
          context_.resolved_name(topics::kOdometryBinocular));
    }
    if (!waiting_.push(fact)) {
      context_.log().warn_throttled(
          "panoramas ahead",
          "panorama stamps are {:.1f} s ahead of {}: camera clocks are not synchronised, or no odometry is "
          "received; corrections disabled",
          begin_ns_ ? vision::seconds(localizer_.latest().stamp_ns, stamp_of(fact)) : 0.0,
          context_.resolved_name(topics::kOdometryBinocular));
    }
    work_off();
    if (has_learned_ || (last_odometry_ && publisher_.is_notable(localizer_.latest()))) publish_pose();
  }

  void work_off() {
    while (const auto fact = waiting_.next(localizer_)) {
      std::visit([this](const auto& one) { take(one); }, *fact);
    }
    has_learned_ |= satellites_.work_off();
  }

  void take(const AzimuthMeasurement& azimuth) {
    const auto use = localizer_.add(azimuth);
    if (use == AzimuthUse::kTooEarly) return;  // the compass compares several panoramas with its first one
    if (use == AzimuthUse::kNotUsed) {
      // A single panorama may lack odometry; if all do, a clock is wrong.
      if (++unused_ > 10) {
        context_.log().warn_throttled(
            "panoramas behind",
            "panorama stamps are {:.1f} s behind {}: camera clocks are not synchronised; corrections disabled",
            vision::seconds(azimuth.to_ns, localizer_.latest().stamp_ns),
            context_.resolved_name(topics::kOdometryBinocular));
      }
      return;
    }
    unused_ = 0;
    if (use == AzimuthUse::kDoubted) {
      context_.log().warn_throttled("compass doubted",
                                    "implausible rotation in the panoramas, but not in the stereo odometry: was "
                                    "the panoramic camera rotated on its mount?");
    }
    const bool is_contradicted = use == AzimuthUse::kContradicted;
    if (is_contradicted && !was_contradicted_)
      context_.log().warn("stereo odometry and compass disagree on the rotation: using the compass");
    was_contradicted_ = is_contradicted;
    notices_.report_clock(localizer_, azimuth.to_ns, use);
    publish_panorama_time(azimuth.to_ns);
    notices_.report_direction(localizer_.direction_offset());
  }

  void take(const LandmarkSighting& sighting) {
    const vision::Stage stage(&timer_, "correct");
    const auto correction = localizer_.add(sighting);
    outcome_.publish(to_message(correction, sighting, parameters_.map_frame));
    if (correction.kind == CorrectionKind::kApplied) {
      const Eigen::Vector3d moved =
          correction.map_from_base_after.translation() - correction.map_from_base_before.translation();
      context_.log().info("landmark {} seen: position corrected by {:.2f} m", sighting.landmark_id, moved.norm());
      publish_landmarks(sighting.stamp_ns);
      has_learned_ = true;
    } else if (correction.kind == CorrectionKind::kRejected) {
      context_.log().warn_throttled(fmt::format("landmark {} not believed", sighting.landmark_id),
                                    "landmark {} seen, not applied: {}", sighting.landmark_id, correction.reason);
    }
    notices_.report_mounting(localizer_.mounting());
  }

  void take(const Built& built) {
    if (localizer_.add_built(built.id, built.stamp_ns)) {
      publish_landmarks(built.stamp_ns);
    } else {
      context_.log().warn_throttled("landmark without odometry", "landmark {}: no odometry stored for its stamp",
                                    built.id);
    }
  }

  /// The panoramic camera's clock, once it is known, again after the odometry's was set, and when its offset has changed.
  void publish_panorama_time(std::int64_t panorama_ns) {
    if (!localizer_.is_clock_known()) return;
    const std::int64_t ahead_ns = localizer_.panorama_clock().estimate_ns();
    const bool has_changed = std::abs(ahead_ns - panorama_ahead_ns_) >= kNotableOffset_ns;
    if (is_panorama_time_told_ && !has_changed) return;
    is_panorama_time_told_ = true;
    panorama_ahead_ns_ = ahead_ns;
    panorama_time_.publish(to_time_reference(panorama_ns - ahead_ns, panorama_ns));
    if (has_changed) publish_landmarks(panorama_ns);  // they have moved with it
    has_learned_ |= has_changed;
  }

  void publish_landmarks(std::int64_t stamp_ns) {
    poses_.publish(to_message(localizer_.landmarks(), stamp_ns, parameters_.map_frame));
  }

  void publish_paths(std::int64_t stamp_ns, const Eigen::Isometry3d& stereo) {
    if (path_binocular_.add(stamp_ns, stereo)) {
      path_binocular_output_.publish(path_binocular_.message(parameters_.odom_frame));
    }
    if (path_enhanced_.add(stamp_ns, localizer_.latest().map_from_base)) {
      path_enhanced_output_.publish(path_enhanced_.message(parameters_.map_frame));
    }
  }

  void publish_pose(bool is_of_new_odometry = false) {
    publisher_.publish_pose(localizer_, *last_odometry_, is_of_new_odometry);
    has_learned_ = false;
  }

  /// Runs whether or not messages arrive.
  void on_tick() {
    const double silence_s = begin_ns_ ? vision::seconds(odometry_at_ns_, context_.passing_ns()) : 0.0;
    publisher_.tick(localizer_, silence_s, context_.now_ns());
  }

  runtime::Context& context_;
  const ComponentParameters parameters_;
  conversions::StageTimer timer_;
  Localizer localizer_;
  LastPoseKeeper last_pose_;
  SelfCalibrationKeeper self_calibration_;
  AlignmentNotices notices_;
  std::optional<conversions::OdometryListener> odometry_input_;
  OdometryClock clock_;
  PathRecord path_binocular_, path_enhanced_;
  PosePublisher publisher_;
  Satellites satellites_;
  runtime::Output<panvo_msgs::msg::CorrectionOutcome> outcome_;
  runtime::Output<panvo_msgs::msg::LandmarkPoses> poses_;
  runtime::Output<sensor_msgs::msg::TimeReference> panorama_time_;
  runtime::Output<nav_msgs::msg::Path> path_binocular_output_, path_enhanced_output_;

  PanoramaQueue waiting_;
  std::set<std::uint32_t> landmarks_;
  std::optional<std::int64_t> begin_ns_;  // first stamp of the odometry
  std::int64_t odometry_at_ns_ = 0;       // arrival of the last message
  std::shared_ptr<const nav_msgs::msg::Odometry> last_odometry_;
  std::optional<std::int64_t> azimuth_ns_;
  std::int64_t panorama_ahead_ns_ = 0;  // as published
  bool is_panorama_time_told_ = false;  // since the clock was set
  bool has_learned_ = false;            // not published yet
  int unused_ = 0;
  bool was_contradicted_ = false;
};

PANVO_REGISTER_COMPONENT(LocalizerComponent)

}  // namespace panvo::localizer
