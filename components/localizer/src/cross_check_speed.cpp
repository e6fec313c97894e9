// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "panvo/localizer/cross_check.hpp"
#include "panvo/localizer/speed_jump.hpp"
#include "panvo/vision/seconds.hpp"

/// Processing of jumps of the odometry's speed.
namespace panvo::localizer {
namespace {

constexpr std::size_t kShowsWithin = 4;  // images after a jump
constexpr double kUnlike = 2.0;          // times what usual motion deviates: a jump would show in that time
constexpr double kSame = 0.2;            // fraction of the distance: a smaller difference is not a jump
constexpr double kLongestJump_s = 5.0;   // then, the speed is not as before
constexpr double kTells = 8.0;           // errors of parallax: on a shorter way, it would hardly show half the speed
constexpr double kHalfWay = 0.5;         // half-way between two explanations
constexpr double kSurely = 4.5;          // standard deviations of one sighting: three of two
constexpr std::size_t kMostOff = 1000;   // some minutes of panoramas: sightings come sooner

}  // namespace

void CrossCheck::look_for_jump(const OdometryBuffer& chain) {
  const auto change_m_s = speed_jump_m_s(chain, speed_agreed_ns_);
  const auto since_ns = chain.stamp_before_latest(kShowsWithin);
  if (!change_m_s || !since_ns) return;
  const std::int64_t now_ns = chain.latest().pose.stamp_ns;
  drop_old_jump(now_ns);
  if (!jump_) jump_ = Jump{*since_ns, now_ns, *change_m_s};
  // During a dispute, the motion before was wrong.
  jump_->is_from_agreement = agreed_ns_ && (!is_disputed() || jump_->contradicted_ns);
  jump_->shown_ns = now_ns;
  jump_->speed_m_s = std::max(jump_->speed_m_s, *change_m_s);
  if (agreed_ns_) agreed_ns_ = std::min(*agreed_ns_, *since_ns);
}

/// Compares a stretch with one on which the vehicle goes on as it did before the jump.
auto CrossCheck::unless_it_jumped(const OdometryBuffer& chain, std::int64_t from_ns, std::int64_t to_ns) const
    -> std::optional<Unjumped> {
  if (!agreed_ns_ || to_ns <= *agreed_ns_) return std::nullopt;
  const std::int64_t begin_ns = std::max(from_ns, *agreed_ns_);
  const auto steady = moved(chain, *agreed_ns_ - static_cast<std::int64_t>(kSteady_s * 1e9), *agreed_ns_);
  const auto before = moved(chain, std::min(from_ns, begin_ns), begin_ns), since = moved(chain, begin_ns, to_ns);
  if (!steady || !before || !since) return std::nullopt;
  const double time_s = vision::seconds(begin_ns, to_ns);
  const Eigen::Vector2d way_m = steady->way_m * (time_s / kSteady_s);
  return Unjumped{before->way_m.norm() + way_m.norm(), (since->way_m - way_m).norm(), time_s};
}

bool CrossCheck::goes_on_as_before(const Stretch& stretch, const Unjumped& unjumped) const {
  const double usual_m = kSteady * (way_sigma_m(motion_, unjumped.time_s) + kOdometryError_m);
  const double jumped_s = vision::seconds(std::max(stretch.from_ns, jump_->shown_ns), stretch.to_ns);
  return unjumped.off_m < std::min(usual_m, kSame * unjumped.length_m + kOdometryError_m) &&
         jump_->speed_m_s * jumped_s > kUnlike * usual_m;
}

/// Processes a stretch on which the directions of motion agree, which says nothing of the speed. Returns how far odometry
/// is off if panoramas contradict its speed.
std::optional<double> CrossCheck::settle_jump(OdometryBuffer& chain, const Stretch& stretch, double said_m,
                                              double side_parallax_rad) {
  if (!jump_ || turn_dispute_.is_on() || stretch.to_ns <= jump_->since_ns) return std::nullopt;
  if (is_old_jump(stretch.to_ns)) return settle_old_jump(stretch, said_m, side_parallax_rad);
  std::optional<Unjumped> unjumped;
  if (jump_->is_from_agreement) unjumped = unless_it_jumped(chain, stretch.from_ns, stretch.to_ns);
  const std::optional<double> otherwise_m = unjumped ? std::optional(unjumped->length_m) : std::nullopt;
  const auto verdict = witness_.judge(side_parallax_rad, said_m, otherwise_m);
  const bool was_agreeing = jump_->is_agreeing || !unjumped;
  jump_->is_agreeing = verdict == SpeedVerdict::kAgrees;
  if ((jump_->is_agreeing && was_agreeing) || (unjumped && goes_on_as_before(stretch, *unjumped))) {
    speed_agreed_ns_ = stretch.to_ns;
    end_jump();
    return std::nullopt;
  }
  if (!unjumped) return std::nullopt;
  if (verdict == SpeedVerdict::kContradicts) {
    if (!jump_->contradicted_ns) catch_up(chain, stretch);
    jump_->contradicted_ns = stretch.to_ns;
  }
  if (jump_->contradicted_ns) return unjumped->off_m;
  unsure_.add(stretch.reference_ns, stretch.to_ns, unjumped->off_m, {});
  chain.allow(stretch.from_ns, stretch.to_ns, unsure_.growth(kDoubt), 0.0);
  return std::nullopt;
}

/// Where the vehicle would be at the speed before the jump tells nothing any more. But odometry was wrong, and remains so
/// while it moves on by another way than objects beside the path show.
std::optional<double> CrossCheck::settle_old_jump(const Stretch& stretch, double said_m, double side_parallax_rad) {
  const auto shown = witness_.length(side_parallax_rad);
  if (!shown) return std::nullopt;
  const double nearest_m = std::clamp(said_m, std::max(0.0, shown->m - shown->error_m), shown->m + shown->error_m);
  const bool is_contradicted = witness_.judge(side_parallax_rad, said_m, nearest_m) == SpeedVerdict::kContradicts;
  const bool does_agree = !is_contradicted && std::max(said_m, shown->m) > kTells * shown->error_m;
  if (does_agree && std::exchange(jump_->is_agreeing, true)) {
    speed_agreed_ns_ = stretch.to_ns;
    end_jump();
    return std::nullopt;
  }
  if (!does_agree) {
    jump_->is_agreeing = false;
    jump_->contradicted_ns = stretch.to_ns;  // a vehicle that hardly moves proves nothing
  }
  return std::abs(shown->m - said_m);
}

/// Odometry was right if the place is nearer to where it was expected than panoramas say it is since the pose was
/// corrected last, by more than sightings err. A place that was built since the jump tells nothing.
void CrossCheck::add_place(const Place& place) {
  if (!jump_ || !jump_->contradicted_ns || !way_dispute_.is_on()) return;
  const double off_m = total_off_m(place.stamp_ns) - total_off_m(jump_->corrected_ns);
  add_correction(place.stamp_ns);
  if (place.built_ns > jump_->since_ns || std::max(place.off_m, kSurely * place.sigma_m) > kHalfWay * off_m) return;
  end_jump();
  end_way_dispute();
}

void CrossCheck::add_correction(std::int64_t stamp_ns) {
  if (jump_) jump_->corrected_ns = std::max(jump_->corrected_ns, stamp_ns);
}

void CrossCheck::dispute_way(const Stretch& stretch, double off_m) {
  if (off_.empty()) off_.push_back({stretch.from_ns, 0.0});
  way_dispute_.add(stretch.reference_ns, stretch.to_ns, off_m, {Wrong::kOdometry, 0.0});
  off_.push_back({stretch.to_ns, way_dispute_.total()});
  if (off_.size() > kMostOff) off_.pop_front();
}

void CrossCheck::end_way_dispute() {
  way_dispute_.end();
  off_.clear();
}

/// How far odometry was off at a time, in all. After the last panorama, it is not known yet how much more.
double CrossCheck::total_off_m(std::int64_t stamp_ns) const {
  const auto after = std::find_if(off_.begin(), off_.end(), [&](const Off& off) { return off.stamp_ns >= stamp_ns; });
  if (after == off_.end()) return off_.empty() ? 0.0 : off_.back().total_m;
  if (after == off_.begin()) return after->total_m;
  const auto before = std::prev(after);
  const double share = vision::seconds(before->stamp_ns, stamp_ns) / vision::seconds(before->stamp_ns, after->stamp_ns);
  return before->total_m + share * (after->total_m - before->total_m);
}

/// Odometry has been wrong since the jump, not only since the panorama that shows it.
void CrossCheck::catch_up(OdometryBuffer& chain, const Stretch& stretch) {
  const auto earlier = unless_it_jumped(chain, *agreed_ns_, stretch.from_ns);
  if (!earlier || way_dispute_.is_on()) return;
  dispute_way({*agreed_ns_, *agreed_ns_, stretch.from_ns}, earlier->off_m);
  chain.allow(*agreed_ns_, stretch.from_ns, way_dispute_.growth(1.0), 0.0);
}

void CrossCheck::end_jump() {
  jump_.reset();
  unsure_.end();
}

bool CrossCheck::is_old_jump(std::int64_t now_ns) const {
  return jump_ && vision::seconds(jump_->since_ns, now_ns) > kLongestJump_s;
}

/// Without a panorama that confirms or contradicts it, a jump is over after some time. So is any after kLongestJump_s
/// that panoramas do not contradict.
void CrossCheck::drop_old_jump(std::int64_t now_ns) {
  if (!jump_) return;
  const bool is_contradicted = jump_->contradicted_ns && is_fresh(*jump_->contradicted_ns, now_ns);
  if (!is_fresh(jump_->last_ns(), now_ns) || (is_old_jump(now_ns) && !is_contradicted)) end_jump();
}

}  // namespace panvo::localizer
