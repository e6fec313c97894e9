// SPDX-License-Identifier: Apache-2.0
#include "panvo/odometry_fusion/odometry_fusion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "panvo/odometry_fusion/factors.hpp"
#include "panvo/odometry_fusion/standstill.hpp"
#include "panvo/vision/step_covariance.hpp"

namespace panvo::odometry_fusion {
namespace {

constexpr double kGyroGap_s = 0.05;   // slower gyroscopes miss vibration
constexpr double kWheelGap_s = 0.25;  // 4 Hz
constexpr double kLost_s = 0.5;       // without samples, a sensor is not waited for
constexpr std::size_t kMaxWaiting = 20;
constexpr double kStandingSpeed = 0.1;  // m/s; a vehicle that stops is slower in the half second before
// Without stereo poses for this time, and three times their usual interval, poses are made without them.
constexpr double kSilence_s = 0.25;
constexpr std::int64_t kBlindStep_ns = 50'000'000;

/// A gyroscope whose samples are exactly equal is stuck: a working one is noisy.
bool is_stuck(const std::vector<GyroSample>& samples) {
  return std::ranges::all_of(samples,
                             [&](const GyroSample& one) { return one.rate_rad_s == samples.front().rate_rad_s; });
}

}  // namespace

void FusedPose::take_motion(const MotionFilter& filter) {
  const double dt_s = filter.interval_s();
  odom_from_base = filter.odom_from_base();
  covariance = filter.covariance();
  twist = vision::se3_log(filter.step()) / dt_s;
  twist_covariance =
      vision::rotate_covariance(filter.step().linear().transpose(), filter.step_covariance()) / (dt_s * dt_s);
}

OdometryFusion::OdometryFusion(const FusionParameters& parameters)
    : parameters_(parameters),
      filter_(parameters),
      gyro_{SampleWindow<GyroSample>(kGyroGap_s)},
      wheels_{SampleWindow<WheelSample>(kWheelGap_s)},
      path_(parameters.max_speed_m_s) {}

bool OdometryFusion::add(const StereoPose& stereo) {
  if (!stereo.odom_from_base.matrix().allFinite() || !stereo.covariance.allFinite()) return false;
  if (latest_ && stereo.stamp_ns <= latest_->stamp_ns) return false;
  if (!waiting_.empty() && stereo.stamp_ns <= waiting_.back().stamp_ns) return false;
  if (waiting_.size() == kMaxWaiting) waiting_.pop_front();
  waiting_.push_back(stereo);
  wheels_at_stereo_ns_ = wheels_.window.latest_ns();
  newest_ns_ = stereo.stamp_ns;
  return true;
}

bool OdometryFusion::add(const GyroSample& sample) { return sample.rate_rad_s.allFinite() && gyro_.window.add(sample); }

bool OdometryFusion::add(const WheelSample& sample) {
  const bool is_finite =
      std::isfinite(sample.forward_m_s) && std::isfinite(sample.left_m_s) && std::isfinite(sample.yaw_rate_rad_s);
  return is_finite && wheels_.window.add(sample);
}

/// Whether a sensor's samples up to a stamp are still to be expected.
bool OdometryFusion::must_wait(std::optional<std::int64_t> latest_ns, std::int64_t stamp_ns, double clock_s) const {
  if (!latest_ns) return false;
  const double lacking_s = seconds(*latest_ns, stamp_ns) + clock_s;
  return lacking_s > 0.0 && lacking_s < kLost_s && seconds(stamp_ns, newest_ns_) < parameters_.patience_s;
}

/// End of the next interval without a stereo pose. Silence is measured between samples of the wheels, so that their
/// clock does not matter.
std::optional<std::int64_t> OdometryFusion::blind_until() const {
  if (!latest_ || !wheels_.state.is_used || !wheels_at_stereo_ns_) return std::nullopt;
  const double silence_s = seconds(*wheels_at_stereo_ns_, *wheels_.window.latest_ns());
  const double from_stereo_s = seconds(previous_stereo_->stamp_ns, latest_->stamp_ns + kBlindStep_ns);
  if (silence_s < std::max({kSilence_s, 3.0 * interval_.median_s(), from_stereo_s}) + parameters_.patience_s)
    return std::nullopt;
  const std::int64_t until_ns = latest_->stamp_ns + kBlindStep_ns;
  if (wheels_.window.span(later(latest_->stamp_ns, wheels_late_s_), later(until_ns, wheels_late_s_)).empty())
    return std::nullopt;
  return until_ns;
}

std::optional<FusedPose> OdometryFusion::next() {
  if (waiting_.empty()) {
    const auto until_ns = blind_until();
    return until_ns ? std::optional(step(*until_ns, std::nullopt)) : std::nullopt;
  }
  const std::int64_t stamp_ns = waiting_.front().stamp_ns;
  if (must_wait(gyro_.window.latest_ns(), stamp_ns, filter_.learned()[kGyroClock]) ||
      must_wait(wheels_.window.latest_ns(), stamp_ns, wheels_late_s_)) {
    return std::nullopt;
  }
  const StereoPose stereo = waiting_.front();
  waiting_.pop_front();
  if (latest_) return step(stamp_ns, stereo);
  const Begin begin = begin_.value_or(Begin{stereo.odom_from_base, stereo.covariance});
  filter_.begin_at(begin.odom_from_base, begin.covariance);
  path_.add(stereo.stamp_ns, stereo.odom_from_base, stereo.covariance, stereo.is_reliable);
  previous_stereo_ = stereo;
  FusedPose first;
  first.stamp_ns = stamp_ns;
  first.odom_from_base = begin.odom_from_base;
  first.covariance = begin.covariance;
  first.is_reliable = stereo.is_reliable;
  first.uses_cameras = true;
  latest_ = first;
  return first;
}

OdometryFusion::Interval OdometryFusion::interval(std::int64_t from_ns, std::int64_t to_ns) const {
  const double gyro_late_s = filter_.learned()[kGyroClock];
  return {.from_ns = from_ns,
          .to_ns = to_ns,
          .dt_s = seconds(from_ns, to_ns),
          .seen = {},
          .seen_covariance = vision::Matrix6d::Zero(),
          .gyro = gyro_.window.span(later(from_ns, gyro_late_s), later(to_ns, gyro_late_s)),
          .wheels = wheels_.window.span(later(from_ns, wheels_late_s_), later(to_ns, wheels_late_s_))};
}

/// Adds what the cameras saw, unless their odometry was restarted or jumped.
void OdometryFusion::see(Interval& now, const StereoPose& stereo) {
  path_.add(stereo.stamp_ns, stereo.odom_from_base, stereo.covariance, stereo.is_reliable);
  if (!path_.follows() || previous_stereo_->stamp_ns != now.from_ns) return;
  const Eigen::Isometry3d seen = previous_stereo_->odom_from_base.inverse() * stereo.odom_from_base;
  if (seen.translation().norm() >= parameters_.max_speed_m_s * now.dt_s) return;
  now.seen = seen;
  now.seen_covariance = vision::step_covariance(previous_stereo_->odom_from_base, previous_stereo_->covariance,
                                                stereo.odom_from_base, stereo.covariance);
  now.is_reliable = stereo.is_reliable && previous_stereo_->is_reliable;
}

FusedPose OdometryFusion::step(std::int64_t to_ns, const std::optional<StereoPose>& stereo) {
  Interval now = interval(latest_->stamp_ns, to_ns);
  if (stereo) see(now, *stereo);
  try_sensors(now);
  FusedPose fused = is_standing(now) ? stand(now) : move(now);
  filter_.compose();
  fused.take_motion(filter_);
  fused.stamp_ns = to_ns;

  if (stereo) {
    fused.is_reliable |= now.seen && stereo->is_reliable;
    interval_.add(seconds(previous_stereo_->stamp_ns, to_ns));
    previous_stereo_ = stereo;
  }
  latest_ = fused;
  const std::int64_t keep_ns = later(to_ns, -2.0 * kStill_s);
  gyro_.window.forget_before(keep_ns);
  wheels_.window.forget_before(keep_ns);
  return fused;
}

/// Compares the sensors with the cameras, and decides which are used.
void OdometryFusion::try_sensors(Interval& now) {
  if (now.is_reliable) {
    try_gyro(now);
    try_wheels(now);
  } else if (!gyro_.state.is_used && gyro_.trial.is_plausible()) {
    accept_gyro();  // better than none
  }
  choose_sensors(now);
}

void OdometryFusion::choose_sensors(Interval& now) const {
  now.uses_gyro = gyro_.state.is_used && !now.gyro.empty() && !is_stuck(now.gyro);
  now.uses_wheels = wheels_.state.is_used && !now.wheels.empty();
}

void OdometryFusion::try_gyro(const Interval& now) {
  if (now.gyro.empty()) return;
  gyro_.trial.add(rotation_of(now.gyro), vision::so3_log(now.seen->linear()), now.dt_s);
  if (gyro_.state.is_used) return;
  const Verdict verdict = gyro_.trial.verdict();
  if (verdict.is_good) accept_gyro();
  if (!verdict.fault.empty()) gyro_.state.fault = verdict.fault;
}

void OdometryFusion::try_wheels(const Interval& now) {
  if (now.wheels.empty()) return;
  const WheelMotion rolled = motion_of(now.wheels);
  const double speed_change = now.wheels.back().forward_m_s - now.wheels.front().forward_m_s;
  const Eigen::Vector3d turned = vision::so3_log(now.seen->linear());
  wheels_.trial.add({rolled.forward_m, rolled.yaw_rad, speed_change}, now.seen->translation().x(), turned.z(),
                    now.dt_s);
  const Verdict yaw = wheels_.trial.yaw_verdict();
  wheel_yaw_ = {.is_used = yaw.is_good, .fault = yaw.fault};
  if (wheels_.state.is_used) return;
  const Verdict verdict = wheels_.trial.verdict();
  if (verdict.is_good) {
    wheels_.state = {.is_used = true, .fault = ""};
    wheels_late_s_ += wheels_.trial.late_s();
  }
  if (!verdict.fault.empty()) wheels_.state.fault = verdict.fault;
}

void OdometryFusion::accept_gyro() {
  gyro_.state = {.is_used = true, .fault = ""};
  LearnedVector value = LearnedVector::Zero(), sigma = prior_sigma(parameters_);
  value.segment<3>(kGyroBias) = gyro_.trial.bias();
  sigma.segment<3>(kGyroBias).setConstant(std::min(parameters_.gyro.bias_sigma_rad_s, 2.0 * gyro_.trial.bias_sigma()));
  constexpr int kCount = kGyroClock + 1;
  filter_.restart(kGyroBias, kCount, value.head<kCount>(), sigma.head<kCount>());
}

Eigen::Vector3d OdometryFusion::gyro_bias() const {
  return gyro_.state.is_used ? filter_.learned().segment<3>(kGyroBias) : gyro_.trial.bias();
}

bool OdometryFusion::is_gyro_still(std::int64_t to_ns) const {
  const auto& learned = filter_.learned();
  const double bias_sigma =
      std::max({filter_.sigma(kGyroBias), filter_.sigma(kGyroBias + 1), filter_.sigma(kGyroBias + 2)});
  const double late_s = learned[kGyroClock];
  return is_still(gyro_.window.span(later(to_ns, late_s - kStill_s), later(to_ns, late_s)),
                  learned.segment<3>(kGyroBias), bias_sigma);
}

/// Wheels and gyroscope show no motion; without a gyroscope, wheels and cameras.
bool OdometryFusion::is_standing(const Interval& now) const {
  if (!now.uses_wheels || filter_.step().translation().norm() >= kStandingSpeed * filter_.interval_s()) return false;
  if (!is_still(wheels_.window.span(later(now.to_ns, wheels_late_s_ - kStill_s), later(now.to_ns, wheels_late_s_))))
    return false;
  if (now.uses_gyro) return is_gyro_still(now.to_ns);
  return now.is_reliable && now.seen->translation().norm() < kStandingSpeed * now.dt_s;
}

FusedPose OdometryFusion::stand(const Interval& now) {
  FusedPose fused;
  fused.is_standing = fused.uses_wheels = true;
  fused.uses_gyro = now.uses_gyro;
  if (now.uses_gyro) {
    filter_.begin_still(now.dt_s);
    filter_.update(factor_of_gyro(filter_, now));  // shows its bias
  } else {                                         // rotations by the cameras: a suspension settles while wheels stand
    filter_.begin_unknown(now.dt_s);
    filter_.update(stereo_factor(filter_, *now.seen, now.seen_covariance));
    filter_.update(standstill_factor(filter_));
    fused.uses_cameras = true;
  }
  return fused;
}

FusedPose OdometryFusion::move(const Interval& now) { return now.is_reliable ? move_seen(now) : move_blind(now); }

FusedPose OdometryFusion::move_seen(const Interval& now) {
  FusedPose fused;
  Consistency of_gyro = gyro_.consistency, of_wheels = wheels_.consistency;
  MotionFilter seen = filter_;
  seen.begin_unknown(now.dt_s);
  seen.update(stereo_factor(seen, *now.seen, now.seen_covariance));
  fused.uses_cameras = true;
  if (now.uses_gyro) {
    const Factor factor = factor_of_gyro(seen, now);
    fused.uses_gyro = of_gyro.add(seen.innovation(factor), now.dt_s, parameters_.gate_sigmas);
    if (fused.uses_gyro) seen.update(factor);
  }
  if (now.uses_wheels) {
    const Factor factor = factor_of_wheels(seen, now);
    fused.uses_wheels = of_wheels.add(seen.innovation(factor), now.dt_s, parameters_.gate_sigmas);
    if (fused.uses_wheels) seen.learn(factor);  // to be ready when the cameras fail; slip must not spoil their motion
  }
  const bool are_two_against = now.uses_gyro && now.uses_wheels && !fused.uses_gyro && !fused.uses_wheels;
  if (are_two_against && does_wheel_follow_gyro(now)) return move_blind(now);
  gyro_.consistency = of_gyro;
  wheels_.consistency = of_wheels;
  doubt_sensors();
  filter_ = seen;
  return fused;
}

/// Puts a sensor that contradicts the cameras for seconds on trial again.
void OdometryFusion::doubt_sensors() {
  if (gyro_.consistency.is_faulty()) {
    gyro_.trial = {};
    gyro_.consistency = {};
    gyro_.state = {.is_used = false, .fault = "rates contradict the cameras"};
  }
  if (wheels_.consistency.is_faulty()) {
    wheels_.trial = {};
    wheels_.consistency = {};
    wheels_.state = {.is_used = false, .fault = "speed contradicts the cameras: slip, or a fault"};
  }
}

/// Whether gyroscope and wheels agree, which contradict the cameras both: moving objects fill the view.
bool OdometryFusion::does_wheel_follow_gyro(const Interval& now) const {
  MotionFilter blind = filter_;
  blind.begin_continued(now.dt_s);
  blind.update(factor_of_gyro(blind, now));
  return is_within(blind.innovation(factor_of_wheels(blind, now)), parameters_.gate_sigmas);
}

FusedPose OdometryFusion::move_blind(const Interval& now) {
  if (now.uses_wheels || !now.seen) return continue_blind(now, filter_);
  // Without wheels the stereo odometry continues its motion itself, and says how uncertain that is.
  FusedPose fused;
  filter_.begin_unknown(now.dt_s);
  filter_.update(stereo_factor(filter_, *now.seen, now.seen_covariance));
  if (now.uses_gyro) filter_.update(factor_of_gyro(filter_, now));
  fused.uses_gyro = now.uses_gyro;
  fused.is_reliable = false;
  fused.uses_cameras = true;
  return fused;
}

/// Moves a filter by gyroscope and wheels, at constant velocity where they do not measure.
FusedPose OdometryFusion::continue_blind(const Interval& now, MotionFilter& filter) const {
  FusedPose fused;
  filter.begin_continued(now.dt_s);
  if (now.uses_gyro) filter.update(factor_of_gyro(filter, now));
  if (now.uses_wheels) {
    const Factor factor = factor_of_wheels(filter, now);
    fused.uses_wheels = is_within(filter.innovation(factor), parameters_.gate_sigmas);
    if (fused.uses_wheels) filter.update(factor);
  }
  fused.uses_gyro = now.uses_gyro;
  fused.is_reliable = fused.uses_wheels && (now.uses_gyro || has_wheel_yaw(now));
  return fused;
}

Factor OdometryFusion::factor_of_gyro(const MotionFilter& filter, const Interval& now) const {
  return gyro_factor(filter, now.gyro, parameters_.gyro);
}

Factor OdometryFusion::factor_of_wheels(const MotionFilter& filter, const Interval& now) const {
  return wheel_factor(filter, now.wheels, parameters_.wheels, has_wheel_yaw(now));
}

/// Without cameras and before the first turn, also unless something speaks against it.
bool OdometryFusion::has_wheel_yaw(const Interval& now) const {
  return wheel_yaw_.is_used || (!now.is_reliable && wheel_yaw_.fault.empty() && wheels_.trial.measures_yaw());
}

}  // namespace panvo::odometry_fusion
