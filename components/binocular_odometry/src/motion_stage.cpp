// SPDX-License-Identifier: Apache-2.0
#include "panvo/binocular_odometry/motion_stage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

#include "dead_reckoning.hpp"
#include "lean_sigma.hpp"
#include "motion_model.hpp"
#include "motion_ransac.hpp"
#include "panvo/vision/pose.hpp"
#include "two_stage_local_bundle_adjuster.hpp"

namespace panvo::binocular_odometry {
namespace {

using vision::Matrix6d;
using vision::Stage;

// Converts the covariance of the error in exp(error) * a_from_b to that of vision::pose_error.
Matrix6d pose_covariance(const Eigen::Isometry3d& a_from_b, const Matrix6d& covariance) {
  Matrix6d by_twist = Matrix6d::Identity();
  by_twist.topRightCorner<3, 3>() = -vision::skew(a_from_b.translation());
  return by_twist * covariance * by_twist.transpose();
}

Matrix6d previous_from_current_covariance(const MeasuredMotion& motion) {
  return vision::invert_covariance(motion.current_from_previous,
                                   pose_covariance(motion.current_from_previous, motion.covariance));
}

}  // namespace

class MotionStage::Implementation {
 public:
  Implementation(const vision::RectifiedStereo& stereo, const MotionParameters& parameters,
                 vision::StageObserver* observer)
      : stereo_(stereo),
        parameters_(parameters),
        observer_(observer),
        lean_sigma_(stereo, parameters),
        adjuster_(stereo, parameters),
        unseen_(parameters.acceleration, parameters.angular_acceleration) {}

  OdometryEstimate estimate(const TrackedFrame& frame) {
    OdometryEstimate result;
    result.stamp_ns = frame.stamp_ns;
    result.quality.detected = frame.detected;
    result.quality.tracked = frame.tracked;
    result.quality.matched = frame.matched;
    result.quality.lean_sigma_rad_per_m = lean_sigma_.rad_per_m();
    if (frame.is_late) {
      stay(frame, result);
      return result;
    }
    const bool is_of_another_time = frame.stamp_ns <= last_stamp_ns_;
    const std::int64_t since_last_ns = interval(frame.stamp_ns, last_stamp_ns_);
    const std::int64_t since_good_ns = interval(frame.stamp_ns, good_stamp_ns_);
    last_stamp_ns_ = frame.stamp_ns;

    if (frame.fault.empty())
      adjuster_.move_disparity_offset(frame.disparity_offset_px -
                                      std::exchange(learned_offset_px_, frame.disparity_offset_px));

    std::optional<MeasuredMotion> motion;
    if (frame.fault.empty() && has_reference_) {
      motion = estimate_and_refine(frame, motion_model_.predict(since_good_ns), result.quality);
    } else if (!frame.fault.empty()) {
      result.quality.reason = frame.fault;
    }
    if (!has_reference_) {
      start(frame, result);
    } else if (motion) {
      follow(frame, *motion, since_good_ns, result);
    } else {
      if (is_of_another_time) unseen_.go_on(vision::Vector6d::Zero(), kAnotherTime_ns);
      carry_on(frame, since_last_ns, result);
    }
    published_odom_from_left_ = result.odom_from_left;
    published_covariance_ = result.odom_from_left_covariance;
    was_reliable_ = result.quality.reliable;
    return result;
  }

  std::vector<ScenePoint> points() const {
    std::vector<ScenePoint> points;
    if (!was_reliable_) return points;
    const Eigen::Isometry3d odom_from_left = head_.left_from_odom.inverse();
    for (const Observation& seen : reference_) points.push_back(adjuster_.scene_point(seen, odom_from_left));
    return points;
  }

 private:
  static constexpr std::int64_t kUsualInterval_ns = 100'000'000;
  // Images that do not match, of a time before, may show another place: as a recording that is played again.
  static constexpr std::int64_t kAnotherTime_ns = 5'000'000'000;
  static constexpr double kPersistence_m = 1.0;  // calibration errors are correlated until other points are in view
  static constexpr int kKeyframeIterations = 3;  // starts near the solution; the next frame continues
  static constexpr int kFrameIterations = 1;

  static std::int64_t interval(std::int64_t stamp_ns, std::int64_t since_ns) {
    return stamp_ns > since_ns && since_ns > 0 ? stamp_ns - since_ns : kUsualInterval_ns;
  }

  struct Pairs {
    std::vector<PointPair> points;
    std::vector<Observation> previous;
    std::vector<Observation> current;
  };

  // A car ahead may fill the view with ever new points: new points get a low weight compared to points that were static
  // over two keyframes.
  static double vote(int standing) { return standing == 0 ? 0.01 : standing == 1 ? 0.1 : 1.0; }

  Pairs pair_up(const TrackedFrame& frame) const {
    Pairs pairs;
    const Eigen::Vector3d offset(0.0, 0.0, adjuster_.disparity_offset_px());
    auto known = reference_.begin();
    for (const Observation& seen : frame.observations) {
      while (known != reference_.end() && known->track_id < seen.track_id) ++known;
      if (known == reference_.end()) break;
      if (known->track_id != seen.track_id || !known->has_disparity) continue;
      const auto standing = adjuster_.standing(seen.track_id);
      if (!standing) continue;
      pairs.points.push_back({known->pixel - offset, seen.pixel - offset, seen.has_disparity, vote(*standing)});
      pairs.previous.push_back(*known);
      pairs.current.push_back(seen);
    }
    for (const auto& [previous, current] : frame.matches) {
      pairs.points.push_back({previous.pixel - offset, current.pixel - offset, true, vote(0)});
      pairs.previous.push_back(previous);
      pairs.current.push_back(current);
    }
    return pairs;
  }

  std::optional<MeasuredMotion> estimate_and_refine(const TrackedFrame& frame, const Eigen::Isometry3d& expected,
                                                    Quality& quality) {
    Pairs pairs = pair_up(frame);
    const auto consensus = [&] {
      const Stage stage(observer_, "ransac");
      // In a sharp turn the expected motion is far off, and triples of distant points give no other that is near enough.
      const std::array guesses{frame.current_from_previous.value_or(expected), expected, Eigen::Isometry3d::Identity()};
      return estimate_motion(stereo_, pairs.points, guesses, parameters_);
    }();
    quality.inliers = consensus ? consensus->inliers : 0;
    quality.inlier_ratio =
        pairs.points.empty() ? 0.0 : static_cast<double>(quality.inliers) / static_cast<double>(pairs.points.size());
    std::ostringstream reason;
    if (quality.inliers < parameters_.min_inliers) {
      reason << quality.inliers << " inliers of " << parameters_.min_inliers << " needed";
    } else if (quality.inlier_ratio < parameters_.min_inlier_ratio) {
      reason << "inlier ratio " << quality.inlier_ratio << ", at least " << parameters_.min_inlier_ratio << " needed";
    }
    quality.reason = reason.str();
    if (!quality.reason.empty()) return std::nullopt;

    const Stage stage(observer_, "refine_motion");
    size_t kept = 0;
    for (size_t i = 0; i < pairs.points.size(); ++i) {
      if (!consensus->is_inlier[i]) continue;
      pairs.previous[kept] = pairs.previous[i];
      pairs.current[kept++] = pairs.current[i];
    }
    pairs.previous.resize(kept);
    pairs.current.resize(kept);
    MeasuredMotion motion = adjuster_.refine_motion(pairs.previous, pairs.current, consensus->current_from_previous);
    quality.residual_px = motion.residual_px;
    if (!motion.current_from_previous.matrix().allFinite() || !motion.covariance.allFinite()) {
      quality.reason = "the refined motion is not finite";
      return std::nullopt;
    }
    return motion;
  }

  /// A late or repeated frame tells nothing of the time since the last one, so that nothing changes for the next.
  void stay(const TrackedFrame& frame, OdometryEstimate& result) const {
    result.odom_from_left = published_odom_from_left_;
    result.odom_from_left_covariance = published_covariance_;
    result.quality.reason = frame.fault;
  }

  void start(const TrackedFrame& frame, OdometryEstimate& result) {
    result.odom_from_left = published_odom_from_left_;
    result.odom_from_left_covariance = published_covariance_;
    if (!frame.fault.empty()) return;
    const int needed = parameters_.min_inliers + parameters_.min_inliers / 2;  // some are lost in the next frame
    if (frame.matched < needed) {
      result.quality.reason =
          std::to_string(frame.matched) + " matched features of " + std::to_string(needed) + " needed to start";
      return;
    }
    result.quality.reliable = true;
    keyframe_covariance_ = published_covariance_;
    head_ = {published_odom_from_left_.inverse(), frame.observations};
    adjuster_.add_keyframe(head_);
    unseen_.begin(DeadReckoning::Velocity::kUnknown);
    remember(frame);
    measured(result);
  }

  void follow(const TrackedFrame& frame, const MeasuredMotion& motion, std::int64_t since_good_ns,
              OdometryEstimate& result) {
    head_ = {motion.current_from_previous * reference_left_from_odom_, frame.observations};
    std::optional<MeasuredMotion> since_keyframe;
    bool becomes_keyframe = true;
    {
      const Stage stage(observer_, "refine_window");
      becomes_keyframe = is_keyframe();
      since_keyframe = adjuster_.refine_window(head_, becomes_keyframe ? kKeyframeIterations : kFrameIterations);
    }
    result.quality.reliable = true;
    result.odom_from_left = head_.left_from_odom.inverse();
    result.previous_from_current = published_odom_from_left_.inverse() * result.odom_from_left;
    lean_sigma_.add(result.quality.inlier_ratio, result.previous_from_current.translation().norm());
    result.quality.lean_sigma_rad_per_m = lean_sigma_.rad_per_m();
    result.previous_from_current_covariance =
        previous_from_current_covariance(motion) + model_error(result.previous_from_current, 0.0);
    if (!was_reliable_) result.previous_from_current_covariance += covariance_of_return(result.previous_from_current);
    if (since_keyframe) {
      const Eigen::Isometry3d keyframe_from_current = since_keyframe->current_from_previous.inverse();
      result.odom_from_left_covariance = vision::compose_covariance(
          adjuster_.last_keyframe().left_from_odom.inverse(), keyframe_covariance_, keyframe_from_current,
          previous_from_current_covariance(*since_keyframe) + model_error(keyframe_from_current, kPersistence_m));
    } else {
      result.odom_from_left_covariance =
          vision::compose_covariance(published_odom_from_left_, published_covariance_, result.previous_from_current,
                                     result.previous_from_current_covariance);
    }
    if (!since_keyframe || becomes_keyframe) {
      if (!since_keyframe) adjuster_.clear();
      adjuster_.add_keyframe(head_);
      keyframe_covariance_ = result.odom_from_left_covariance;
    }
    motion_model_.update(head_.left_from_odom * reference_left_from_odom_.inverse(), since_good_ns);
    unseen_.begin(DeadReckoning::Velocity::kMeasured);
    remember(frame);
    measured(result);
  }

  // After a predicted pose: the step to the measured pose has the covariance of the prediction.
  Matrix6d covariance_of_return(const Eigen::Isometry3d& carried_from_measured) const {
    const Matrix6d carried =
        vision::rotate_covariance(unseen_.begin_from_current().linear().transpose(), unseen_.covariance());
    Matrix6d of_step = Matrix6d::Identity();
    of_step.topRightCorner<3, 3>() = -vision::skew(carried_from_measured.translation());
    return of_step * carried * of_step.transpose();
  }

  // Errors common to all residuals, proportional to the motion. Along the path they accumulate like independent steps
  // of length `persistence_m`.
  Matrix6d model_error(const Eigen::Isometry3d& a_from_b, double persistence_m) const {
    const double moved = a_from_b.translation().norm();
    const double distance = std::sqrt(moved * std::max(moved, persistence_m));
    const double angle = vision::so3_log(a_from_b.linear()).norm();
    vision::Vector6d sigma;
    sigma << Eigen::Vector3d::Constant(parameters_.motion_error_ratio * distance),
        Eigen::Vector3d::Constant(
            parameters_.motion_error_ratio * angle +
            std::max(parameters_.rotation_error_rad_per_m, lean_sigma_.of_calibration_rad_per_m()) * distance);
    return sigma.cwiseAbs2().asDiagonal();
  }

  bool is_keyframe() const {
    const auto& seen = adjuster_.last_keyframe().observations;
    std::vector<double> motion_px;
    auto now = head_.observations.begin();
    for (const Observation& then : seen) {
      while (now != head_.observations.end() && now->track_id < then.track_id) ++now;
      if (now == head_.observations.end()) break;
      if (now->track_id == then.track_id) motion_px.push_back((now->pixel - then.pixel).head<2>().norm());
    }
    if (static_cast<double>(motion_px.size()) < parameters_.keyframe_shared_ratio * static_cast<double>(seen.size()))
      return true;
    const auto median = motion_px.begin() + static_cast<std::ptrdiff_t>(motion_px.size() / 2);
    std::nth_element(motion_px.begin(), median, motion_px.end());
    return *median > parameters_.keyframe_parallax_px;
  }

  void remember(const TrackedFrame& frame) {
    has_reference_ = true;
    reference_ = frame.observations;
    reference_left_from_odom_ = head_.left_from_odom;
    good_stamp_ns_ = frame.stamp_ns;
  }

  void measured(const OdometryEstimate& result) {
    measured_odom_from_left_ = result.odom_from_left;
    measured_covariance_ = result.odom_from_left_covariance;
  }

  void carry_on(const TrackedFrame& frame, std::int64_t since_last_ns, OdometryEstimate& result) {
    result.previous_from_current = motion_model_.predict(since_last_ns).inverse();
    result.previous_from_current_covariance = unseen_.step_covariance(since_last_ns);
    unseen_.go_on(-motion_model_.twist(since_last_ns), since_last_ns);
    result.odom_from_left = published_odom_from_left_ * result.previous_from_current;
    result.odom_from_left_covariance = vision::compose_covariance(measured_odom_from_left_, measured_covariance_,
                                                                  unseen_.begin_from_current(), unseen_.covariance());
    if (!frame.fault.empty()) return;
    // The frame is usable but does not match the last good one: odometry restarts here.
    head_ = {result.odom_from_left.inverse(), frame.observations};
    adjuster_.clear();
    adjuster_.add_keyframe(head_);
    keyframe_covariance_ = result.odom_from_left_covariance;
    remember(frame);
  }

  vision::RectifiedStereo stereo_;
  MotionParameters parameters_;
  vision::StageObserver* observer_;
  LeanSigma lean_sigma_;
  TwoStageLocalBundleAdjuster adjuster_;
  MotionModel motion_model_;
  DeadReckoning unseen_;            // since the last measured pose
  double learned_offset_px_ = 0.0;  // disparity offset, from the tracking stage

  // The last good frame, reference of the next one.
  bool has_reference_ = false;
  std::vector<Observation> reference_;
  Eigen::Isometry3d reference_left_from_odom_ = Eigen::Isometry3d::Identity();
  std::int64_t good_stamp_ns_ = 0;

  Keyframe head_;
  Matrix6d keyframe_covariance_ = Matrix6d::Zero();
  std::int64_t last_stamp_ns_ = 0;
  Eigen::Isometry3d published_odom_from_left_ = Eigen::Isometry3d::Identity();
  Matrix6d published_covariance_ = Matrix6d::Zero();
  Eigen::Isometry3d measured_odom_from_left_ = Eigen::Isometry3d::Identity();  // last reliable pose
  Matrix6d measured_covariance_ = Matrix6d::Zero();
  bool was_reliable_ = true;
};

MotionStage::MotionStage(const vision::RectifiedStereo& stereo, const MotionParameters& parameters,
                         vision::StageObserver* observer) {
  vision::expect_valid(stereo);
  implementation_ = std::make_unique<Implementation>(stereo, parameters, observer);
}

MotionStage::~MotionStage() = default;
MotionStage::MotionStage(MotionStage&&) noexcept = default;
MotionStage& MotionStage::operator=(MotionStage&&) noexcept = default;

OdometryEstimate MotionStage::estimate(const TrackedFrame& frame) { return implementation_->estimate(frame); }

std::vector<ScenePoint> MotionStage::points() const { return implementation_->points(); }

}  // namespace panvo::binocular_odometry
