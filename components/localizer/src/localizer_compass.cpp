// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/localizer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "panvo/localizer/soundness.hpp"
#include "panvo/vision/equirectangular.hpp"

/// What the Localizer makes of the panoramic compass.
namespace panvo::localizer {
namespace {

constexpr int kYaw = 5;                // of a twist
constexpr double kMostElse = 25.0;     // odometry that turns wrongly goes wrong, too, by five times what it says
constexpr double kClockCaution = 9.0;  // odometry errs by more than it says now and then, and just while turning
constexpr double kScaleCaution = 4.0;  // what the compass errs by stays alike for some seconds, as a bend does
// Chance that who is taken to be right in a dispute is not: then the pose is off by three standard deviations.
constexpr double kDoubt = 1.0 / 9.0;
constexpr double kOdometryError_m = 0.03;        // of some tenths of a second
constexpr double kSteady_s = 0.2;                // over which it is seen how the vehicle moves
constexpr double kSteady = 3.0;                  // standard deviations of what vehicles do
constexpr double kImpossible = 6.0;              // the same
constexpr double kShortestWay_m = 0.1;           // that has a direction
constexpr double kNoDirection_rad2 = 0.5 * 0.5;  // nothing moves in the panoramas: all is more than a thousand ways off
constexpr double kClearlyMoved_m = 0.5;          // far enough for something beside the way to show it
constexpr double kSameAngle_rad = 0.1;
constexpr double kLasting_m = 30.0;
constexpr double kNearest_m = 0.3, kParallax_rad = 0.02;  // what is beside the way is no nearer, in the median
constexpr double kCameraApart_m = 1.0;                    // from base_link: in a bend it moves in another direction
constexpr double kDirectionError_rad = 0.01;              // of panoramas, whatever their points say

double wrapped(double angle_rad) { return vision::wrap(angle_rad, 2.0 * std::numbers::pi); }

double azimuth_of(const Eigen::Vector2d& way) { return std::atan2(way.y(), way.x()); }

double seconds(std::int64_t from_ns, std::int64_t to_ns) { return static_cast<double>(to_ns - from_ns) * 1e-9; }

}  // namespace

AzimuthUse Localizer::add(const AzimuthMeasurement& azimuth) {
  const std::int64_t from_ns = in_odometry_time(azimuth.from_ns);
  const std::int64_t to_ns = in_odometry_time(azimuth.to_ns);
  if (fault_of_angle(azimuth.change_rad, azimuth.variance_rad2)) return AzimuthUse::kNotUsed;
  if (!chain_.turn(from_ns, to_ns)) return AzimuthUse::kNotUsed;
  const double yaw_before_rad = yaw_of(chain_.latest().pose.odom_from_base.linear());
  // Turns against the same panorama err alike: the last of them, which reaches farthest, takes the place of those before.
  if (last_from_ns_ == azimuth.from_ns) {
    chain_.revert();
  } else {
    chain_.mark(from_ns);
    if (turn_seen_) turn_scale_.add(turn_seen_->disagreement_rad, turn_seen_->turn_rad, turn_seen_->variance_rad2);
    turn_seen_.reset();
    if (direction_seen_) direction_offset_.add(direction_seen_->difference_rad, direction_seen_->variance_rad2);
    direction_seen_.reset();
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
  const double way_variance_m2 = gained_covariance(chain_.at(from_ns)->pose, chain_.at(to_ns)->pose, 0.0)
                                     .topLeftCorner<2, 2>()
                                     .trace();  // as odometry says, before it is distrusted
  const bool is_contradicted = excess > 1.0;
  if (is_contradicted) {
    turn_dispute_.add(azimuth.from_ns, to_ns, disagreement, wrong_turn(to_ns, disagreement));
    doubtful_ns_ = to_ns;
  } else {
    turn_dispute_.end();
  }
  const bool is_compass_wrong = is_contradicted && turn_dispute_.wrong() == Wrong::kPanoramas;
  if (is_contradicted && !is_compass_wrong) {
    chain_.distrust(from_ns, to_ns, disagreement * disagreement / std::max(turn->variance_rad2, 1e-12), kMostElse);
  }
  if (!is_compass_wrong) fuse(from_ns, to_ns, azimuth.change_rad, compass_variance);
  if (is_contradicted) chain_.allow(from_ns, to_ns, 0.0, turn_dispute_.growth(kDoubt));
  compare_ways(azimuth, from_ns, to_ns, way_variance_m2);
  vouch_for_break(from_ns, to_ns);
  if (!is_disputed() && !break_) agreed_ns_ = to_ns;
  if (!is_disputed()) jump_.reset();

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
  if (is_compass_wrong) return AzimuthUse::kDoubted;
  return is_contradicted || lean ? AzimuthUse::kContradicted : AzimuthUse::kFused;
}

/// How a vehicle that went on as it did when odometry and panoramas last agreed would have moved since.
std::optional<Localizer::GoneOn> Localizer::gone_on(std::int64_t to_ns) const {
  if (!agreed_ns_) return std::nullopt;
  const auto before = moved(*agreed_ns_ - static_cast<std::int64_t>(kSteady_s * 1e9), *agreed_ns_);
  const auto since = moved(*agreed_ns_, to_ns);
  if (!before || !since) return std::nullopt;
  const double time_s = seconds(*agreed_ns_, to_ns), times = time_s / kSteady_s;
  return GoneOn{{wrapped(since->turn_rad - times * before->turn_rad), since->way_m - times * before->way_m},
                dead_reckoning_.turn_sigma_rad(time_s),
                dead_reckoning_.way_sigma_m(time_s)};
}

bool Localizer::goes_on_steadily(std::int64_t to_ns) const {
  const auto gone = gone_on(to_ns);
  return !gone || gone->more.way_m.norm() < kSteady * (gone->way_sigma_m + kOdometryError_m);
}

/// Panoramas see all around, and movers cover little of them: as a rule it is the odometry that followed something else [Lu2015 6]. But where
/// odometry goes on as the vehicle did and the panoramas as no vehicle does, it is their camera that was turned.
Wrong Localizer::wrong_turn(std::int64_t to_ns, double disagreement_rad) const {
  const auto gone = gone_on(to_ns);
  if (!gone) return Wrong::kOdometry;
  const bool is_steady = std::abs(gone->more.turn_rad) < kSteady * gone->turn_sigma_rad;
  const bool is_impossible =
      std::abs(wrapped(gone->more.turn_rad + disagreement_rad)) > kImpossible * gone->turn_sigma_rad;
  return is_steady && is_impossible ? Wrong::kPanoramas : Wrong::kOdometry;
}

std::optional<Localizer::TurnAndWay> Localizer::moved(std::int64_t from_ns, std::int64_t to_ns) const {
  const auto from = chain_.at(from_ns), to = chain_.at(to_ns);
  if (!from || !to) return std::nullopt;
  const Eigen::Isometry3d from_to = from->pose.odom_from_base.inverse() * to->pose.odom_from_base;
  const Eigen::Vector3d way = from_to.linear().transpose() * from_to.translation();
  return TurnAndWay{yaw_of(from_to.linear()), way.head<2>()};
}

/// Odometry that moves otherwise than the panoramas followed something else. It is wrong by what lies across their direction at least, and by as
/// much as it differs from how the vehicle drove before. Not where the panoramic camera has just been turned.
void Localizer::compare_ways(const AzimuthMeasurement& azimuth, std::int64_t from_ns, std::int64_t to_ns,
                             double way_variance_m2) {
  const auto odometry = moved(from_ns, to_ns);
  if (!odometry || !(azimuth.motion_azimuth_variance_rad2 > 0.0)) return;
  const bool is_camera_turned = turn_dispute_.is_on() && turn_dispute_.wrong() == Wrong::kPanoramas;
  const auto off_m = way_off(azimuth, *odometry, way_variance_m2, is_camera_turned);
  if (is_camera_turned || (!off_m && !turn_dispute_.is_on())) return way_dispute_.end();
  const auto gone = gone_on(to_ns);
  const double otherwise_m =
      gone ? gone->more.way_m.norm() * std::min(1.0, seconds(from_ns, to_ns) / seconds(*agreed_ns_, to_ns)) : 0.0;
  way_dispute_.add(azimuth.from_ns, to_ns, std::max(off_m.value_or(0.0), otherwise_m), Wrong::kOdometry);
  doubtful_ns_ = to_ns;
  chain_.allow(from_ns, to_ns, way_dispute_.growth(1.0), 0.0);
}

/// How far the odometry's way lies off what the panoramas see of it; nullopt where they agree.
std::optional<double> Localizer::way_off(const AzimuthMeasurement& azimuth, const TurnAndWay& odometry,
                                         double way_variance_m2, bool is_camera_turned) {
  const double length_m = odometry.way_m.norm();
  const bool panoramas_stand = azimuth.motion_azimuth_variance_rad2 > kNoDirection_rad2;
  if (std::abs(azimuth.side_parallax_rad) > length_m / kNearest_m + kParallax_rad) return length_m;
  if (length_m < kShortestWay_m) return std::nullopt;
  if (panoramas_stand) return length_m > kClearlyMoved_m ? std::optional(length_m) : std::nullopt;
  const double in_bend_rad = kCameraApart_m * odometry.turn_rad / length_m;
  const double variance = azimuth.motion_azimuth_variance_rad2 + kDirectionError_rad * kDirectionError_rad +
                          in_bend_rad * in_bend_rad + way_variance_m2 / (length_m * length_m);
  const double seen_rad = wrapped(azimuth.motion_azimuth_rad - azimuth_of(odometry.way_m) - camera_turned_rad_);
  const double difference_rad = wrapped(seen_rad - direction_offset_.estimate_rad());
  const double most_rad = parameters_.contradiction_sigmas * std::sqrt(variance + direction_offset_.variance_rad2());
  if (std::abs(difference_rad) > most_rad) {
    if (is_camera_turned) camera_turned_rad_ = wrapped(camera_turned_rad_ + difference_rad);
    if (!turn_dispute_.is_on() && stays_off(azimuth, seen_rad, length_m)) {
      direction_offset_.restart(seen_rad, variance);
      return std::nullopt;
    }
    return length_m * std::sin(std::min(std::abs(difference_rad), 0.5 * std::numbers::pi));
  }
  if (!turn_dispute_.is_on()) direction_seen_ = DirectionSeen{seen_rad, variance};
  lasting_.reset();
  return std::nullopt;
}

/// Whether the directions have differed by one angle for so long that no mover is the cause, but a camera that sits otherwise than is thought.
bool Localizer::stays_off(const AzimuthMeasurement& azimuth, double seen_rad, double length_m) {
  if (!lasting_ || std::abs(wrapped(seen_rad - lasting_->seen_rad)) > kSameAngle_rad) {
    lasting_ = Lasting{azimuth.from_ns, seen_rad, 0.0};
  } else if (lasting_->from_ns != azimuth.from_ns) {
    lasting_->from_ns = azimuth.from_ns;
    lasting_->way_m += length_m;
  }
  return lasting_->way_m > kLasting_m;
}

/// Odometry that lost sight of all that it saw and began anew in the next image tells nothing of what lay between. Panoramas that found their
/// points again from before to after say that the vehicle moved on as it did; where there are none, it may be anywhere near.
void Localizer::vouch_for_break(std::int64_t from_ns, std::int64_t to_ns) {
  if (!break_) return;
  if (from_ns > break_->vouched_ns) {
    const vision::Matrix6d unseen = dead_reckoning_.silence(kUnseen_s);
    chain_.allow(break_->from_ns, break_->to_ns, unseen(0, 0), unseen(kYaw, kYaw));
    graph_.refresh(chain_, break_->from_ns);
    doubtful_ns_ = break_->to_ns;
    break_.reset();
  } else if (!is_disputed() && goes_on_steadily(to_ns)) {
    break_->vouched_ns = std::max(break_->vouched_ns, to_ns);
    if (!unreliable_since_ns_ && break_->vouched_ns >= break_->to_ns) break_.reset();
  }
}

/// Joins a turn with the odometry's own, by their variances.
void Localizer::fuse(std::int64_t from_ns, std::int64_t to_ns, double change_rad, double variance_rad2) {
  const auto turn = chain_.turn(from_ns, to_ns);
  if (!turn) return;
  const double gain = turn->variance_rad2 / (turn->variance_rad2 + variance_rad2);
  const double by_rad = gain * wrapped(change_rad - turn->change_rad);
  chain_.turn_more(from_ns, to_ns, by_rad, 1.0 - gain);
}

}  // namespace panvo::localizer
