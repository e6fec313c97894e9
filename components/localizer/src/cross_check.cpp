// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/cross_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "panvo/vision/angle.hpp"
#include "panvo/vision/seconds.hpp"

namespace panvo::localizer {
namespace {

constexpr double kUnseen_s = 5.0;           // unseen motion of the vehicle is bounded by that of so long a silence
constexpr double kReach = 3.0;              // standard deviations of that
constexpr double kAlarm_s = 0.5;            // time until a panorama confirms or refutes the jump
constexpr double kIntervals = 2.5;          // until it is too late for the next panorama, if one was lost
constexpr double kLongestInterval_s = 2.0;  // of panoramas: at longer ones, too much may have changed in between
constexpr double kImpossible = 6.0;         // standard deviations of usual vehicle motion

constexpr double kDirectionError_rad = 0.01;     // of panoramas, in addition to their stated error
constexpr double kCameraApart_m = 1.0;           // from base_link, which in a bend moves in another direction
constexpr double kMinWay_m = 0.1;                // for a defined direction
constexpr double kClearlyMoved_m = 0.5;          // far enough to be visible in objects beside the path
constexpr double kNoDirection_rad2 = 0.1 * 0.1;  // unknown: nothing moves, or several motions explain the panoramas
constexpr double kFarthest_m = 1000.0;           // what moves less beside the path than objects there does not move
constexpr double kStandingReach = 3.0;           // standard deviations of the turn, which looks like motion there
constexpr double kNearest_m = 0.3, kParallax_rad = 0.02;  // objects beside the path are farther away, in the median
constexpr double kApart = 3.0;                            // standard deviations: of two explanations, only one
constexpr double kLasting_m = 30.0;

double azimuth_of(const Eigen::Vector2d& way) { return std::atan2(way.y(), way.x()); }

}  // namespace

CrossCheck::CrossCheck(const Parameters& parameters)
    : contradiction_sigmas_(parameters.contradiction_sigmas),
      patience_s_(parameters.patience_s),
      motion_(parameters.motion),
      stereo_mounting_sigma_rad_(parameters.stereo_mounting_sigma_deg * vision::kDegree),
      direction_offset_(parameters.mounting_sigma_deg * vision::kDegree) {}

/// If odometry follows something else, its speed changes abruptly, long before a panorama shows it.
void CrossCheck::add_step(const OdometryBuffer& chain) {
  const auto& now = chain.latest().pose;
  const auto before_ns = chain.stamp_before_latest(1);
  look_for_jump(chain);
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

std::optional<Wrong> CrossCheck::add_turns(const OdometryBuffer& chain, const Stretch& stretch,
                                           const Disagreement& turns) {
  note_panorama(stretch.to_ns);
  if (!turns.is_too_much) {
    turn_dispute_.end();
    return std::nullopt;
  }
  turn_dispute_.add(stretch.reference_ns, stretch.to_ns, turns.rad, judge_turn(chain, stretch.to_ns, turns));
  return turn_dispute_.blame().wrong;
}

/// Odometry that contradicts the panoramas followed something else. Its error is at least its component perpendicular
/// to their direction, and at least its deviation from the previous motion. Not if the panoramic camera was just
/// rotated.
std::optional<std::int64_t> CrossCheck::add_ways(OdometryBuffer& chain, const Stretch& stretch,
                                                 const AzimuthMeasurement& azimuth, double way_variance_m2) {
  if (turn_dispute_.is_on()) {
    chain.allow(stretch.from_ns, stretch.to_ns, 0.0, turn_dispute_.growth(turn_dispute_.blame().doubt));
  }
  drop_old_jump(stretch.to_ns);
  const auto odometry = moved(chain, stretch.from_ns, stretch.to_ns);
  if (odometry && azimuth.motion_azimuth_variance_rad2 > 0.0) {
    const auto verdict = judge_way(azimuth, *odometry, way_variance_m2);
    take(verdict);
    auto off_m = verdict.off_m;
    if (!off_m) off_m = settle_jump(chain, stretch, odometry->way_m.norm(), azimuth.side_parallax_rad);
    if (is_camera_turned() || (!off_m && !turn_dispute_.is_on())) {
      end_way_dispute();
    } else {
      const auto gone = is_old_jump(stretch.to_ns) ? std::nullopt : gone_on(chain, stretch.to_ns);
      const double part =
          gone ? vision::seconds(stretch.from_ns, stretch.to_ns) / vision::seconds(*agreed_ns_, stretch.to_ns) : 0.0;
      const double otherwise_m = gone ? gone->more.way_m.norm() * std::min(1.0, part) : 0.0;
      dispute_way(stretch, std::max(off_m.value_or(0.0), otherwise_m));
      chain.allow(stretch.from_ns, stretch.to_ns, way_dispute_.growth(1.0), 0.0);
    }
  }
  const auto broken_ns = settle_break(chain, stretch);
  const std::int64_t unsure_ns = std::min(stretch.from_ns, broken_ns.value_or(stretch.from_ns));
  if (jump_ && jump_->contradicted_ns) return std::min(unsure_ns, *agreed_ns_);
  if (is_disputed() || unsure_.is_on()) return unsure_ns;
  if (!break_ && !jump_) agreed_ns_ = stretch.to_ns;
  if (odometry && !break_ && !jump_) {
    witness_.add(chain.at(stretch.to_ns)->way_m, odometry->way_m.norm(), azimuth.side_parallax_rad);
  }
  return broken_ns;
}

void CrossCheck::confirm_pose(std::int64_t stamp_ns) {
  if (break_ && break_->is_over && break_->to_ns <= stamp_ns) break_.reset();
}

void CrossCheck::forget() {
  turn_dispute_.end();
  end_way_dispute();
  agreed_ns_.reset();
  seen_.reset();
  lasting_.reset();
  end_jump();
  witness_.forget();
  speed_agreed_ns_.reset();
  break_.reset();
  panorama_ns_.reset();
}

std::optional<std::string> CrossCheck::fault_of_odometry(std::int64_t now_ns) const {
  if (!way_dispute_.is_on() || !is_fresh(way_dispute_.stamp_ns(), now_ns)) return std::nullopt;
  return "odometry contradicts the motion in the panoramas";
}

std::vector<Doubt> CrossCheck::doubts(std::int64_t now_ns) const {
  std::vector<Doubt> doubts;
  if (break_) {
    doubts.push_back({kReach * way_sigma_m(motion_, kUnseen_s), true,
                      "odometry lost track, and nothing has confirmed yet that the vehicle was not moved"});
  }
  if (jump_ && is_fresh(jump_->last_ns(), now_ns)) {
    const double since_s = vision::seconds(jump_->contradicted_ns.value_or(jump_->since_ns), now_ns);
    doubts.push_back(
        {jump_->speed_m_s * std::max(kAlarm_s, since_s), true, "implausible change of the odometry's speed"});
  }
  if (turn_dispute_.is_on() && is_fresh(turn_dispute_.stamp_ns(), now_ns)) {
    doubts.push_back({0.0, true, "odometry and panoramas disagree on the rotation"});
  }
  if (way_dispute_.is_on() && is_fresh(way_dispute_.stamp_ns(), now_ns)) {
    doubts.push_back({0.0, true, "odometry and panoramas disagree on the motion"});
  }
  return doubts;
}

auto CrossCheck::moved(const OdometryBuffer& chain, std::int64_t from_ns, std::int64_t to_ns)
    -> std::optional<TurnAndWay> {
  const auto from = chain.at(from_ns), to = chain.at(to_ns);
  if (!from || !to) return std::nullopt;
  const Eigen::Isometry3d from_to = from->pose.odom_from_base.inverse() * to->pose.odom_from_base;
  const Eigen::Vector3d way = from_to.linear().transpose() * from_to.translation();
  return TurnAndWay{yaw_of(from_to.linear()), way.head<2>()};
}

auto CrossCheck::gone_on(const OdometryBuffer& chain, std::int64_t to_ns) const -> std::optional<GoneOn> {
  if (!agreed_ns_) return std::nullopt;
  const auto before = moved(chain, *agreed_ns_ - static_cast<std::int64_t>(kSteady_s * 1e9), *agreed_ns_);
  const auto since = moved(chain, *agreed_ns_, to_ns);
  if (!before || !since) return std::nullopt;
  const double time_s = vision::seconds(*agreed_ns_, to_ns), times = time_s / kSteady_s;
  return GoneOn{{vision::wrapped(since->turn_rad - times * before->turn_rad), since->way_m - times * before->way_m},
                turn_sigma_rad(motion_, time_s),
                way_sigma_m(motion_, time_s)};
}

bool CrossCheck::goes_on_steadily(const OdometryBuffer& chain, std::int64_t to_ns) const {
  const auto gone = gone_on(chain, to_ns);
  return !gone || gone->more.way_m.norm() < kSteady * (gone->way_sigma_m + kOdometryError_m);
}

/// Panoramas see all around, and moving objects cover little of them, so usually odometry is the one that followed
/// something else [Lu2015 6]. If odometry continues the previous motion, and the panoramas turn implausibly or show that
/// a mount was turned, their camera was rotated.
Blame CrossCheck::judge_turn(const OdometryBuffer& chain, std::int64_t to_ns, const Disagreement& turns) const {
  const auto gone = gone_on(chain, to_ns);
  if (!gone || std::abs(gone->more.turn_rad) >= kSteady * gone->turn_sigma_rad) return {Wrong::kOdometry, kDoubt};
  if (turns.is_of_mount) return {Wrong::kPanoramas, kDoubt * kDoubt};
  const bool is_impossible =
      std::abs(vision::wrapped(gone->more.turn_rad + turns.rad)) > kImpossible * gone->turn_sigma_rad;
  return {is_impossible ? Wrong::kPanoramas : Wrong::kOdometry, kDoubt};
}

bool CrossCheck::shows_turned_mount(const OdometryBuffer& chain, const Stretch& stretch,
                                    const AzimuthMeasurement& azimuth, double turned_rad,
                                    double way_variance_m2) const {
  const auto odometry = moved(chain, stretch.from_ns, stretch.to_ns);
  const bool are_directions_known =
      odometry && odometry->way_m.norm() >= kMinWay_m && azimuth.motion_azimuth_variance_rad2 > 0.0 &&
      azimuth.motion_azimuth_variance_rad2 <= kNoDirection_rad2 && direction_offset_.is_measured();
  if (!are_directions_known) return false;
  const auto [seen_rad, variance_rad2] = seen_directions(azimuth, *odometry, way_variance_m2);
  const double errors_rad = kApart * std::sqrt(variance_rad2 + direction_offset_.variance_rad2());
  const double turned_back_rad = vision::wrapped(seen_rad - direction_offset_.estimate_rad());
  return std::abs(turned_rad) > 2.0 * errors_rad &&
         std::abs(vision::wrapped(turned_back_rad + turned_rad)) < errors_rad;
}

/// Difference of the directions of motion, with its variance.
auto CrossCheck::seen_directions(const AzimuthMeasurement& azimuth, const TurnAndWay& odometry,
                                 double way_variance_m2) const -> Seen {
  const double length_m = odometry.way_m.norm();
  const double in_bend_rad = kCameraApart_m * odometry.turn_rad / length_m;
  return {vision::wrapped(azimuth.motion_azimuth_rad - azimuth_of(odometry.way_m) - camera_turned_rad_),
          azimuth.motion_azimuth_variance_rad2 + kDirectionError_rad * kDirectionError_rad + in_bend_rad * in_bend_rad +
              way_variance_m2 / (length_m * length_m)};
}

/// Whether odometry's path agrees with the panoramas. Changes nothing: see take().
auto CrossCheck::judge_way(const AzimuthMeasurement& azimuth, const TurnAndWay& odometry, double way_variance_m2) const
    -> WayVerdict {
  WayVerdict verdict;
  verdict.lasting = lasting_;
  const double length_m = odometry.way_m.norm();
  if (std::abs(azimuth.side_parallax_rad) > length_m / kNearest_m + kParallax_rad) {
    verdict.off_m = length_m;
    return verdict;
  }
  if (length_m < kMinWay_m) return verdict;
  if (azimuth.motion_azimuth_variance_rad2 > kNoDirection_rad2) {
    const double at_most_rad = std::abs(azimuth.side_parallax_rad) + kStandingReach * std::sqrt(azimuth.variance_rad2);
    const bool do_panoramas_stand = at_most_rad < length_m / kFarthest_m;
    if (do_panoramas_stand && length_m > kClearlyMoved_m) verdict.off_m = length_m;
    return verdict;
  }
  const auto [seen_rad, variance] = seen_directions(azimuth, odometry, way_variance_m2);
  const DirectionOffset offset = offset_before({seen_rad, variance});
  verdict.is_other_mounting = direction_offset_.is_only_remembered() && !offset.is_only_remembered();
  const double difference_rad = vision::wrapped(seen_rad - offset.estimate_rad());
  if (std::abs(difference_rad) <= allowed_rad(variance, offset)) {
    if (!turn_dispute_.is_on()) verdict.seen = Seen{seen_rad, variance};
    verdict.lasting.reset();
    return verdict;
  }
  if (is_camera_turned()) verdict.camera_turned_rad = vision::wrapped(camera_turned_rad_ + difference_rad);
  if (!turn_dispute_.is_on()) {
    verdict.lasting = lasting_with(azimuth.from_ns, seen_rad, length_m);
    if (verdict.lasting->way_m > kLasting_m) {
      verdict.new_offset = Seen{seen_rad, variance};
      return verdict;
    }
  }
  verdict.off_m = length_m * std::sin(std::min(std::abs(difference_rad), 0.5 * std::numbers::pi));
  return verdict;
}

void CrossCheck::take(const WayVerdict& verdict) {
  if (verdict.is_other_mounting) direction_offset_.forget_memory();
  if (verdict.seen) seen_ = verdict.seen;
  lasting_ = verdict.lasting;
  if (verdict.new_offset)
    direction_offset_.restart(verdict.new_offset->difference_rad, verdict.new_offset->variance_rad2);
  if (verdict.camera_turned_rad) camera_turned_rad_ = *verdict.camera_turned_rad;
}

/// Odometry that lost all its points and restarted in the next image did not measure the motion between. Panoramas that
/// found their points again across the gap confirm it. Otherwise the vehicle may have moved since the returned time.
std::optional<std::int64_t> CrossCheck::settle_break(OdometryBuffer& chain, const Stretch& stretch) {
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

void CrossCheck::note_panorama(std::int64_t stamp_ns) {
  if (panorama_ns_ && stamp_ns <= *panorama_ns_) return;
  if (panorama_ns_) panorama_intervals_s_ = {panorama_intervals_s_[1], vision::seconds(*panorama_ns_, stamp_ns)};
  panorama_ns_ = stamp_ns;
}

/// Of two intervals, one may be a gap.
bool CrossCheck::is_fresh(std::int64_t stamp_ns, std::int64_t now_ns) const {
  const double interval_s = std::min({panorama_intervals_s_[0], panorama_intervals_s_[1], kLongestInterval_s});
  return vision::seconds(stamp_ns, now_ns) < std::max(patience_s_, kIntervals * interval_s);
}

}  // namespace panvo::localizer
