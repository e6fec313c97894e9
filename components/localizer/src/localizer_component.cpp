// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <variant>

#include "last_pose.hpp"
#include "localizer_messages.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/stage_timer.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/localizer/localizer.hpp"
#include "panvo/runtime/component.hpp"
#include "panvo/runtime/new_warnings.hpp"
#include "path_record.hpp"

namespace panvo::localizer {

/// The algorithm's parameters and the names of the frames.
struct ComponentParameters {
  Parameters fusion;
  bool use_compass = true;
  bool use_corrections = true;
  std::string map_frame = "map";
  std::string odom_frame = "odom";
  double path_step_m = 1.0;
  double path_period_s = 2.0;
  std::string last_pose_file;
  double last_pose_s = 30.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = ComponentParameters;
    field.group(&P::fusion, "fusion");
    field(&P::use_compass, "use_compass", "", "straighten the azimuth by the panoramic compass");
    field(&P::use_corrections, "use_corrections", "",
          "correct the position where a landmark is seen; false: landmarks are only kept");
    field(&P::map_frame, "map_frame", "", "frame of the corrected pose");
    field(&P::odom_frame, "odom_frame", "", "frame in which the vehicle's pose never jumps");
    field(&P::path_step_m, "path_step_m", "m", "between two poses of path/binocular and path/enhanced", 0.01, 1000.0);
    field(&P::path_period_s, "path_period_s", "s", "how often the paths are told", 0.1, 3600.0);
    field(&P::last_pose_file, "last_pose_file", "",
          "where the pose is kept from second to second, and from where a process that is started again goes on; "
          "empty: nowhere");
    field(&P::last_pose_s, "last_pose_s", "s", "how old it may be to go on from it", 0.0, 3600.0);
  }
};

namespace {

constexpr double kSecond_ns = 1e9;

double seconds(std::int64_t from_ns, std::int64_t to_ns) { return static_cast<double>(to_ns - from_ns) / kSecond_ns; }

}  // namespace

/// odometry/binocular, odometry/quality, compass/azimuth_change, correction, landmarks, /initialpose -> odometry/enhanced, /tf, localization/state,
/// correction/outcome, landmarks/poses, path/*. What is said of a panorama waits until odometry has come as far as its stamp.
class LocalizerComponent final : public runtime::Component {
 public:
  explicit LocalizerComponent(runtime::Context& context)
      : context_(context),
        parameters_(context.parameters<ComponentParameters>()),
        timer_(context.times()),
        localizer_(parameters_.fusion),
        path_binocular_(parameters_.path_step_m, parameters_.path_period_s),
        path_enhanced_(parameters_.path_step_m, parameters_.path_period_s),
        odometry_(context.output(topics::kOdometryEnhanced)),
        tf_(context.output(topics::kTf)),
        state_(context.output(topics::kLocalizationState)),
        outcome_(context.output(topics::kCorrectionOutcome)),
        poses_(context.output(topics::kLandmarkPoses)),
        path_binocular_output_(context.output(topics::kPathBinocular)),
        path_enhanced_output_(context.output(topics::kPathEnhanced)) {
    context.input(topics::kOdometryQuality, [this](const auto& message) { on_quality(*message); });
    context.input(topics::kOdometryBinocular, [this](const auto& message) { on_odometry(*message); });
    context.input(topics::kLandmarks, [this](const auto& message) { on_landmark(*message); });
    context.input(topics::kAzimuthChange, [this](const auto& message) { on_azimuth(*message); });
    context.input(topics::kCorrection, [this](const auto& message) { on_correction(*message); });
    context.input(topics::kInitialPose, [this](const auto& message) { on_initial_pose(*message); });
  }

 private:
  struct Built {
    std::uint32_t id = 0;
    std::int64_t stamp_ns = 0;
  };
  using Waiting = std::variant<AzimuthMeasurement, LandmarkSighting, Built>;

  static constexpr std::size_t kMostWaiting = 100;  // things said of panoramas that odometry has not come to
  static constexpr double kStatePeriod_s = 1.0;
  static constexpr double kKeepPeriod_s = 1.0;
  static constexpr double kNoPanorama_s = 10.0;
  static constexpr double kUnlocatedFor_m = 500.0;  // by then a place would have been passed again
  static constexpr double kNotableOffset_s = 0.02;
  static constexpr double kSureOffset_s = 0.004;

  void on_quality(const panvo_msgs::msg::OdometryQuality& message) {
    is_reliable_ = message.reliable();
    outlier_share_ = std::isfinite(message.inlier_ratio()) ? std::clamp(1.0 - message.inlier_ratio(), 0.0, 1.0) : 1.0;
  }

  void on_odometry(const nav_msgs::msg::Odometry& message) {
    const auto pose = conversions::to_isometry(message.pose().pose());
    if (!pose) return warnings_.say(fmt::format("{} {}", topics::kOdometryBinocular.name, pose.reason()));
    const std::int64_t stamp_ns = conversions::stamp_ns(message);
    if (begin_ns_ && stamp_ns <= localizer_.latest().stamp_ns) {
      return warnings_.say(fmt::format("{} came with a stamp that is not after the last; it is left out",
                                       topics::kOdometryBinocular.name));
    }
    {
      const vision::Stage stage(&timer_, "localize");
      localizer_.add(OdometryPose{stamp_ns, *pose, conversions::to_matrix(message.pose().covariance()), is_reliable_,
                                  outlier_share_});
      if (!begin_ns_) begin(stamp_ns);
      work_off();
    }
    const auto& localized = localizer_.latest();
    odometry_.publish(to_odometry(localized, message, parameters_.map_frame));
    tf_.publish(to_transforms(localized, parameters_.map_frame, parameters_.odom_frame, message.child_frame_id()));
    tell_paths(stamp_ns, *pose);
    tell_state(localized);
    keep(localized, message.twist().twist());
    if (localized.state == State::kUnlocated && localizer_.way_m() > kUnlocatedFor_m) {
      warnings_.say(fmt::format("no place of earlier days was recognised in {:.0f} m: are they of another place?",
                                kUnlocatedFor_m));
    }
    if (azimuth_ns_ && seconds(*azimuth_ns_, stamp_ns) > kNoPanorama_s) {
      warnings_.say(
          fmt::format("no panorama for {:.0f} s: the pose drifts as the stereo odometry does", kNoPanorama_s));
    }
  }

  void begin(std::int64_t stamp_ns) {
    begin_ns_ = stamp_ns;
    if (parameters_.last_pose_file.empty()) return;
    try {
      const auto last = read_last_pose(parameters_.last_pose_file);
      if (!last) return;
      const double gap_s = seconds(last->stamp_ns, stamp_ns);
      if (last->map_frame != parameters_.map_frame || gap_s < 0.0 || gap_s > parameters_.last_pose_s) {
        return context_.log().info("{}: not gone on from: in '{}', {:.1f} s before (last_pose_s: {:.1f})",
                                   parameters_.last_pose_file, last->map_frame, gap_s, parameters_.last_pose_s);
      }
      const auto now = after_gap(*last, gap_s);
      if (!localizer_.add_said(now, stamp_ns)) return;
      const Eigen::Vector3d position = now.map_from_base.translation();
      context_.log().info("{}: goes on from ({:.1f}, {:.1f}) m, of {:.1f} s before", parameters_.last_pose_file,
                          position.x(), position.y(), gap_s);
    } catch (const std::runtime_error& error) {
      context_.log().warn("{}", error.what());
    }
  }

  void keep(const LocalizedPose& pose, const geometry_msgs::msg::Twist& twist) {
    const bool is_known = pose.state == State::kTracking || pose.state == State::kRelocalised;
    if (parameters_.last_pose_file.empty() || !is_known) return;
    if (kept_ns_ && seconds(*kept_ns_, pose.stamp_ns) < kKeepPeriod_s) return;
    kept_ns_ = pose.stamp_ns;
    const auto& speed = twist.linear();
    try {
      write_last_pose(parameters_.last_pose_file, {pose.stamp_ns,
                                                   parameters_.map_frame,
                                                   {pose.map_from_base, pose.covariance},
                                                   std::hypot(speed.x(), speed.y(), speed.z())});
    } catch (const std::runtime_error& error) {
      warnings_.say(error.what());
    }
  }

  void on_initial_pose(const geometry_msgs::msg::PoseWithCovarianceStamped& message) {
    const auto& frame = message.header().frame_id();
    if (frame != parameters_.map_frame) {
      return context_.log().warn("{} is in frame '{}' and was left out: give it in '{}'", topics::kInitialPose.name,
                                 frame, parameters_.map_frame);
    }
    const auto pose = conversions::to_isometry(message.pose().pose());
    if (!pose) return context_.log().warn("{} {}", topics::kInitialPose.name, pose.reason());
    if (!begin_ns_) return context_.log().warn("{} was left out: there is no odometry yet", topics::kInitialPose.name);
    // Who clicks on a map means now, and what his clock says is of no use.
    const PoseInMap said{*pose, conversions::to_matrix(message.pose().covariance())};
    if (!localizer_.add_said(said, localizer_.latest().stamp_ns)) {
      return context_.log().warn("{} was left out: its covariance is none", topics::kInitialPose.name);
    }
    context_.log().info("{}: the vehicle is at ({:.1f}, {:.1f}) m in {}", topics::kInitialPose.name,
                        pose->translation().x(), pose->translation().y(), parameters_.map_frame);
    tell_state(localizer_.latest());
  }

  /// One of an earlier day comes before the journey begins, from a store; one of this journey is of a panorama that was taken on it.
  void on_landmark(const panvo_msgs::msg::PanoramicLandmark& message) {
    if (!landmarks_.insert(message.id()).second) return;
    const std::int64_t stamp_ns = conversions::stamp_ns(message);
    if (begin_ns_ && stamp_ns >= *begin_ns_) return wait(Built{message.id(), stamp_ns});
    const auto pose = conversions::to_isometry(message.pose().pose());
    if (!pose) return warnings_.say(fmt::format("landmark {} {}", message.id(), pose.reason()));
    localizer_.add_known({message.id(), stamp_ns, *pose, conversions::to_matrix(message.pose().covariance())});
  }

  void on_azimuth(const panvo_msgs::msg::AzimuthChange& message) {
    azimuth_ns_ = conversions::stamp_ns(message);
    const double ahead_s = begin_ns_ ? seconds(localizer_.latest().stamp_ns, *azimuth_ns_) : 0.0;
    if (ahead_s > parameters_.fusion.patience_s) tell_no_odometry(*azimuth_ns_, ahead_s);
    if (parameters_.use_compass && message.valid()) wait(to_azimuth(message));
  }

  void on_correction(const panvo_msgs::msg::PositionCorrection& message) {
    if (!parameters_.use_corrections || message.state() == "rejected") return;
    const auto sighting = to_sighting(message);
    if (!sighting) return warnings_.say(fmt::format("{} {}", topics::kCorrection.name, sighting.reason()));
    wait(*sighting);
  }

  void wait(Waiting item) {
    waiting_.push_back(std::move(item));
    if (waiting_.size() > kMostWaiting) {
      waiting_.pop_front();
      warnings_.say(fmt::format(
          "stamps of panoramas are {:.1f} s ahead of {}: the clocks of the cameras disagree, or there is no "
          "odometry; no correction",
          begin_ns_ ? seconds(localizer_.latest().stamp_ns, stamp_of(waiting_.back())) : 0.0,
          topics::kOdometryBinocular.name));
    }
    work_off();
  }

  static std::int64_t stamp_of(const Waiting& item) {
    struct {
      std::int64_t operator()(const AzimuthMeasurement& azimuth) const { return azimuth.to_ns; }
      std::int64_t operator()(const LandmarkSighting& sighting) const { return sighting.stamp_ns; }
      std::int64_t operator()(const Built& built) const { return built.stamp_ns; }
    } const stamp;
    return std::visit(stamp, item);
  }

  void work_off() {
    while (!waiting_.empty() && localizer_.reaches(stamp_of(waiting_.front()))) {
      const auto item = waiting_.front();
      waiting_.pop_front();
      std::visit([this](const auto& one) { take(one); }, item);
    }
  }

  void take(const AzimuthMeasurement& azimuth) {
    const auto use = localizer_.add(azimuth);
    if (use == AzimuthUse::kNotUsed) {
      ++unused_;
      // Now and then a panorama has no odometry beside it; all of them have none when a clock is wrong.
      if (unused_ > 10) {
        warnings_.say(
            fmt::format("stamps of panoramas lie {:.1f} s before {}: the clocks of the cameras disagree; no correction",
                        seconds(azimuth.to_ns, localizer_.latest().stamp_ns), topics::kOdometryBinocular.name));
      }
      return;
    }
    unused_ = 0;
    const bool is_contradicted = use == AzimuthUse::kContradicted;
    if (is_contradicted && !was_contradicted_) {
      context_.log().warn("the stereo odometry turned otherwise than the panorama: the compass is believed");
    }
    was_contradicted_ = is_contradicted;
    const auto& clock = localizer_.panorama_clock();
    if (!has_told_offset_ && std::abs(clock.estimate_s()) > kNotableOffset_s &&
        std::sqrt(clock.variance_s2()) < kSureOffset_s) {
      has_told_offset_ = true;
      context_.log().warn("the panoramic camera's clock is {:.0f} ms {} the stereo camera's; this is allowed for",
                          1000.0 * std::abs(clock.estimate_s()), clock.estimate_s() > 0.0 ? "ahead of" : "behind");
    }
  }

  void take(const LandmarkSighting& sighting) {
    const vision::Stage stage(&timer_, "correct");
    const auto correction = localizer_.add(sighting);
    outcome_.publish(to_message(correction, sighting, parameters_.map_frame));
    if (correction.kind == CorrectionKind::kApplied) {
      const Eigen::Vector3d moved =
          correction.map_from_base_after.translation() - correction.map_from_base_before.translation();
      context_.log().info("landmark {} seen: the position moves by {:.2f} m", sighting.landmark_id, moved.norm());
      tell_landmarks(sighting.stamp_ns);
    } else if (correction.kind == CorrectionKind::kRejected) {
      warnings_.say(fmt::format("landmark {} seen, not believed: {}", sighting.landmark_id, correction.reason));
    }
    check_mounting();
  }

  void check_mounting() {
    const auto misalignment = localizer_.mounting().misalignment();
    if (!misalignment || has_told_mounting_) return;
    has_told_mounting_ = true;
    constexpr double kDegrees = 180.0 / M_PI;
    if (misalignment->is_turned) {
      context_.log().warn(
          "the panoramic camera looks {:+.1f} deg to the left and {:+.1f} deg down of where {} says, or the stereo "
          "camera as much the other way: calibrate their extrinsics",
          kDegrees * misalignment->yaw_rad, kDegrees * misalignment->pitch_rad, topics::kTfStatic.name);
    }
    if (misalignment->is_displaced) {
      context_.log().warn(
          "the panoramic camera sits {:+.2f} m forward and {:+.2f} m to the left of where {} says, or the stereo "
          "camera as much the other way: measure their extrinsics",
          misalignment->forward_m, misalignment->left_m, topics::kTfStatic.name);
    }
  }

  void take(const Built& built) {
    if (localizer_.add_built(built.id, built.stamp_ns)) {
      tell_landmarks(built.stamp_ns);
    } else {
      warnings_.say(fmt::format("landmark {} is of a time of which no odometry is remembered", built.id));
    }
  }

  void tell_landmarks(std::int64_t stamp_ns) {
    poses_.publish(to_message(localizer_.landmarks(), stamp_ns, parameters_.map_frame));
  }

  void tell_paths(std::int64_t stamp_ns, const Eigen::Isometry3d& stereo) {
    if (path_binocular_.add(stamp_ns, stereo)) {
      path_binocular_output_.publish(path_binocular_.message(parameters_.odom_frame));
    }
    if (path_enhanced_.add(stamp_ns, localizer_.latest().map_from_base)) {
      path_enhanced_output_.publish(path_enhanced_.message(parameters_.map_frame));
    }
  }

  void tell_state(const LocalizedPose& pose) {
    const bool is_new = !told_state_ || *told_state_ != pose.state;
    if (!is_new && seconds(told_state_ns_, pose.stamp_ns) < kStatePeriod_s) return;
    if (is_new) {
      const auto text = fmt::format("{}{}{}", to_text(pose.state), pose.reason.empty() ? "" : ": ", pose.reason);
      if (pose.state == State::kLost || pose.state == State::kCompassOnly) {
        context_.log().warn("{}", text);
      } else {
        context_.log().info("{}", text);
      }
    }
    told_state_ = pose.state;
    told_state_ns_ = pose.stamp_ns;
    state_.publish(to_state(pose, parameters_.map_frame));
  }

  /// Panoramas come, and no odometry any more.
  void tell_no_odometry(std::int64_t stamp_ns, double since_s) {
    auto pose = localizer_.latest();
    pose.stamp_ns = stamp_ns;
    pose.state = State::kLost;
    pose.reason = fmt::format("no {} for {:.1f} s", topics::kOdometryBinocular.name, since_s);
    tell_state(pose);
  }

  runtime::Context& context_;
  runtime::NewWarnings warnings_{context_.log()};
  const ComponentParameters parameters_;
  conversions::StageTimer timer_;
  Localizer localizer_;
  PathRecord path_binocular_, path_enhanced_;
  runtime::Output<nav_msgs::msg::Odometry> odometry_;
  runtime::Output<tf2_msgs::msg::TFMessage> tf_;
  runtime::Output<panvo_msgs::msg::LocalizationState> state_;
  runtime::Output<panvo_msgs::msg::CorrectionOutcome> outcome_;
  runtime::Output<panvo_msgs::msg::LandmarkPoses> poses_;
  runtime::Output<nav_msgs::msg::Path> path_binocular_output_, path_enhanced_output_;

  std::deque<Waiting> waiting_;
  std::set<std::uint32_t> landmarks_;
  bool is_reliable_ = true;
  double outlier_share_ = 1.0;
  std::optional<std::int64_t> begin_ns_;  // of the odometry
  std::optional<std::int64_t> azimuth_ns_;
  std::optional<std::int64_t> kept_ns_;  // of the pose in last_pose_file
  std::optional<State> told_state_;
  std::int64_t told_state_ns_ = 0;
  int unused_ = 0;
  bool was_contradicted_ = false;
  bool has_told_offset_ = false;
  bool has_told_mounting_ = false;
};

PANVO_REGISTER_COMPONENT(LocalizerComponent)

}  // namespace panvo::localizer
