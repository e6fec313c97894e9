// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/odometry_buffer.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <type_traits>

#include "panvo/localizer/dead_reckoning.hpp"
#include "panvo/vision/seconds.hpp"
#include "panvo/vision/step_covariance.hpp"

namespace panvo::localizer {
namespace {

constexpr double kMinStepVariance = 1e-12;  // for rounding errors
// A panorama of the same instant as the last stereo pair may be stamped slightly later due to clock differences.
// Waiting for the next pair would cost 40 ms; constant motion for that time is accurate to less than a millimetre.
constexpr std::int64_t kAhead_ns = 5'000'000;

/// Variance of the sum of an error along a way, relative to that of a constant error, if its correlation decreases
/// exponentially.
double persisting_share(double way_m, double memory_m) {
  constexpr double kShort = 1e-4;  // without loss of digits
  const double ways = memory_m > 0.0 ? way_m / memory_m : 0.0;
  return ways < kShort ? 1.0 : 2.0 * (ways + std::expm1(-ways)) / (ways * ways);
}

/// Yaw from one pose to another. The sum of the steps' yaws only tells the number of whole turns, as tilted steps turn
/// about other axes.
double unwrapped_turn(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, double sum_rad) {
  constexpr double kWhole_rad = 2.0 * std::numbers::pi;
  const double turn_rad = yaw_of((from.inverse() * to).linear());
  return turn_rad + kWhole_rad * std::round((sum_rad - turn_rad) / kWhole_rad);
}

double between(std::int64_t stamp_ns, std::int64_t from_ns, std::int64_t to_ns) {
  return static_cast<double>(stamp_ns - from_ns) / static_cast<double>(to_ns - from_ns);
}

}  // namespace

vision::Matrix6d gained_covariance(const OdometryPose& a, const OdometryPose& b, double min_variance) {
  return vision::step_covariance(a.odom_from_base, a.covariance, b.odom_from_base, b.covariance, min_variance);
}

vision::Matrix6d covariance_of_turns(const OdometrySample& a, const OdometrySample& b, const TurnErrors& errors) {
  const Eigen::Vector2d way = (b.pose.odom_from_base.translation() - a.pose.odom_from_base.translation()).head<2>();
  const auto by_error = [&](double turn_rad, const Eigen::Vector2d& heading_over_way) {
    vision::Vector6d moved;  // in the odometry's axes
    moved << -heading_over_way.y(), heading_over_way.x(), 0.0, 0.0, 0.0, turn_rad;
    return moved;
  };
  Eigen::Matrix<double, 6, 2> slope;
  slope << by_error(b.unmeasured_turn_rad - a.unmeasured_turn_rad,
                    b.turn_moment - a.turn_moment - a.unmeasured_turn_rad * way),
      by_error(b.unmeasured_way_m - a.unmeasured_way_m, b.way_moment - a.way_moment - a.unmeasured_way_m * way);
  slope.col(1) *= std::sqrt(persisting_share(b.way_m - a.way_m, errors.lean_memory_m));
  return vision::rotate_covariance(a.pose.odom_from_base.linear().transpose(),
                                   slope * errors.covariance * slope.transpose());
}

double yaw_of(const Eigen::Matrix3d& rotation) { return std::atan2(rotation(1, 0), rotation(0, 0)); }

Eigen::Isometry3d turned_more(const Eigen::Isometry3d& step, double by_rad) {
  Eigen::Isometry3d turned = step;
  turned.translation() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, 0.5 * by_rad)) * step.translation();
  turned.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, by_rad)) * step.linear();
  return turned;
}

bool OdometryBuffer::add(const OdometryPose& odometry, double turn_error_rad, const vision::Matrix6d& least,
                         double turn_variance_rad2) {
  if (!odometry.odom_from_base.matrix().allFinite() || !odometry.covariance.allFinite()) return false;
  if (!entries_.empty() && odometry.stamp_ns <= entries_.back().raw.stamp_ns) return false;
  Entry entry;
  entry.raw = odometry;
  entry.now.pose = odometry;
  if (!entries_.empty()) {
    const auto& before = entries_.back();
    const Eigen::Isometry3d moved = before.raw.odom_from_base.inverse() * odometry.odom_from_base;
    entry.raw_turn_rad = before.raw_turn_rad + yaw_of(moved.linear());
    entry.step.motion = turned_more(moved, -turn_error_rad);
    entry.step.covariance = gained_covariance(before.raw, odometry, kMinStepVariance);
    entry.step.covariance = at_least(entry.step.covariance, least);
    entry.step.covariance(vision::kYaw, vision::kYaw) += turn_variance_rad2;
    entry.marked = entry.step;
  }
  entries_.push_back(entry);
  compose_from(entries_.size() - 1);
  while (static_cast<double>(odometry.stamp_ns - entries_.front().raw.stamp_ns) > history_s_ * vision::kSecond_ns) {
    entries_.pop_front();
  }
  return true;
}

std::optional<std::int64_t> OdometryBuffer::stamp_before_latest(std::size_t poses) const {
  if (entries_.size() <= poses) return std::nullopt;
  return entries_[entries_.size() - 1 - poses].raw.stamp_ns;
}

std::optional<OdometrySample> OdometryBuffer::at(std::int64_t stamp_ns) const {
  const auto place = place_of(stamp_ns);
  if (!place) return std::nullopt;
  const auto& after = entries_[place->after].now;
  if (after.pose.stamp_ns == stamp_ns) return after;
  const auto& before = entries_[place->after - 1].now;
  OdometrySample here = after;
  here.pose.stamp_ns = stamp_ns;
  here.pose.odom_from_base = vision::interpolate(before.pose.odom_from_base, after.pose.odom_from_base, place->share);
  here.pose.covariance = (1.0 - place->share) * before.pose.covariance + place->share * after.pose.covariance;
  const auto between = [&](const auto& from, const auto& to) {
    return std::decay_t<decltype(from)>((1.0 - place->share) * from + place->share * to);
  };
  here.way_m = between(before.way_m, after.way_m);
  here.turn_rad = between(before.turn_rad, after.turn_rad);
  here.unmeasured_way_m = between(before.unmeasured_way_m, after.unmeasured_way_m);
  here.unmeasured_turn_rad = between(before.unmeasured_turn_rad, after.unmeasured_turn_rad);
  here.way_moment = between(before.way_moment, after.way_moment);
  here.turn_moment = between(before.turn_moment, after.turn_moment);
  return here;
}

std::optional<Turn> OdometryBuffer::turn(std::int64_t from_ns, std::int64_t to_ns) const {
  const auto from = at(from_ns);
  const auto to = at(to_ns);
  if (!from || !to || from_ns >= to_ns) return std::nullopt;
  Turn turn;
  turn.change_rad = unwrapped_turn(from->pose.odom_from_base, to->pose.odom_from_base, to->turn_rad - from->turn_rad);
  for (std::size_t i = first_after(from_ns); i < entries_.size(); ++i) {
    const double part = share(i, from_ns, to_ns);
    if (part <= 0.0) break;
    turn.variance_rad2 += part * entries_[i].step.yaw_variance_rad2();
  }
  return turn;
}

std::optional<double> OdometryBuffer::raw_turn(std::int64_t from_ns, std::int64_t to_ns) const {
  const auto from = raw_at(from_ns);
  const auto to = raw_at(to_ns);
  if (!from || !to) return std::nullopt;
  return unwrapped_turn(from->odom_from_base, to->odom_from_base, to->turn_rad - from->turn_rad);
}

auto OdometryBuffer::raw_at(std::int64_t stamp_ns) const -> std::optional<RawPose> {
  const auto place = place_of(stamp_ns);
  if (!place) return std::nullopt;
  const Entry& after = entries_[place->after];
  if (after.raw.stamp_ns == stamp_ns) return RawPose{after.raw.odom_from_base, after.raw_turn_rad};
  const Entry& before = entries_[place->after - 1];
  return RawPose{vision::interpolate(before.raw.odom_from_base, after.raw.odom_from_base, place->share),
                 before.raw_turn_rad + place->share * (after.raw_turn_rad - before.raw_turn_rad)};
}

std::optional<vision::Vector6d> OdometryBuffer::twist(std::int64_t stamp_ns) const {
  const auto place = place_of(stamp_ns);
  if (!place || place->after == 0) return std::nullopt;
  const auto& entry = entries_[place->after];
  vision::Vector6d moved;
  moved << entry.step.motion.translation(), vision::so3_log(entry.step.motion.linear());
  return moved * vision::kSecond_ns / static_cast<double>(entry.raw.stamp_ns - entries_[place->after - 1].raw.stamp_ns);
}

void OdometryBuffer::inflate_covariance(std::int64_t from_ns, std::int64_t to_ns, double factor, double max_total) {
  const std::size_t first = first_after(from_ns);
  for (std::size_t i = first; i < entries_.size(); ++i) {
    const double part = share(i, from_ns, to_ns);
    if (part <= 0.0) break;
    Step& step = entries_[i].step;
    const double widened = std::max(step.widened, 1.0 + part * (std::min(factor, max_total) - 1.0));
    vision::Vector6d scale = vision::Vector6d::Constant(std::sqrt(widened / step.widened));
    scale[vision::kYaw] = std::sqrt(1.0 + part * (factor - 1.0));
    step.covariance = scale.asDiagonal() * step.covariance * scale.asDiagonal();
    step.widened = widened;
  }
  compose_from(first);
}

void OdometryBuffer::apply_yaw_correction(std::int64_t from_ns, std::int64_t to_ns, double by_rad,
                                          double variance_factor) {
  const auto stretch = turn(from_ns, to_ns);
  if (!stretch || !(stretch->variance_rad2 > 0.0)) return;
  const std::size_t first = first_after(from_ns);
  for (std::size_t i = first; i < entries_.size(); ++i) {
    const double part = share(i, from_ns, to_ns);
    if (part <= 0.0) break;
    Step& step = entries_[i].step;
    const double weight = part * step.yaw_variance_rad2() / stretch->variance_rad2;
    step.motion = turned_more(step.motion, weight * by_rad);
    const double kept = 1.0 + part * (variance_factor - 1.0);
    step.covariance.row(vision::kYaw) *= std::sqrt(kept);
    step.covariance.col(vision::kYaw) *= std::sqrt(kept);
    step.odometry_weight *= kept;
  }
  compose_from(first);
}

void OdometryBuffer::correct_turns(const TurnErrorChange& learned) {
  for (std::size_t i = 1; i < entries_.size(); ++i) {
    auto& step = entries_[i].step;
    const double ago_m = entries_.back().now.way_m - entries_[i].now.way_m;
    const double same = learned.lean_memory_m > 0.0 ? std::exp(-ago_m / learned.lean_memory_m) : 1.0;
    const double error_rad =
        learned.scale * yaw_of(step.motion.linear()) + same * learned.lean_rad_m * step.motion.translation().norm();
    step.motion = turned_more(step.motion, -step.odometry_weight * error_rad);
  }
  compose_from(1);
}

void OdometryBuffer::undo_turns(std::int64_t from_ns, const TurnErrorFilter& known) {
  const std::size_t first = std::max<std::size_t>(first_after(from_ns), 1);
  for (std::size_t i = first; i < entries_.size(); ++i) {
    Step& step = entries_[i].step;
    const Eigen::Isometry3d moved = entries_[i - 1].raw.odom_from_base.inverse() * entries_[i].raw.odom_from_base;
    step.motion = turned_more(moved, -known.error_rad(yaw_of(moved.linear()), moved.translation().norm()));
    step.covariance.row(vision::kYaw) /= std::sqrt(step.odometry_weight);
    step.covariance.col(vision::kYaw) /= std::sqrt(step.odometry_weight);
    step.odometry_weight = 1.0;
    entries_[i].marked = step;
  }
  compose_from(first);
}

void OdometryBuffer::allow(std::int64_t from_ns, std::int64_t to_ns, double way_variance_m2, double yaw_variance_rad2) {
  const std::size_t first = first_after(from_ns);
  for (std::size_t i = std::max<std::size_t>(first, 1); i < entries_.size(); ++i) {
    const std::int64_t begin_ns = std::max(entries_[i - 1].raw.stamp_ns, from_ns);
    const std::int64_t end_ns = std::min(entries_[i].raw.stamp_ns, to_ns);
    if (end_ns <= begin_ns) break;
    const double part = static_cast<double>(end_ns - begin_ns) / static_cast<double>(to_ns - from_ns);
    auto& covariance = entries_[i].step.covariance;
    covariance.topLeftCorner<2, 2>() += part * way_variance_m2 * Eigen::Matrix2d::Identity();
    covariance(vision::kYaw, vision::kYaw) += part * yaw_variance_rad2;
  }
  compose_from(first);
}

void OdometryBuffer::set_clock_back(std::int64_t by_ns) {
  for (auto& entry : entries_) {
    entry.raw.stamp_ns -= by_ns;
    entry.now.pose.stamp_ns -= by_ns;
  }
  marked_from_ns_ -= by_ns;
}

void OdometryBuffer::mark(std::int64_t from_ns) {
  marked_from_ns_ = from_ns;
  for (std::size_t i = first_after(from_ns); i < entries_.size(); ++i) entries_[i].marked = entries_[i].step;
}

void OdometryBuffer::revert() {
  const std::size_t first = first_after(marked_from_ns_);
  for (std::size_t i = first; i < entries_.size(); ++i) entries_[i].step = entries_[i].marked;
  compose_from(first);
}

std::optional<OdometryBuffer::Place> OdometryBuffer::place_of(std::int64_t stamp_ns) const {
  std::size_t after = first_after(stamp_ns - 1);  // first entry that is not before
  if (after == entries_.size()) {
    if (entries_.size() < 2 || stamp_ns - entries_.back().raw.stamp_ns > kAhead_ns) return std::nullopt;
    --after;
  }
  const std::int64_t after_ns = entries_[after].raw.stamp_ns;
  if (after_ns == stamp_ns) return Place{after, 1.0};
  if (after == 0) return std::nullopt;
  return Place{after, between(stamp_ns, entries_[after - 1].raw.stamp_ns, after_ns)};
}

/// Index of the first entry later than a time.
std::size_t OdometryBuffer::first_after(std::int64_t stamp_ns) const {
  const auto found =
      std::upper_bound(entries_.begin(), entries_.end(), stamp_ns,
                       [](std::int64_t at_ns, const Entry& entry) { return at_ns < entry.raw.stamp_ns; });
  return static_cast<std::size_t>(std::distance(entries_.begin(), found));
}

/// Fraction of a step within a stretch, [0, 1].
double OdometryBuffer::share(std::size_t index, std::int64_t from_ns, std::int64_t to_ns) const {
  if (index == 0) return 0.0;
  const std::int64_t begin_ns = entries_[index - 1].raw.stamp_ns;
  const std::int64_t end_ns = entries_[index].raw.stamp_ns;
  const auto overlap_ns = static_cast<double>(std::min(end_ns, to_ns) - std::max(begin_ns, from_ns));
  return std::clamp(overlap_ns / static_cast<double>(end_ns - begin_ns), 0.0, 1.0);
}

/// Recomputes the composed poses from an entry on.
void OdometryBuffer::compose_from(std::size_t index) {
  for (std::size_t i = std::max<std::size_t>(index, 1); i < entries_.size(); ++i) {
    const auto& before = entries_[i - 1].now;
    auto& entry = entries_[i];
    entry.now.pose.odom_from_base = before.pose.odom_from_base * entry.step.motion;
    entry.now.pose.odom_from_base.linear() = vision::nearest_rotation(entry.now.pose.odom_from_base.linear());
    entry.now.pose.covariance = vision::compose_covariance(before.pose.odom_from_base, before.pose.covariance,
                                                           entry.step.motion, entry.step.covariance);
    const double length_m = entry.step.motion.translation().norm();
    const double unmeasured_m = entry.step.odometry_weight * length_m;
    const double turn_rad = yaw_of(entry.step.motion.linear());
    const double unmeasured_rad = entry.step.odometry_weight * turn_rad;
    const Eigen::Vector2d way =
        (entry.now.pose.odom_from_base.translation() - before.pose.odom_from_base.translation()).head<2>();
    entry.now.way_m = before.way_m + length_m;
    entry.now.turn_rad = before.turn_rad + turn_rad;
    entry.now.unmeasured_way_m = before.unmeasured_way_m + unmeasured_m;
    entry.now.unmeasured_turn_rad = before.unmeasured_turn_rad + unmeasured_rad;
    entry.now.way_moment = before.way_moment + (before.unmeasured_way_m + 0.5 * unmeasured_m) * way;
    entry.now.turn_moment = before.turn_moment + (before.unmeasured_turn_rad + 0.5 * unmeasured_rad) * way;
  }
}

}  // namespace panvo::localizer
