// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/cross_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "panvo/vision/equirectangular.hpp"

namespace panvo::localizer {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
// Chance that who is taken to be right in a dispute is not: then the pose is off by three standard deviations.
constexpr double kDoubt = 1.0 / 9.0;
constexpr double kUnseen_s = 5.0;    // a vehicle moved unseen is as far as one of which nothing was heard for so long
constexpr double kReach = 3.0;       // standard deviations of that
constexpr double kMostAtOnce = 2.0;  // m/s: no vehicle changes its speed from one image to the next by so much
constexpr double kAlarm_s = 0.5;     // within which a panorama tells whether it did

constexpr double kSteady_s = 0.2;          // over which it is seen how the vehicle moves
constexpr double kOdometryError_m = 0.03;  // of some tenths of a second
constexpr double kSteady = 3.0;            // standard deviations of what vehicles do
constexpr double kImpossible = 6.0;        // the same

constexpr double kDirectionError_rad = 0.01;     // of panoramas, whatever their points say
constexpr double kAlike_rad = 0.005;             // that the directions of all panoramas of a journey may err by
constexpr double kCameraApart_m = 1.0;           // from base_link: in a bend it moves in another direction
constexpr double kShortestWay_m = 0.1;           // that has a direction
constexpr double kClearlyMoved_m = 0.5;          // far enough for something beside the way to show it
constexpr double kNoDirection_rad2 = 0.5 * 0.5;  // nothing moves: all is more than a thousand ways off
constexpr double kNearest_m = 0.3, kParallax_rad = 0.02;  // what is beside the way is no nearer, in the median
constexpr double kSameAngle_rad = 0.1;
constexpr double kLasting_m = 30.0;
// A stereo camera that is mounted so far askew shows it in its path; a panoramic one looks the same however it is turned.
constexpr double kNoStereoMount_rad = 10.0 * kDegree;

double wrapped(double angle_rad) { return vision::wrap(angle_rad, 2.0 * std::numbers::pi); }

double azimuth_of(const Eigen::Vector2d& way) { return std::atan2(way.y(), way.x()); }

double seconds(std::int64_t from_ns, std::int64_t to_ns) { return static_cast<double>(to_ns - from_ns) * 1e-9; }

}  // namespace

CrossCheck::CrossCheck(const Parameters& parameters)
    : contradiction_sigmas_(parameters.contradiction_sigmas),
      patience_s_(parameters.patience_s),
      motion_(parameters.motion),
      direction_offset_(parameters.mounting_sigma_deg * kDegree) {}

/// Long before a panorama tells that odometry follows something else, its speed tells, which then changes at once.
void CrossCheck::add_step(const OdometryChain& chain) {
  const auto& now = chain.latest().pose;
  const auto before_ns = chain.before_latest_ns();
  const auto twist = chain.twist(now.stamp_ns);
  const auto twist_before = before_ns ? chain.twist(*before_ns) : std::nullopt;
  if (twist && twist_before) {
    const double change_m_s = (twist->head<2>() - twist_before->head<2>()).norm();
    if (change_m_s > kMostAtOnce) jump_ = Jump{now.stamp_ns, change_m_s};
  }
  if (break_ && !break_->is_over) {
    break_->to_ns = now.stamp_ns;
    break_->is_over = now.is_reliable;
  } else if (!now.is_reliable) {
    const std::int64_t from_ns = before_ns.value_or(now.stamp_ns);
    if (!break_) break_ = Break{from_ns, now.stamp_ns, from_ns, false};
    break_->to_ns = now.stamp_ns;
    break_->is_over = false;
  }
}

void CrossCheck::begin_reference() {
  if (seen_) direction_offset_.add(seen_->difference_rad, seen_->variance_rad2);
  seen_.reset();
}

std::optional<Wrong> CrossCheck::compare_turns(const OdometryChain& chain, const Stretch& stretch,
                                               double disagreement_rad, bool is_too_much) {
  if (!is_too_much) {
    turn_dispute_.end();
    return std::nullopt;
  }
  turn_dispute_.add(stretch.reference_ns, stretch.to_ns, disagreement_rad,
                    wrong_turn(chain, stretch.to_ns, disagreement_rad));
  return turn_dispute_.wrong();
}

/// Odometry that moves otherwise than the panoramas followed something else. It is wrong by what lies across their direction at least, and by as
/// much as it differs from how the vehicle drove before. Not where the panoramic camera has just been turned.
std::optional<std::int64_t> CrossCheck::compare_ways(OdometryChain& chain, const Stretch& stretch,
                                                     const AzimuthMeasurement& azimuth, double way_variance_m2) {
  if (turn_dispute_.is_on()) chain.allow(stretch.from_ns, stretch.to_ns, 0.0, turn_dispute_.growth(kDoubt));
  const auto odometry = moved(chain, stretch.from_ns, stretch.to_ns);
  if (odometry && azimuth.motion_azimuth_variance_rad2 > 0.0) {
    const auto off_m = way_off(azimuth, *odometry, way_variance_m2);
    if (is_camera_turned() || (!off_m && !turn_dispute_.is_on())) {
      way_dispute_.end();
    } else {
      const auto gone = gone_on(chain, stretch.to_ns);
      const double part = gone ? seconds(stretch.from_ns, stretch.to_ns) / seconds(*agreed_ns_, stretch.to_ns) : 0.0;
      const double otherwise_m = gone ? gone->more.way_m.norm() * std::min(1.0, part) : 0.0;
      way_dispute_.add(stretch.reference_ns, stretch.to_ns, std::max(off_m.value_or(0.0), otherwise_m),
                       Wrong::kOdometry);
      chain.allow(stretch.from_ns, stretch.to_ns, way_dispute_.growth(1.0), 0.0);
    }
  }
  const auto broken_ns = check_break(chain, stretch);
  if (is_disputed()) return std::min(stretch.from_ns, broken_ns.value_or(stretch.from_ns));
  jump_.reset();
  if (!break_) agreed_ns_ = stretch.to_ns;
  return broken_ns;
}

void CrossCheck::forget() {
  turn_dispute_.end();
  way_dispute_.end();
  agreed_ns_.reset();
  seen_.reset();
  lasting_.reset();
  jump_.reset();
  break_.reset();
}

std::optional<std::string> CrossCheck::fault_of_odometry(std::int64_t now_ns) const {
  if (!way_dispute_.is_on() || !is_fresh(way_dispute_.stamp_ns(), now_ns)) return std::nullopt;
  return "odometry moves otherwise than the panoramas see";
}

std::vector<Doubt> CrossCheck::doubts(std::int64_t now_ns) const {
  std::vector<Doubt> doubts;
  if (break_) {
    doubts.push_back(
        {kReach * way_sigma_m(motion_, kUnseen_s), true,
         "odometry lost sight of what it saw, and no panorama has told yet that the vehicle was not moved"});
  }
  if (jump_ && is_fresh(jump_->stamp_ns, now_ns)) {
    doubts.push_back(
        {jump_->speed_m_s * kAlarm_s, true, "the speed of the odometry changed as that of no vehicle does"});
  }
  if (turn_dispute_.is_on() && is_fresh(turn_dispute_.stamp_ns(), now_ns)) {
    doubts.push_back({0.0, true, "odometry and panoramas turn differently"});
  }
  if (way_dispute_.is_on() && is_fresh(way_dispute_.stamp_ns(), now_ns)) {
    doubts.push_back({0.0, true, "odometry and panoramas move differently"});
  }
  return doubts;
}

/// One of the two cameras is turned by that, and nobody knows which. Without panoramas the mount of the stereo camera is believed.
double CrossCheck::direction_sigma_rad() const {
  DirectionOffset offset = direction_offset_;
  if (seen_) offset.add(seen_->difference_rad, seen_->variance_rad2);
  if (!offset.is_measured()) return 0.0;
  const double off_rad = std::abs(offset.estimate_rad());
  const double turned_rad = off_rad > kNoStereoMount_rad ? 0.0 : std::max(0.0, off_rad - kAlike_rad);
  return std::hypot(turned_rad, std::sqrt(offset.variance_rad2()));
}

auto CrossCheck::moved(const OdometryChain& chain, std::int64_t from_ns, std::int64_t to_ns)
    -> std::optional<TurnAndWay> {
  const auto from = chain.at(from_ns), to = chain.at(to_ns);
  if (!from || !to) return std::nullopt;
  const Eigen::Isometry3d from_to = from->pose.odom_from_base.inverse() * to->pose.odom_from_base;
  const Eigen::Vector3d way = from_to.linear().transpose() * from_to.translation();
  return TurnAndWay{yaw_of(from_to.linear()), way.head<2>()};
}

auto CrossCheck::gone_on(const OdometryChain& chain, std::int64_t to_ns) const -> std::optional<GoneOn> {
  if (!agreed_ns_) return std::nullopt;
  const auto before = moved(chain, *agreed_ns_ - static_cast<std::int64_t>(kSteady_s * 1e9), *agreed_ns_);
  const auto since = moved(chain, *agreed_ns_, to_ns);
  if (!before || !since) return std::nullopt;
  const double time_s = seconds(*agreed_ns_, to_ns), times = time_s / kSteady_s;
  return GoneOn{{wrapped(since->turn_rad - times * before->turn_rad), since->way_m - times * before->way_m},
                turn_sigma_rad(motion_, time_s),
                way_sigma_m(motion_, time_s)};
}

bool CrossCheck::goes_on_steadily(const OdometryChain& chain, std::int64_t to_ns) const {
  const auto gone = gone_on(chain, to_ns);
  return !gone || gone->more.way_m.norm() < kSteady * (gone->way_sigma_m + kOdometryError_m);
}

/// Panoramas see all around, and movers cover little of them: as a rule it is the odometry that followed something else [Lu2015 6]. But where
/// odometry goes on as the vehicle did and the panoramas as no vehicle does, it is their camera that was turned.
Wrong CrossCheck::wrong_turn(const OdometryChain& chain, std::int64_t to_ns, double disagreement_rad) const {
  const auto gone = gone_on(chain, to_ns);
  if (!gone) return Wrong::kOdometry;
  const bool is_steady = std::abs(gone->more.turn_rad) < kSteady * gone->turn_sigma_rad;
  const bool is_impossible =
      std::abs(wrapped(gone->more.turn_rad + disagreement_rad)) > kImpossible * gone->turn_sigma_rad;
  return is_steady && is_impossible ? Wrong::kPanoramas : Wrong::kOdometry;
}

/// How far the odometry's way lies off what the panoramas see of it; nullopt where they agree.
std::optional<double> CrossCheck::way_off(const AzimuthMeasurement& azimuth, const TurnAndWay& odometry,
                                          double way_variance_m2) {
  const double length_m = odometry.way_m.norm();
  if (std::abs(azimuth.side_parallax_rad) > length_m / kNearest_m + kParallax_rad) return length_m;
  if (length_m < kShortestWay_m) return std::nullopt;
  const bool do_panoramas_stand = azimuth.motion_azimuth_variance_rad2 > kNoDirection_rad2;
  if (do_panoramas_stand) return length_m > kClearlyMoved_m ? std::optional(length_m) : std::nullopt;
  const double in_bend_rad = kCameraApart_m * odometry.turn_rad / length_m;
  const double variance = azimuth.motion_azimuth_variance_rad2 + kDirectionError_rad * kDirectionError_rad +
                          in_bend_rad * in_bend_rad + way_variance_m2 / (length_m * length_m);
  const double seen_rad = wrapped(azimuth.motion_azimuth_rad - azimuth_of(odometry.way_m) - camera_turned_rad_);
  const double difference_rad = wrapped(seen_rad - direction_offset_.estimate_rad());
  const double most_rad = contradiction_sigmas_ * std::sqrt(variance + direction_offset_.variance_rad2());
  if (std::abs(difference_rad) <= most_rad) {
    if (!turn_dispute_.is_on()) seen_ = Seen{seen_rad, variance};
    lasting_.reset();
    return std::nullopt;
  }
  if (is_camera_turned()) camera_turned_rad_ = wrapped(camera_turned_rad_ + difference_rad);
  if (!turn_dispute_.is_on() && lasts(azimuth.from_ns, seen_rad, length_m)) {
    direction_offset_.restart(seen_rad, variance);
    return std::nullopt;
  }
  return length_m * std::sin(std::min(std::abs(difference_rad), 0.5 * std::numbers::pi));
}

/// Whether the directions have differed by one angle for so long that no mover is the cause, but a camera that sits otherwise than is thought.
bool CrossCheck::lasts(std::int64_t reference_ns, double seen_rad, double length_m) {
  if (!lasting_ || std::abs(wrapped(seen_rad - lasting_->seen_rad)) > kSameAngle_rad) {
    lasting_ = Lasting{reference_ns, seen_rad, 0.0};
  } else if (lasting_->reference_ns != reference_ns) {
    lasting_->reference_ns = reference_ns;
    lasting_->way_m += length_m;
  }
  return lasting_->way_m > kLasting_m;
}

/// Odometry that lost sight of all that it saw and began anew in the next image tells nothing of what lay between. Panoramas that found their
/// points again from before to after vouch for it. Where there are none the vehicle may be anywhere near, since the time that is returned.
std::optional<std::int64_t> CrossCheck::check_break(OdometryChain& chain, const Stretch& stretch) {
  if (!break_) return std::nullopt;
  if (stretch.from_ns > break_->vouched_ns) {
    const std::int64_t since_ns = break_->from_ns;
    chain.allow(since_ns, break_->to_ns, std::pow(way_sigma_m(motion_, kUnseen_s), 2),
                std::pow(turn_sigma_rad(motion_, kUnseen_s), 2));
    break_.reset();
    return since_ns;
  }
  if (!is_disputed() && goes_on_steadily(chain, stretch.to_ns)) {
    break_->vouched_ns = std::max(break_->vouched_ns, stretch.to_ns);
    if (break_->is_over && break_->vouched_ns >= break_->to_ns) break_.reset();
  }
  return std::nullopt;
}

bool CrossCheck::is_fresh(std::int64_t stamp_ns, std::int64_t now_ns) const {
  return seconds(stamp_ns, now_ns) < patience_s_;
}

}  // namespace panvo::localizer
