// SPDX-License-Identifier: Apache-2.0
#include "panvo/all_round_odometry/all_round_odometry.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "panvo/vision/seconds.hpp"
#include "panvo/vision/step_covariance.hpp"

namespace panvo::all_round_odometry {
namespace {

// Longer than a panorama serves as reference, by a clock that may be off to both sides.
constexpr double kHistory_s = 6.0 + 2.0 * vision::ClockSearch::kFarthest_s;
// Share of the points that agree with the stereo odometry: it is usually above 0.8. Fewer contradict it, if clearly more
// agree on another motion.
constexpr double kContradicted = 0.6, kClearly = 0.25;
constexpr double kAcceleration = 1.5, kTurnAcceleration = 0.5;  // m/s^2 and rad/s^2, usual for a vehicle
constexpr std::size_t kMaxStereo = 2000, kMaxPanoramas = 50;
constexpr double kOtherClock = 2.0;      // standard deviations
constexpr double kSameTurn_rad = 0.02;   // between panoramas and stereo odometry: noise and a slightly wrong clock
constexpr double kTurnSigma_rad = 2e-3;  // of the turn between two panoramas or stereo poses

using vision::seconds;

}  // namespace

AllRoundOdometry::AllRoundOdometry(const Parameters& parameters, const Eigen::Vector3d& base_from_camera)
    : parameters_(parameters), base_from_camera_(base_from_camera), motion_(base_from_camera) {}

void AllRoundOdometry::set_camera(const Eigen::Vector3d& base_from_camera) {
  base_from_camera_ = base_from_camera;
  motion_ = PanoramicMotion(base_from_camera_);
}

bool AllRoundOdometry::add(const StereoPose& received) {
  if (received.stamp_ns <= newest_ns_) return false;
  if (newest_ns_ != INT64_MIN) interval_.add(seconds(newest_ns_, received.stamp_ns));
  newest_ns_ = received.stamp_ns;
  const auto on_path = path_.add(received.stamp_ns, received.odom_from_base, received.covariance, received.is_reliable);
  if (on_path == vision::OnPath::kElsewhere) {
    // A reader may know the reason. If the path was shifted, it would take the pose for motion.
    if (!blind_ && held_ == 0 && !shift_) emit(received);
    return true;
  }
  const StereoPose stereo = on_path == vision::OnPath::kRestarted ? begin_anew(received) : received;
  const bool has_panoramas = panorama_ns_ && seconds(*panorama_ns_, stereo.stamp_ns) < parameters_.patience_s;
  stereo_.add(stereo);
  is_stereo_silent_ = false;
  if (blind_ || held_ > 0 || (!stereo.is_reliable && has_panoramas)) {
    ++held_;
    if (sure_ns_ == INT64_MIN) sure_ns_ = stereo.stamp_ns;  // blind from the start: patience begins here
  } else {
    emit(stereo);
  }
  process();
  while (stereo_.size() > kMaxStereo ||
         (stereo_.size() > held_ + 1 && seconds(stereo_.front().stamp_ns, stereo.stamp_ns) > kHistory_s)) {
    stereo_.remove_first();
    held_ = std::min(held_, stereo_.size());
  }
  return true;
}

/// The stereo odometry was restarted with another origin. A shifted path goes on as panoramas show, or where the motion
/// leads. Otherwise poses are passed on as they are, and a reader notices the restart itself.
StereoPose AllRoundOdometry::begin_anew(const StereoPose& stereo) {
  if (!blind_) give_up();
  stereo_.clear();
  held_ = 0;
  if (!blind_ && !shift_) {
    last_.reset();
    return stereo;
  }
  StereoPose unmeasured = stereo;
  unmeasured.is_reliable = false;
  if (blind_) return unmeasured;
  const Eigen::Isometry3d& moved = path_.motion_to_restart();
  Pose here{emitted_.odom_from_base * moved,
            vision::compose_covariance(emitted_.odom_from_base, emitted_.covariance, moved, vision::Matrix6d::Zero())};
  here.covariance =
      vision::after_unknown_motion(here.covariance, path_.velocity(), seconds(emitted_ns_, stereo.stamp_ns));
  shift_ = Shift{{stereo.odom_from_base, stereo.covariance}, here};
  return unmeasured;
}

void AllRoundOdometry::add(PanoramaPoints panorama, bool is_stereo_silent) {
  const auto order = panorama_stamps_.add(panorama.stamp_ns);
  if (order == vision::StampOrder::kNotLater) return;
  if (order == vision::StampOrder::kSetBack) {
    clock_search_.forget_turns();
    forget_panoramas();
  }
  search_clock(panorama);
  set_back(panorama, vision::to_ns(ahead_s_));
  is_stereo_silent_ = is_stereo_silent;
  panorama_ns_ = panorama.stamp_ns;
  panoramas_.push_back(std::move(panorama));
  if (panoramas_.size() > kMaxPanoramas) panoramas_.pop_front();
  process();
}

/// The times of all panoramas so far have been wrong if there is a large offset.
void AllRoundOdometry::search_clock(const PanoramaPoints& received) {
  if (received.tracks.empty() || stereo_.empty()) return;
  clock_search_.add(received.tracks.front().from_ns, received.stamp_ns,
                    {turn_in(received), kTurnSigma_rad * kTurnSigma_rad});
  if (blind_) return;
  const bool is_contradicted = clock_search_.has_found() && is_clock_doubtful_;
  const auto found = clock_search_.find(stereo_.back().stamp_ns, turns_of_stereo(),
                                        is_contradicted ? std::optional(ahead_s_) : std::nullopt);
  if (!found || std::abs(found->ahead_s - ahead_s_) < kOtherClock * vision::ClockSearch::kSigma_s) return;
  ahead_s_ = found->ahead_s;
  forget_panoramas();
}

/// Those so far are of other times.
void AllRoundOdometry::forget_panoramas() {
  clock_doubt_.forget();
  motion_ = PanoramicMotion(base_from_camera_);
  if (!blind_) last_.reset();
  panoramas_.clear();
  panorama_ns_.reset();
}

vision::ClockSearch::Reference AllRoundOdometry::turns_of_stereo() const {
  return [this](std::int64_t from_ns, std::int64_t to_ns) -> std::optional<vision::ClockSearch::Turn> {
    const auto step = stereo_.measured(from_ns, to_ns);
    if (!step) return std::nullopt;
    return vision::ClockSearch::Turn{vision::so3_log(step->linear()).z(), kTurnSigma_rad * kTurnSigma_rad};
  };
}

/// Whether the panorama may be one of another time: before the clock is known, or if a clock that was set since explains
/// the turns.
void AllRoundOdometry::doubt_clock(const PanoramaPoints& panorama) {
  const std::int64_t from_ns = panorama.tracks.front().from_ns, to_ns = panorama.stamp_ns;
  const std::int64_t ahead_ns = vision::to_ns(ahead_s_);  // already subtracted
  const auto turns = turns_of_stereo();
  const auto turn = turns(from_ns, to_ns);
  const bool is_other = turn && std::abs(turn_beyond(turn->change_rad, panorama)) > kSameTurn_rad;
  if (!is_other) clock_doubt_.agree(to_ns + ahead_ns);
  is_clock_doubtful_ = !clock_search_.has_found() ||
                       (is_other && clock_doubt_.add(from_ns + ahead_ns, to_ns + ahead_ns, turn_in(panorama),
                                                     kSameTurn_rad, ahead_ns, stereo_.back().stamp_ns, turns));
}

std::optional<AllRoundPose> AllRoundOdometry::next() {
  if (ready_.empty()) return std::nullopt;
  const AllRoundPose pose = ready_.front();
  ready_.pop_front();
  return pose;
}

void AllRoundOdometry::process() {
  while (!panoramas_.empty() && !stereo_.empty()) {
    if (stereo_.back().stamp_ns < panoramas_.front().stamp_ns && !is_stereo_silent_) break;
    process(panoramas_.front());
    panoramas_.pop_front();
  }
  if (held_ > 0 && seconds(sure_ns_, stereo_.back().stamp_ns) > parameters_.patience_s) give_up();
}

void AllRoundOdometry::process(const PanoramaPoints& received) {
  if (received.tracks.empty()) return;
  doubt_clock(received);
  const PanoramaPoints panorama = turned(received, camera_rotation_.base_from_stated());
  const std::int64_t before_ns = motion_.before_ns(panorama);
  const auto step = stereo_.measured(before_ns, panorama.stamp_ns);
  const bool is_stereo_wrong = step && is_contradicted(panorama, *step, before_ns);
  if (step) is_contradicted_ = is_stereo_wrong;
  if (step && !is_stereo_wrong) {
    learn(panorama, before_ns, *step);
    learn_rotation(received);
  } else {
    measure(panorama, before_ns);
  }
  if (blind_ && !is_contradicted_) return_to_stereo(panorama.stamp_ns);
}

/// Whether the stereo odometry followed something else, such as a lorry that fills its view: the points on all sides
/// show another motion, and a steadier one. If the motion in the panoramas changed abruptly instead, their camera was
/// turned.
bool AllRoundOdometry::is_contradicted(const PanoramaPoints& panorama, const Eigen::Isometry3d& step,
                                       std::int64_t before_ns) const {
  const auto share = motion_.agreeing_share(panorama, step);
  if (!share || *share > kContradicted) return false;
  const double interval_s = seconds(before_ns, panorama.stamp_ns);
  PanoramicMotion trial = motion_;
  const auto seen = trial.measure(panorama, vision::se3_exp(twist_ * interval_s));
  if (!seen || surprise(seen->before_from_now, interval_s) > surprise(step, interval_s)) return false;
  // Panoramas of another time show another motion in a bend, but hardly another speed.
  const double by_m = seen->before_from_now.translation().norm() - step.translation().norm();
  const double usual_m_s = kAcceleration * vision::ClockSearch::kUsual_s;
  if (is_clock_doubtful_ && std::abs(by_m) < usual_m_s * interval_s) return false;
  return motion_.agreeing_share(panorama, seen->before_from_now).value_or(0.0) > *share + kClearly;
}

/// Deviation of a step from steady motion, in units of usual accelerations.
double AllRoundOdometry::surprise(const Eigen::Isometry3d& step, double interval_s) const {
  const vision::Vector6d change = vision::se3_log(step) / interval_s - twist_;
  return std::max(change.head<3>().norm() / kAcceleration, change.tail<3>().norm() / kTurnAcceleration);
}

/// Learns the distances of points from a motion that the stereo odometry measured.
void AllRoundOdometry::learn(const PanoramaPoints& panorama, std::int64_t before_ns, const Eigen::Isometry3d& step) {
  motion_.learn(panorama, step);
  twist_ = vision::se3_log(step) / seconds(before_ns, panorama.stamp_ns);
  if (!blind_) {
    last_ = PanoramaPose{panorama.stamp_ns, shifted(*stereo_.at(panorama.stamp_ns))};
  } else if (last_->stamp_ns == before_ns) {
    const auto before = *stereo_.at(before_ns), now = *stereo_.at(panorama.stamp_ns);
    advance(step,
            vision::step_covariance(before.odom_from_base, before.covariance, now.odom_from_base, now.covariance));
    last_ = PanoramaPose{panorama.stamp_ns, blind_pose()};
  }
}

/// Learns the rotation of the camera from the stereo odometry's motion since the reference.
void AllRoundOdometry::learn_rotation(const PanoramaPoints& received) {
  const PointTracks& tracks = received.tracks.front();
  const auto then_from_now = stereo_.measured(tracks.from_ns, received.stamp_ns);
  if (!then_from_now) return;
  const Eigen::Matrix3d& base_from_stated = camera_rotation_.base_from_stated();
  const Eigen::Matrix3d seen = base_from_stated * received.now_from_then.transpose() * base_from_stated.transpose();
  // In a bend, panoramas of another time, or a camera that was turned, show another rotation.
  if (vision::so3_log(seen.transpose() * then_from_now->linear()).norm() > kSameTurn_rad) return;
  camera_rotation_.add(
      tracks, Eigen::Translation3d(-base_from_camera_) * *then_from_now * Eigen::Translation3d(base_from_camera_));
}

/// Measures a motion that the stereo odometry has not, from the last panorama with a known pose.
void AllRoundOdometry::measure(const PanoramaPoints& panorama, std::int64_t before_ns) {
  if (!last_ || last_->stamp_ns != before_ns) return;
  const double interval_s = seconds(before_ns, panorama.stamp_ns);
  PanoramicMotion motion = motion_;
  const auto step = motion.measure(panorama, vision::se3_exp(twist_ * interval_s));
  // Distances that were learned at other times fit few points.
  if (step && is_clock_doubtful_ && step->agreeing_share < kContradicted) return;
  motion_ = std::move(motion);
  if (!step) return;
  if (!blind_) blind_ = Blind{last_->odometry, {}, 0.0};
  blind_->scale_variance = step->scale_variance;
  advance(step->before_from_now, step->covariance);
  twist_ = vision::se3_log(step->before_from_now) / interval_s;
  last_ = PanoramaPose{panorama.stamp_ns, blind_pose()};
  held_ = std::min(held_, stereo_.size() - stereo_.first_from(panorama.stamp_ns + 1));
  if (panorama.stamp_ns <= emitted_ns_) return;
  ready_.push_back(
      {panorama.stamp_ns, last_->odometry.odom_from_base, last_->odometry.covariance, true, step->agreeing_share});
  emitted_ns_ = sure_ns_ = panorama.stamp_ns;
  emitted_ = last_->odometry;
}

void AllRoundOdometry::advance(const Eigen::Isometry3d& before_from_now, const vision::Matrix6d& covariance) {
  Pose& path = blind_->begin_from_last;
  path.covariance = vision::compose_covariance(path.odom_from_base, path.covariance, before_from_now, covariance);
  path.odom_from_base = path.odom_from_base * before_from_now;
}

/// Ends the blind stretch at a panorama if the stereo odometry measures again.
void AllRoundOdometry::return_to_stereo(std::int64_t stamp_ns) {
  if (last_->stamp_ns != stamp_ns) return;
  const std::size_t after = stereo_.first_from(stamp_ns);
  const auto stereo = stereo_.at(stamp_ns);
  if (!stereo || !stereo_[after].is_reliable) return;
  shift_ = Shift{*stereo, last_->odometry};
  blind_.reset();
  held_ = std::min(held_, stereo_.size() - stereo_.first_from(stamp_ns + 1));
  emit_held();
}

/// Nothing has measured the motion for too long: continues with the poses of the stereo odometry.
void AllRoundOdometry::give_up() {
  if (blind_) {
    // The motion since the last panorama is that of the stereo odometry. After a silence, or if its clock was set forward,
    // it may have measured the motion since its pose before that.
    const StereoPose& first = stereo_[stereo_.size() - held_];
    const auto there = stereo_.at(last_->stamp_ns);
    if (there || !first.is_reliable) {
      shift_ = Shift{there.value_or(Pose{first.odom_from_base, first.covariance}), last_->odometry};
    }
    blind_.reset();
  }
  const std::size_t held = std::exchange(held_, 0);
  for (std::size_t i = stereo_.size() - held; i < stereo_.size(); ++i) emit(stereo_[i]);
}

void AllRoundOdometry::emit(const StereoPose& stereo) {
  if (stereo.stamp_ns <= emitted_ns_) return;
  const Pose pose = shifted({stereo.odom_from_base, stereo.covariance});
  ready_.push_back({stereo.stamp_ns, pose.odom_from_base, pose.covariance, stereo.is_reliable, std::nullopt});
  emitted_ns_ = stereo.stamp_ns;
  emitted_ = pose;
  if (stereo.is_reliable) sure_ns_ = stereo.stamp_ns;
}

/// Up to the first that is not reliable.
void AllRoundOdometry::emit_held() {
  while (held_ > 0 && stereo_[stereo_.size() - held_].is_reliable) {
    emit(stereo_[stereo_.size() - held_]);
    --held_;
  }
}

Pose AllRoundOdometry::shifted(const Pose& stereo) const {
  if (!shift_) return stereo;
  const Eigen::Isometry3d moved = shift_->stereo.odom_from_base.inverse() * stereo.odom_from_base;
  const vision::Matrix6d gained = vision::step_covariance(shift_->stereo.odom_from_base, shift_->stereo.covariance,
                                                          stereo.odom_from_base, stereo.covariance);
  return {shift_->odometry.odom_from_base * moved,
          vision::compose_covariance(shift_->odometry.odom_from_base, shift_->odometry.covariance, moved, gained)};
}

Pose AllRoundOdometry::blind_pose() const {
  const Eigen::Isometry3d& moved = blind_->begin_from_last.odom_from_base;
  vision::Matrix6d covariance = blind_->begin_from_last.covariance;
  const Eigen::Matrix3d sideways = vision::skew(moved.translation());
  covariance.topLeftCorner<3, 3>() += blind_->scale_variance * moved.translation() * moved.translation().transpose() +
                                      sideways * camera_rotation_.covariance() * sideways.transpose();
  return {blind_->begin.odom_from_base * moved,
          vision::compose_covariance(blind_->begin.odom_from_base, blind_->begin.covariance, moved, covariance)};
}

}  // namespace panvo::all_round_odometry
