// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/localizer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "panvo/localizer/soundness.hpp"
#include "panvo/vision/angle.hpp"
#include "panvo/vision/seconds.hpp"

namespace panvo::localizer {
namespace {

constexpr double kSlew = 0.2;  // fraction of the pending yaw correction per step: applied within half a second at 25 Hz
constexpr double kUnknownPosition_m = 1e4;  // standard deviation of an unknown start
constexpr double kUnknownYaw_rad = 3.0;
constexpr double kMistakenFor_s = 5.0;   // larger shifts between two times are unambiguous
constexpr double kNotableShift_s = 0.3;  // error with which the shift of a clock is known, by arrival times
constexpr double kAtStart_m = 10.0;      // a loaded map may arrive late within this path, as its process starts as well

vision::Matrix6d anywhere() {
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
  covariance.topLeftCorner<3, 3>() = kUnknownPosition_m * kUnknownPosition_m * Eigen::Matrix3d::Identity();
  covariance(5, 5) = kUnknownYaw_rad * kUnknownYaw_rad;
  return covariance;
}

}  // namespace

std::string to_text(State state) {
  switch (state) {
    case State::kStarting:
      return "starting";
    case State::kUnlocated:
      return "unlocated";
    case State::kTracking:
      return "tracking";
    case State::kCompassOnly:
      return "compass_only";
    case State::kLost:
      return "lost";
    case State::kRelocalised:
      return "relocalised";
    case State::kStale:
      return "stale";
  }
  throw std::logic_error("a state without a name");
}

Localizer::Localizer(const Parameters& parameters)
    : parameters_(parameters),
      origin_(parameters.max_speed_m_s),
      chain_(parameters.history_s),
      clock_(parameters.clock_sigma_s),
      turn_error_(parameters.turn_scale_sigma, parameters.turn_lean_sigma_deg_m * vision::kDegree),
      lean_(parameters.lean_window_s, parameters.lean_sigmas),
      check_(parameters),
      dead_reckoning_(parameters.motion, parameters.gap_s),
      graph_(parameters.start_sigma_m, parameters.start_sigma_deg * vision::kDegree, parameters.scale_sigma,
             parameters.gnss) {}

OdometryOutcome Localizer::add(const OdometryPose& received) {
  const auto refused = [](std::string reason) { return OdometryOutcome{.reason = std::move(reason)}; };
  if (const auto fault = fault_of(received.odom_from_base, received.covariance)) return refused(*fault);
  if (!chain_.empty() && received.stamp_ns <= chain_.latest().pose.stamp_ns) {
    return refused("has a stamp not later than the previous one");
  }
  const auto taken = origin_.take(received);
  if (!taken.odometry) return refused(taken.reason);
  const OdometryPose& odometry = *taken.odometry;
  const vision::Matrix6d least =
      chain_.empty() ? vision::Matrix6d(vision::Matrix6d::Zero())
                     : dead_reckoning_.step(vision::seconds(chain_.latest().pose.stamp_ns, odometry.stamp_ns),
                                            odometry.is_reliable);
  if (odometry.lean_sigma_rad_per_m > 0.0) {
    turn_error_.expect_lean(odometry.lean_sigma_rad_per_m);
    if (early_) early_->turn_error.expect_lean(odometry.lean_sigma_rad_per_m);
  }
  const Eigen::Isometry3d step = last_raw_.inverse() * odometry.odom_from_base;
  const double turn_error_rad = turn_error_.error_rad(yaw_of(step.linear()), step.translation().norm());
  const double turn_variance_rad2 = chain_.empty() ? 0.0 : turn_error_.advance(step.translation().norm());
  chain_.add(odometry, turn_error_rad, least, turn_variance_rad2);
  if (std::exchange(was_clock_set_, false)) doubt_step(step);
  check_.add_step(chain_);
  if (graph_.has_started()) {
    slew(turned_more(step, -turn_error_rad));
  } else {
    graph_.start(chain_.latest());
    smooth_ = odometry.odom_from_base;
  }
  last_raw_ = odometry.odom_from_base;
  graph_.set_turn_errors(turn_error_.errors());
  if (odometry.is_reliable) {
    unreliable_since_ns_.reset();
  } else {
    if (!unreliable_since_ns_) unreliable_since_ns_ = odometry.stamp_ns;
    doubtful_ns_ = odometry.stamp_ns;
  }
  graph_.set_direction_sigma(check_.direction_sigma_rad());
  latest_ = localized(chain_.latest());
  return {.is_taken = true, .has_begun_anew = taken.is_new_origin, .reason = {}};
}

/// Over the latest step, poses of a new time were refused at first. From image to image, odometry may have mistaken the
/// motion meanwhile without saying so.
void Localizer::doubt_step(const Eigen::Isometry3d& step) {
  const std::int64_t now_ns = chain_.latest().pose.stamp_ns;
  const double time_s = vision::seconds(chain_.stamp_before_latest(1).value_or(now_ns), now_ns);
  const double turn_rad = std::abs(yaw_of(step.linear())) + turn_sigma_rad(parameters_.motion, time_s);
  chain_.allow(now_ns - 1, now_ns, step.translation().squaredNorm(), turn_rad * turn_rad);
}

bool Localizer::add_known(const KnownLandmark& landmark) {
  if (fault_of(landmark.map_from_base, landmark.covariance)) return false;
  if (!graph_.has_known() && !found_at_way_m_) {
    is_joined_ = false;
    // A late map, or a single external landmark, does not invalidate a known position: it is joined when two panoramas
    // agree on it.
    if (!graph_.has_started() || (graph_.has_only_start() && way_m() < kAtStart_m)) is_located_ = false;
  }
  graph_.add_known(landmark);
  if (graph_.has_started()) latest_ = localized(chain_.latest());
  return true;
}

void Localizer::forget_start(const std::optional<PoseInMap>& last, std::string reason) {
  is_located_ = false;
  is_joined_ = false;
  unlocated_reason_ = std::move(reason);
  if (last && graph_.has_started()) {
    graph_.move(last->map_from_base * graph_.carried(chain_.latest()).map_from_base.inverse());
  }
  if (graph_.has_started()) latest_ = localized(chain_.latest());
}

bool Localizer::add_built(std::uint32_t id, std::int64_t stamp_ns) {
  const auto at = chain_.at(in_odometry_time(stamp_ns));
  if (!at) return false;
  graph_.add_built(id, stamp_ns, *at);
  mounts_.add_built(id, stamp_ns);
  if (const auto twist = chain_.twist(at->pose.stamp_ns)) built_twists_.insert_or_assign(id, *twist);
  return true;
}

void Localizer::set_clock_back(std::int64_t by_ns) {
  if (chain_.empty()) return;
  const double by_s = vision::seconds(0, by_ns);
  was_clock_set_ = true;
  set_back_s_ += by_s;
  if (std::abs(by_s) < kMistakenFor_s) last_set_s_ = by_s;
  origin_.set_clock_back(by_ns);
  chain_.set_clock_back(by_ns);
  clock_search_ = {};
  early_.reset();
  clock_doubt_.forget();
  is_clock_doubtful_ = false;
  clock_found_ns_ = INT64_MIN;
  clock_proven_ns_ = INT64_MIN;
  graph_.set_clock_back(by_ns);
  for (auto* stamp_ns : {&unreliable_since_ns_, &doubtful_ns_, &azimuth_ns_}) {
    if (*stamp_ns) **stamp_ns -= by_ns;
  }
  for (auto* sighting : {&asking_, &conflicting_}) {
    if (!*sighting) continue;
    (*sighting)->sighting.stamp_ns -= by_ns;
    (*sighting)->at_ns -= by_ns;
  }
  latest_ = localized(chain_.latest());
  fix_trial_.clear();
  // Measurements between two panoramas would mix two clocks.
  lean_.forget();
  last_from_ns_.reset();
  turn_seen_.reset();
  check_.forget();
  mounts_.forget_stamps();
}

void Localizer::correct_set_back(std::int64_t less_ns) {
  const double less_s = vision::seconds(0, less_ns);
  if (set_back_s_ != 0.0) set_back_s_ -= less_s;  // else its stamps are right all the same
  if (last_set_s_ != 0.0) last_set_s_ -= less_s;
}

void Localizer::trust_stamps() {
  if (set_back_s_ == 0.0 && last_set_s_ == 0.0) return;
  set_back_s_ = last_set_s_ = 0.0;
  if (!chain_.empty()) latest_ = localized(chain_.latest());
}

/// Turns have shown by how much the panoramic camera's clock is ahead: as before, if both were set alike, or by as much
/// more as the odometry's was set back.
void Localizer::judge_stamps(double panoramas_ahead_s) {
  const bool are_alike = std::abs(panoramas_ahead_s - clock_.estimate_s()) < 0.5 * std::abs(set_back_s_);
  if (are_alike) set_back_s_ = 0.0;
  last_set_s_ = 0.0;
}

/// What a clock that is wrong by a time makes of a pose: the vehicle is where it was, or will be, then.
vision::Matrix6d Localizer::by_time(const OdometrySample& at, double time_s) const {
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
  const double off_s = std::min(std::abs(time_s), kMistakenFor_s);
  if (off_s < kNotableShift_s) return covariance;
  const auto twist = chain_.twist(at.pose.stamp_ns);
  const auto then = chain_.at(at.pose.stamp_ns - vision::to_ns(off_s));
  double way_m = twist ? off_s * twist->head<2>().norm() : 0.0;
  double turn_rad = twist ? off_s * std::abs((*twist)[vision::kYaw]) : 0.0;
  if (then) {
    const Eigen::Isometry3d moved = then->pose.odom_from_base.inverse() * at.pose.odom_from_base;
    way_m = std::max(way_m, moved.translation().norm());
    turn_rad = std::max(turn_rad, std::abs(yaw_of(moved.linear())));
  }
  vision::Vector6d sigma;
  sigma << way_m, way_m, kClimb * way_m, 0.0, 0.0, turn_rad;
  covariance.diagonal() = sigma.cwiseAbs2();
  return covariance;
}

bool Localizer::reaches(std::int64_t panorama_stamp_ns) const {
  const std::int64_t stamp_ns = in_odometry_time(panorama_stamp_ns);
  return !chain_.empty() && (chain_.latest().pose.stamp_ns >= stamp_ns || chain_.at(stamp_ns));
}

std::vector<KnownLandmark> Localizer::landmarks() const {
  auto landmarks = graph_.landmarks();
  const auto common = is_located_ ? graph_.common_errors() : std::map<std::uint32_t, LocalPoseGraph::CommonErrors>();
  for (auto& landmark : landmarks) {
    if (graph_.is_known(landmark.id)) continue;
    if (!is_located_) {
      landmark.covariance += anywhere();
      continue;
    }
    const auto& errors = common.at(landmark.id);
    const auto built = built_twists_.find(landmark.id);
    Eigen::Vector3d velocity_m_s = -errors.velocity_where_known_m_s;
    if (built != built_twists_.end()) velocity_m_s += landmark.map_from_base.linear() * built->second.head<3>();
    landmark.covariance += errors.covariance + by_clock(velocity_m_s);
  }
  return landmarks;
}

std::int64_t Localizer::in_odometry_time(std::int64_t panorama_stamp_ns) const {
  return panorama_stamp_ns - clock_.estimate_ns();
}

LocalizedPose Localizer::after_silence(double silence_s) const {
  LocalizedPose pose = latest_;
  if (pose.state == State::kStarting || !(silence_s > 0.0)) return pose;
  pose.stamp_ns += static_cast<std::int64_t>(silence_s * vision::kSecond_ns);
  pose.covariance = vision::compose_covariance(latest_.map_from_base, latest_.covariance, Eigen::Isometry3d::Identity(),
                                               dead_reckoning_.silence(silence_s));
  return pose;
}

std::vector<Doubt> Localizer::doubts() const {
  auto doubts = check_.doubts(latest_.stamp_ns);
  if (conflicting_) {
    doubts.push_back(
        {conflicting_->off_m, true,
         fmt::format("landmark {} was seen at an unexpected position", conflicting_->sighting.landmark_id)});
  } else if (asking_ && asking_->is_far && vision::seconds(asking_->at_ns, latest_.stamp_ns) < parameters_.patience_s) {
    doubts.push_back({asking_->off_m, true,
                      fmt::format("landmark {} was seen at an unexpected position", asking_->sighting.landmark_id)});
  }
  return doubts;
}

LocalizedPose Localizer::localized(const OdometrySample& at) const {
  const auto here = expected(at);
  LocalizedPose pose;
  pose.stamp_ns = at.pose.stamp_ns;
  pose.map_from_base = here.map_from_base;
  pose.covariance = here.covariance;
  pose.odom_from_base = smooth_;
  pose.map_from_odom = here.map_from_base * smooth_.inverse();
  set_state(pose);
  pose.covariance += by_time(at, set_back_s_);
  return pose;
}

PoseInMap Localizer::expected(const OdometrySample& at) const {
  auto here = graph_.carried(at);
  // Errors common to all poses of the journey, which sightings of its own landmarks do not reveal. However many landmarks
  // of earlier journeys were seen on a straight road, the clock displaced all alike.
  here.covariance +=
      is_located_ ? graph_.common_covariance(at) + by_clock(graph_.velocity_where_known(at)) : anywhere();
  return here;
}

void Localizer::set_state(LocalizedPose& pose) const {
  const auto tell = [&](State state, std::string reason) {
    pose.state = state;
    pose.reason = std::move(reason);
  };
  if (!is_located_) return tell(State::kUnlocated, unlocated_reason_);
  if (auto fault = check_.fault_of_odometry(pose.stamp_ns)) return tell(State::kCompassOnly, *std::move(fault));
  if (unreliable_since_ns_) {
    const bool has_azimuth = azimuth_ns_ && check_.is_fresh(*azimuth_ns_, pose.stamp_ns);
    const double since_s = vision::seconds(*unreliable_since_ns_, pose.stamp_ns);
    if (has_azimuth) return tell(State::kCompassOnly, fmt::format("odometry unreliable for {:.1f} s", since_s));
    if (since_s > parameters_.patience_s) {
      return tell(State::kLost, fmt::format("odometry unreliable for {:.1f} s, no compass", since_s));
    }
  }
  const double sigma_m = vision::horizontal_sigma(pose.covariance);
  if (sigma_m > parameters_.lost_sigma_m) {
    return tell(State::kLost, fmt::format("position known only to {:.0f} m", sigma_m));
  }
  if (doubtful_ns_ && conflicting_) {
    return tell(State::kLost, fmt::format("landmark {} shows that the vehicle was moved while odometry was unreliable",
                                          conflicting_->sighting.landmark_id));
  }
  const bool was_just_found = found_at_way_m_ && chain_.latest().way_m - *found_at_way_m_ < parameters_.same_pass_m;
  tell(was_just_found ? State::kRelocalised : State::kTracking, {});
}

/// Advances the published odom_from_base by an odometry step and applies a part of the pending yaw correction.
void Localizer::slew(const Eigen::Isometry3d& step) {
  const double turn_rad = kSlew * pending_yaw_correction_rad_;
  pending_yaw_correction_rad_ -= turn_rad;
  smooth_ = smooth_ * step * Eigen::Isometry3d(vision::so3_exp(Eigen::Vector3d(0.0, 0.0, turn_rad)));
  smooth_.linear() = vision::nearest_rotation(smooth_.linear());
}

}  // namespace panvo::localizer
