// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/localizer.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "panvo/vision/equirectangular.hpp"

namespace panvo::localizer {
namespace {

constexpr double kSecond_ns = 1e9;
constexpr int kYaw = 5;  // of a twist
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSlew = 0.2;  // of the turn that is owed, with each step: made up for within half a second at 25 Hz
constexpr double kMostElse = 25.0;  // odometry that turns wrongly goes wrong, too, by five times what it says
// Of the stamp of an image's arrival. Clocks that are farther off show it in the first bend; until then straight ways count, too.
constexpr double kMostStampSigma_s = 0.01;
constexpr double kClockCaution = 9.0;       // odometry errs by more than it says now and then, and just while turning
constexpr double kScaleCaution = 4.0;       // what the compass errs by stays alike for some seconds, as a bend does
constexpr double kUnknownPosition_m = 1e4;  // standard deviations of a start that is not known
constexpr double kUnknownYaw_rad = 3.0;
// Of what somebody who says where the vehicle is leaves open: he clicked on a flat map.
constexpr double kUnsaidHeight_m = 10.0;
constexpr double kUnsaidTilt_rad = 0.2;
constexpr double kDriftRatio = 0.03;  // two landmarks agree within the drift on the way between them

double wrapped(double angle_rad) { return vision::wrap(angle_rad, 2.0 * std::numbers::pi); }

double seconds(std::int64_t from_ns, std::int64_t to_ns) { return static_cast<double>(to_ns - from_ns) / kSecond_ns; }

}  // namespace

Localizer::Localizer(const Parameters& parameters)
    : parameters_(parameters),
      chain_(parameters.history_s),
      clock_(parameters.clock_sigma_s),
      turn_scale_(parameters.turn_scale_sigma),
      lean_(parameters.lean_window_s, parameters.lean_sigmas),
      graph_(parameters.start_sigma_m, parameters.start_sigma_deg * kDegree) {}

LocalizedPose Localizer::add(const OdometryPose& odometry) {
  const double doubt = std::min(1.0, odometry.outlier_share / parameters_.doubtful_outlier_share);
  const double scale = turn_scale_.estimate();
  if (!chain_.add(odometry, std::lerp(parameters_.steady_turn_share, 1.0, doubt), scale)) return latest_;
  if (graph_.has_started()) {
    const Eigen::Isometry3d step = last_raw_.inverse() * odometry.odom_from_base;
    slew(turned_more(step, -scale * yaw_of(step.linear())));
  } else {
    graph_.start(chain_.latest());
    smooth_ = odometry.odom_from_base;
  }
  last_raw_ = odometry.odom_from_base;
  if (odometry.is_reliable) {
    unreliable_since_ns_.reset();
  } else {
    if (!unreliable_since_ns_) unreliable_since_ns_ = odometry.stamp_ns;
    doubtful_ns_ = odometry.stamp_ns;
  }
  return latest_ = localized(chain_.latest().pose);
}

AzimuthUse Localizer::add(const AzimuthMeasurement& azimuth) {
  const std::int64_t from_ns = in_odometry_time(azimuth.from_ns);
  const std::int64_t to_ns = in_odometry_time(azimuth.to_ns);
  if (!std::isfinite(azimuth.change_rad) || !(azimuth.variance_rad2 > 0.0)) return AzimuthUse::kNotUsed;
  if (!chain_.turn(from_ns, to_ns)) return AzimuthUse::kNotUsed;
  const double yaw_before_rad = yaw_of(chain_.latest().pose.odom_from_base.linear());
  // Turns against the same panorama err alike: the last of them, which reaches farthest, takes the place of those before.
  if (last_from_ns_ == azimuth.from_ns) {
    chain_.revert();
  } else {
    chain_.mark(from_ns);
    if (turn_seen_) turn_scale_.add(turn_seen_->disagreement_rad, turn_seen_->turn_rad, turn_seen_->variance_rad2);
    turn_seen_.reset();
  }
  last_from_ns_ = azimuth.from_ns;
  const auto turn = chain_.turn(from_ns, to_ns);
  const double disagreement = wrapped(azimuth.change_rad - turn->change_rad);
  const auto twist_then = chain_.twist(from_ns);
  const auto twist_now = chain_.twist(to_ns);
  const double rate_change = twist_then && twist_now ? (*twist_now)[kYaw] - (*twist_then)[kYaw] : 0.0;
  const double missed_rad = parameters_.compass_turn_error_ratio * azimuth.change_rad;
  const double measured_variance = azimuth.variance_rad2 + missed_rad * missed_rad;
  const double compass_variance = measured_variance + rate_change * rate_change * clock_.variance_s2();
  const double spread = compass_variance + turn->said_variance_rad2;
  const double excess =
      disagreement * disagreement / (spread * parameters_.contradiction_sigmas * parameters_.contradiction_sigmas);
  const bool is_contradicted = excess > 1.0;
  if (is_contradicted) {
    // Panoramas see all around, and movers cover little of them: it is the odometry that followed something else [Lu2015 6].
    chain_.distrust(from_ns, to_ns, disagreement * disagreement / std::max(turn->variance_rad2, 1e-12), kMostElse);
    doubtful_ns_ = to_ns;
  }
  fuse(from_ns, to_ns, azimuth.change_rad, compass_variance);

  std::optional<AzimuthLean::Stretch> lean;
  if (is_contradicted) {
    lean_.forget();
  } else if (const auto raw_rad = chain_.raw_turn(from_ns, to_ns)) {
    const double said_rad = (1.0 - turn_scale_.estimate()) * *raw_rad;
    lean = lean_.add({from_ns, to_ns, wrapped(azimuth.change_rad - said_rad), azimuth.change_rad,
                      turn->said_variance_rad2, compass_variance});
  }
  if (lean) {
    const auto leaning = chain_.turn(lean->from_ns, lean->to_ns);
    const double wrong_rad2 = lean->disagreement_rad * lean->disagreement_rad;
    if (leaning && leaning->variance_rad2 < wrong_rad2) {
      chain_.distrust(lean->from_ns, lean->to_ns, wrong_rad2 / std::max(leaning->variance_rad2, 1e-12), kMostElse);
    }
    fuse(lean->from_ns, lean->to_ns, lean->compass_rad, lean->compass_variance_rad2);
    graph_.refresh(chain_, lean->from_ns);
  } else if (!is_contradicted) {
    turn_seen_ = TurnSeen{disagreement, turn->change_rad, kScaleCaution * (compass_variance + turn->variance_rad2)};
    clock_.add(disagreement, rate_change, kClockCaution * (measured_variance + turn->said_variance_rad2));
  }
  azimuth_ns_ = to_ns;
  owed_rad_ += wrapped(yaw_of(chain_.latest().pose.odom_from_base.linear()) - yaw_before_rad);
  graph_.refresh(chain_, from_ns);
  latest_ = localized(chain_.latest().pose);
  return is_contradicted || lean ? AzimuthUse::kContradicted : AzimuthUse::kFused;
}

/// Joins a turn with the odometry's own, by their variances.
void Localizer::fuse(std::int64_t from_ns, std::int64_t to_ns, double change_rad, double variance_rad2) {
  const auto turn = chain_.turn(from_ns, to_ns);
  if (!turn) return;
  const double gain = turn->variance_rad2 / (turn->variance_rad2 + variance_rad2);
  const double by_rad = gain * wrapped(change_rad - turn->change_rad);
  chain_.turn_more(from_ns, to_ns, by_rad, 1.0 - gain);
}

void Localizer::add_known(const KnownLandmark& landmark) {
  if (!graph_.has_known() && !found_at_way_m_) is_located_ = false;
  graph_.add_known(landmark);
}

bool Localizer::add_built(std::uint32_t id, std::int64_t stamp_ns) {
  const auto at = chain_.at(in_odometry_time(stamp_ns));
  if (!at) return false;
  graph_.add_built(id, *at);
  return true;
}

Correction Localizer::add(const LandmarkSighting& told) {
  Correction correction;
  const auto rejected = [&](std::string reason) {
    correction.kind = CorrectionKind::kRejected;
    correction.reason = std::move(reason);
    return correction;
  };
  if (!told.landmark_from_base.matrix().allFinite() || !told.covariance.allFinite()) {
    return rejected("numbers that are none");
  }
  const LandmarkSighting sighting = with_uncertain_clock(told);
  const auto at = chain_.at(in_odometry_time(sighting.stamp_ns));
  if (!at) return rejected("no odometry is remembered of that time");
  const auto landmark = graph_.landmark(sighting.landmark_id);
  if (!landmark) return rejected(fmt::format("landmark {} is not known", sighting.landmark_id));
  correction.map_from_base_before = correction.map_from_base_after = graph_.carried(at->pose).map_from_base;
  mounting_.add(sighting, *at);
  auto reason = doubt(sighting, *landmark, *at, correction);
  if (!reason.empty()) return rejected(std::move(reason));

  const bool was_unknown = !is_located_ || latest_.state == State::kLost;
  if (!is_located_ && graph_.is_known(sighting.landmark_id)) {
    const Eigen::Isometry3d measured = landmark->map_from_base * sighting.landmark_from_base;
    graph_.place(measured * correction.map_from_base_before.inverse());
    is_located_ = true;
  }
  if (!graph_.add_pass(sighting, *at, parameters_.same_pass_m)) {
    correction.kind = CorrectionKind::kBetterKnown;
    correction.reason = "a panorama of the same pass tells it better";
    return correction;
  }
  graph_.solve();
  doubtful_ns_.reset();
  if (was_unknown) found_at_way_m_ = at->way_m;
  correction.kind = CorrectionKind::kApplied;
  correction.map_from_base_after = graph_.carried(at->pose).map_from_base;
  latest_ = localized(chain_.latest().pose);
  return correction;
}

/// The offset between the clocks is known to some milliseconds only: so far the vehicle moves and turns meanwhile, now, and when the
/// landmark was built.
LandmarkSighting Localizer::with_uncertain_clock(const LandmarkSighting& sighting) const {
  LandmarkSighting wider = sighting;
  if (const auto twist = chain_.twist(in_odometry_time(sighting.stamp_ns))) {
    const double sigma_s = std::min(std::sqrt(clock_.variance_s2()), kMostStampSigma_s);
    wider.covariance += 2.0 * vision::stamp_covariance(sighting.landmark_from_base, *twist, sigma_s);
  }
  return wider;
}

bool Localizer::add_said(const PoseInMap& pose, std::int64_t stamp_ns) {
  const auto at = chain_.at(stamp_ns);
  if (!at || !pose.map_from_base.matrix().allFinite() || !pose.covariance.allFinite()) return false;
  PoseInMap said = pose;
  vision::Vector6d unsaid_sigma;
  unsaid_sigma << kUnsaidHeight_m, kUnsaidHeight_m, kUnsaidHeight_m, kUnsaidTilt_rad, kUnsaidTilt_rad, kUnknownYaw_rad;
  for (Eigen::Index i = 0; i < 6; ++i) {
    if (said.covariance(i, i) <= 0.0) said.covariance(i, i) = unsaid_sigma(i) * unsaid_sigma(i);
  }
  if (is_located_ && !graph_.is_bare()) {
    graph_.cut(at->pose.stamp_ns);
  } else {
    graph_.place(said.map_from_base * graph_.carried(at->pose).map_from_base.inverse());
    is_located_ = true;
  }
  graph_.add_said(said, *at);
  graph_.solve();
  doubtful_ns_.reset();
  asking_.reset();
  dissent_.reset();
  found_at_way_m_ = at->way_m;
  latest_ = localized(chain_.latest().pose);
  return true;
}

bool Localizer::reaches(std::int64_t panorama_stamp_ns) const {
  const std::int64_t stamp_ns = in_odometry_time(panorama_stamp_ns);
  return !chain_.empty() && (chain_.latest().pose.stamp_ns >= stamp_ns || chain_.at(stamp_ns));
}

std::vector<KnownLandmark> Localizer::landmarks() const {
  auto landmarks = graph_.landmarks();
  for (auto& landmark : landmarks) {
    if (!graph_.is_known(landmark.id)) landmark.covariance += common_covariance(landmark.map_from_base.translation());
  }
  return landmarks;
}

std::int64_t Localizer::in_odometry_time(std::int64_t panorama_stamp_ns) const {
  return panorama_stamp_ns - clock_.estimate_ns();
}

LocalizedPose Localizer::localized(const OdometryPose& odometry) const {
  const auto here = expected(odometry);
  LocalizedPose pose;
  pose.stamp_ns = odometry.stamp_ns;
  pose.map_from_base = here.map_from_base;
  pose.covariance = here.covariance;
  pose.odom_from_base = smooth_;
  pose.map_from_odom = here.map_from_base * smooth_.inverse();
  tell_state(pose);
  return pose;
}

PoseInMap Localizer::expected(const OdometryPose& odometry) const {
  auto here = graph_.carried(odometry);
  here.covariance += common_covariance(here.map_from_base.translation());
  return here;
}

/// Of what is the same for all poses of the journey, so that no sighting of its own landmarks shows it.
vision::Matrix6d Localizer::common_covariance(const Eigen::Vector3d& position) const {
  if (is_located_) return graph_.common_covariance(position, parameters_.scale_sigma);
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
  covariance.topLeftCorner<3, 3>() = kUnknownPosition_m * kUnknownPosition_m * Eigen::Matrix3d::Identity();
  covariance(5, 5) = kUnknownYaw_rad * kUnknownYaw_rad;
  return covariance;
}

void Localizer::tell_state(LocalizedPose& pose) const {
  const auto tell = [&](State state, std::string reason) {
    pose.state = state;
    pose.reason = std::move(reason);
  };
  if (!is_located_) return tell(State::kUnlocated, "no place of earlier days was recognised yet");
  if (unreliable_since_ns_) {
    const bool has_azimuth = azimuth_ns_ && seconds(*azimuth_ns_, pose.stamp_ns) < parameters_.patience_s;
    const double since_s = seconds(*unreliable_since_ns_, pose.stamp_ns);
    if (has_azimuth) return tell(State::kCompassOnly, fmt::format("odometry unreliable for {:.1f} s", since_s));
    if (since_s > parameters_.patience_s) {
      return tell(State::kLost, fmt::format("odometry unreliable for {:.1f} s, and no compass", since_s));
    }
  }
  const double sigma_m = vision::horizontal_sigma(pose.covariance);
  if (sigma_m > parameters_.lost_sigma_m) {
    return tell(State::kLost, fmt::format("the position is known to {:.0f} m only", sigma_m));
  }
  if (doubtful_ns_ && dissent_) {
    return tell(State::kLost, fmt::format("landmark {} says that the vehicle was moved while odometry was unreliable",
                                          dissent_->sighting.landmark_id));
  }
  const bool was_just_found = found_at_way_m_ && chain_.latest().way_m - *found_at_way_m_ < parameters_.same_pass_m;
  tell(was_just_found ? State::kRelocalised : State::kTracking, {});
}

/// What speaks against a sighting; empty when nothing does.
std::string Localizer::doubt(const LandmarkSighting& sighting, const KnownLandmark& landmark, const Remembered& at,
                             Correction& correction) {
  const Eigen::Isometry3d measured = landmark.map_from_base * sighting.landmark_from_base;
  const bool is_placed = is_located_ || !graph_.is_known(sighting.landmark_id);
  if (is_placed) {
    const auto here = graph_.carried(at.pose);
    const vision::Vector6d error = vision::pose_error(here.map_from_base, measured);
    const vision::Matrix6d spread =
        here.covariance + vision::compose_covariance(landmark.map_from_base, landmark.covariance,
                                                     sighting.landmark_from_base, sighting.covariance);
    correction.chi_square = error.dot(spread.ldlt().solve(error));
    if (sighting.stands_alone && correction.chi_square <= parameters_.gate_chi_square) {
      asking_.reset();
      dissent_.reset();
      return {};
    }
  }
  const Asking now{sighting, measured * at.pose.odom_from_base.inverse(), at.way_m};
  const auto before = std::exchange(asking_, now);
  const bool is_weaker = before && sighting.stands_alone && !before->sighting.stands_alone;
  const bool is_asked_twice = before && !is_weaker && before->sighting.landmark_id == sighting.landmark_id &&
                              before->sighting.stamp_ns < sighting.stamp_ns && agree(*before, now);
  if (!sighting.stands_alone) {
    if (!is_placed) return "of few points, and where the vehicle is expected is not known";
    if (correction.chi_square > parameters_.gate_chi_square) return "of few points, and not where it was expected";
    return is_asked_twice ? "" : "of few points: the next panorama must agree";
  }
  if (!is_placed) return is_asked_twice ? "" : "the first sighting: a second panorama must agree";
  const auto far =
      fmt::format("{:.0f} from what was expected, {:.0f} at most", correction.chi_square, parameters_.gate_chi_square);
  if (!is_asked_twice) return far + ", until a second panorama asks for it, too";
  if (correction.chi_square <= parameters_.second_look_gate_ratio * parameters_.gate_chi_square) return {};
  // So far off odometry is not, unless it missed how the vehicle was moved. But a landmark in the wrong place would ask for this, too:
  // only two landmarks together are believed.
  const bool is_other = dissent_ && dissent_->sighting.landmark_id != sighting.landmark_id;
  if (!is_other || !agree(*dissent_, now)) {
    dissent_ = now;
    return far + ", until a second landmark asks for it, too";
  }
  graph_.cut(doubtful_ns_ ? *doubtful_ns_ : at.pose.stamp_ns);
  asking_.reset();
  dissent_.reset();
  return {};
}

/// Whether two sightings ask for the same place of the odometry in the map, but for the drift between them.
bool Localizer::agree(const Asking& before, const Asking& now) const {
  const auto at = chain_.at(in_odometry_time(now.sighting.stamp_ns));
  if (!at) return false;
  const auto apart =
      vision::pose_error(before.map_from_odom * at->pose.odom_from_base, now.map_from_odom * at->pose.odom_from_base);
  const double drift_m = kDriftRatio * std::abs(now.way_m - before.way_m);
  return apart.head<3>().norm() < parameters_.second_look_m + drift_m &&
         apart.tail<3>().norm() < parameters_.second_look_deg * kDegree;
}

/// Takes odom_from_base on by a step of the odometry, and makes up for a part of the turn that it owes.
void Localizer::slew(const Eigen::Isometry3d& step) {
  const double turn_rad = kSlew * owed_rad_;
  owed_rad_ -= turn_rad;
  smooth_ = smooth_ * step * Eigen::Isometry3d(vision::so3_exp(Eigen::Vector3d(0.0, 0.0, turn_rad)));
  smooth_.linear() = vision::nearest_rotation(smooth_.linear());
}

}  // namespace panvo::localizer
