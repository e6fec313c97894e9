// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/localizer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "panvo/localizer/soundness.hpp"
#include "panvo/vision/angle.hpp"
#include "panvo/vision/seconds.hpp"

/// Processing of the panoramic compass.
namespace panvo::localizer {
namespace {

constexpr double kMaxInflation =
    25.0;                              // wrong turns also cause wrong translation, by up to five times the stated error
constexpr double kClockCaution = 9.0;  // odometry sometimes errs by more than stated, especially while turning
constexpr double kNotableClock_s = 0.1;  // a vehicle moves half a metre in that time
constexpr double kStraight = 0.02;       // rad/s: another time makes no difference
constexpr double kAgree = 2.0;           // standard deviations: turns at another time
constexpr std::size_t kMaxEarly = 100;   // reference panoramas
constexpr double kOtherClock = 2.0;      // standard deviations: the filter follows smaller differences

}  // namespace

AzimuthUse Localizer::add(const AzimuthMeasurement& received) {
  if (fault_of_angle(received.change_rad, received.variance_rad2)) return AzimuthUse::kNotUsed;
  search_clock(unwrapped(received));
  if (!is_clock_known()) keep_early(received);
  return use(received);
}

/// Fuses a turn by the present offset of the clock.
AzimuthUse Localizer::use(const AzimuthMeasurement& received) {
  const std::int64_t from_ns = in_odometry_time(received.from_ns);
  const std::int64_t to_ns = in_odometry_time(received.to_ns);
  if (!chain_.turn(from_ns, to_ns)) return chain_.at(to_ns) ? AzimuthUse::kTooEarly : AzimuthUse::kNotUsed;
  const AzimuthMeasurement azimuth = unwrapped(received);
  const double yaw_before_rad = yaw_of(chain_.latest().pose.odom_from_base.linear());
  take_reference(azimuth.from_ns);
  const auto turn = chain_.turn(from_ns, to_ns);
  const double disagreement = vision::wrapped(azimuth.change_rad - turn->change_rad);
  const auto twist_then = chain_.twist(from_ns);
  const auto twist_now = chain_.twist(to_ns);
  const double rate_change = twist_then && twist_now ? (*twist_now)[vision::kYaw] - (*twist_then)[vision::kYaw] : 0.0;
  const double missed_rad = parameters_.compass_turn_error_ratio * azimuth.change_rad;
  const double measured_variance = azimuth.variance_rad2 + missed_rad * missed_rad;
  const double clock_variance_s2 = clock_.variance_s2() + (is_clock_known() ? 0.0 : kUnknownClock_s * kUnknownClock_s);
  const double compass_variance = measured_variance + rate_change * rate_change * clock_variance_s2;
  const double spread = compass_variance + turn->variance_rad2;
  const double excess =
      disagreement * disagreement / (spread * parameters_.contradiction_sigmas * parameters_.contradiction_sigmas);
  const double way_variance_m2 = gained_covariance(chain_.at(from_ns)->pose, chain_.at(to_ns)->pose, 0.0)
                                     .topLeftCorner<2, 2>()
                                     .trace();  // as stated by odometry, before it is inflated
  const bool is_contradicted = excess > 1.0;
  if (!is_contradicted) agree(azimuth.to_ns, disagreement, rate_change, std::sqrt(spread));
  const CrossCheck::Stretch stretch{azimuth.from_ns, from_ns, to_ns};
  const CrossCheck::Disagreement turns{
      disagreement, is_contradicted,
      is_contradicted && check_.shows_turned_mount(chain_, stretch, azimuth, disagreement, way_variance_m2)};
  if (is_contradicted && is_using_again_) return AzimuthUse::kUnclear;  // wrong, or the odometry is
  const bool may_be_of_clock = is_contradicted && !turns.is_of_mount;
  if (from_ns < clock_found_ns_ || (may_be_of_clock && may_be_of_another_time(azimuth, kAgree * std::sqrt(spread)))) {
    azimuth_ns_ = to_ns;
    return AzimuthUse::kUnclear;
  }
  const auto wrong = check_.add_turns(chain_, stretch, turns);
  if (wrong == Wrong::kOdometry) inflate(from_ns, to_ns, disagreement);
  if (wrong != Wrong::kPanoramas) fuse(from_ns, to_ns, azimuth.change_rad, compass_variance);
  const auto unsure_since_ns = check_.add_ways(chain_, stretch, azimuth, way_variance_m2);
  if (unsure_since_ns) doubtful_ns_ = to_ns;
  mounts_.add(azimuth.to_ns, check_.mount_direction());

  const double turn_rate = azimuth.change_rad / vision::seconds(from_ns, to_ns);
  const bool is_straight = std::max(std::abs(turn_rate), std::abs(rate_change)) < kStraight;
  std::optional<YawBiasDetector::Bias> lean;
  if (is_contradicted || !(is_clock_known() || is_straight)) {
    lean_.forget();
  } else {
    lean = add_to_lean({.from_ns = from_ns,
                        .to_ns = to_ns,
                        .compass_rad = azimuth.change_rad,
                        .odometry_variance_rad2 = turn->variance_rad2,
                        .compass_variance_rad2 = compass_variance});
  }
  if (lean) {
    straighten(*lean);
  } else if (!is_contradicted) {
    turn_seen_ = TurnSeen{disagreement, turn->change_rad, chain_.at(to_ns)->way_m - chain_.at(from_ns)->way_m,
                          in_sums(compass_variance) + turn->variance_rad2};
    clock_.add(disagreement, rate_change, kClockCaution * (measured_variance + turn->variance_rad2));
  }
  azimuth_ns_ = to_ns;
  pending_yaw_correction_rad_ += vision::wrapped(yaw_of(chain_.latest().pose.odom_from_base.linear()) - yaw_before_rad);
  if (!is_using_again_) graph_.refresh(chain_, std::min(from_ns, unsure_since_ns.value_or(from_ns)));
  graph_.set_direction_sigma(check_.direction_sigma_rad());
  latest_ = localized(chain_.latest());
  if (wrong == Wrong::kPanoramas) return AzimuthUse::kDoubted;
  return is_contradicted || lean ? AzimuthUse::kContradicted : AzimuthUse::kFused;
}

/// Panoramas show a turn except for whole ones, which odometry tells: a vehicle that turns in place may turn by more than
/// 180 degrees against one reference.
AzimuthMeasurement Localizer::unwrapped(AzimuthMeasurement azimuth) const {
  const auto turn = chain_.turn(in_odometry_time(azimuth.from_ns), in_odometry_time(azimuth.to_ns));
  if (turn) azimuth.change_rad = turn->change_rad + vision::wrapped(azimuth.change_rad - turn->change_rad);
  return azimuth;
}

/// A turn agrees with the odometry's. It proves the clock if it would not with another time.
void Localizer::agree(std::int64_t panorama_stamp_ns, double disagreement_rad, double rate_change_rad_s,
                      double sigma_rad) {
  clock_doubt_.agree(panorama_stamp_ns);
  const bool would_contradict =
      std::abs(rate_change_rad_s) * kNotableClock_s > parameters_.contradiction_sigmas * sigma_rad;
  if (!is_clock_known() || !would_contradict || std::abs(disagreement_rad) > kAgree * sigma_rad) return;
  clock_proven_ns_ = panorama_stamp_ns;
  is_clock_doubtful_ = false;
}

/// Adds a turn that contradicts the odometry. Returns whether it may be one at another time: before the clock is known,
/// or if a clock that was set since explains it.
bool Localizer::may_be_of_another_time(const AzimuthMeasurement& azimuth, double within_rad) {
  if (parameters_.clock_sigma_s == 0.0) return false;
  if (!is_clock_known()) return true;
  const bool is_explained = clock_doubt_.add(azimuth.from_ns, azimuth.to_ns, azimuth.change_rad, within_rad,
                                             clock_.estimate_ns(), chain_.latest().pose.stamp_ns, turns_of_odometry());
  if (is_explained && !is_clock_doubtful_) clock_search_.forget_turns();
  is_clock_doubtful_ |= is_explained;  // until a turn proves the clock, or its new offset is found
  return is_explained;
}

vision::ClockSearch::Reference Localizer::turns_of_odometry() const {
  return [this](std::int64_t from_ns, std::int64_t to_ns) -> std::optional<vision::ClockSearch::Turn> {
    const auto turn = chain_.turn(from_ns, to_ns);
    const auto raw_rad = chain_.raw_turn(from_ns, to_ns);
    if (!turn || !raw_rad) return std::nullopt;
    return vision::ClockSearch::Turn{*raw_rad, turn->variance_rad2};
  };
}

/// Finds an offset of the panoramic camera's clock that is too large for the filter.
void Localizer::search_clock(const AzimuthMeasurement& azimuth) {
  if (parameters_.clock_sigma_s == 0.0) return;
  clock_search_.add(azimuth.from_ns, azimuth.to_ns, {azimuth.change_rad, azimuth.variance_rad2});
  const bool was_known = is_clock_known();
  const auto doubted_s = is_clock_doubtful_ ? std::optional(clock_.estimate_s()) : std::nullopt;
  const auto found = clock_search_.find(chain_.latest().pose.stamp_ns, turns_of_odometry(), doubted_s);
  if (!found) return;
  if (!was_known) judge_stamps(found->ahead_s);
  if (was_known && std::abs(found->ahead_s - clock_.estimate_s()) < kOtherClock * vision::ClockSearch::kSigma_s) {
    is_clock_doubtful_ = false;
  } else {
    set_clock(*found, azimuth.to_ns);
  }
}

/// A turn replaces the shorter ones against the same reference panorama. To be called before its use.
void Localizer::keep_early(const AzimuthMeasurement& azimuth) {
  if (!early_) early_.emplace(Early{{}, turn_error_, check_.direction_offset()});
  auto& turns = early_->turns;
  if (!turns.empty() && turns.back().from_ns == azimuth.from_ns) turns.pop_back();
  turns.push_back(azimuth);
  if (turns.size() > kMaxEarly) turns.pop_front();
}

/// Turns from before the clock was known were fused with odometry of other times, by offsets up to `fused_ahead_ns`:
/// undoes that, and fuses them again.
void Localizer::use_early_again(std::int64_t fused_ahead_ns) {
  const Early early = *std::exchange(early_, std::nullopt);
  const ClockOffset found = clock_;
  const double yaw_before_rad = yaw_of(chain_.latest().pose.odom_from_base.linear());
  const std::int64_t from_ns = early.turns.front().from_ns;
  const std::int64_t first_ns = std::min({from_ns, from_ns - fused_ahead_ns, in_odometry_time(from_ns)});
  // What was learned meanwhile was also applied to the path before.
  chain_.correct_turns({early.turn_error.scale() - turn_error_.scale(),
                        early.turn_error.lean_rad_m() - turn_error_.lean_rad_m(), turn_error_.errors().lean_memory_m});
  chain_.undo_turns(first_ns - vision::to_ns(parameters_.clock_sigma_s), early.turn_error);
  turn_error_ = early.turn_error;
  check_.forget();
  check_.set_direction_offset(early.direction_offset);
  lean_.forget();
  mounts_.forget_stamps();
  turn_seen_.reset();
  pending_yaw_correction_rad_ += vision::wrapped(yaw_of(chain_.latest().pose.odom_from_base.linear()) - yaw_before_rad);
  is_using_again_ = true;
  for (const auto& azimuth : early.turns) use(azimuth);
  is_using_again_ = false;
  clock_ = found;  // the same turns do not tell more of it
  graph_.refresh(chain_, INT64_MIN);
}

/// What panoramas have shown so far, since the clock was proven last, belongs to other times.
void Localizer::set_clock(const vision::ClockSearch::Found& found, std::int64_t panorama_stamp_ns) {
  const std::int64_t fused_ahead_ns = clock_.estimate_ns();
  clock_ = ClockOffset(found.sigma_s, found.ahead_s);
  check_.forget();
  chain_.revert();
  clock_doubt_.forget();
  is_clock_doubtful_ = false;
  last_from_ns_.reset();
  const std::int64_t proven_ns = clock_proven_ns_;
  if (early_) {
    use_early_again(fused_ahead_ns);
  } else {
    clock_found_ns_ = chain_.latest().pose.stamp_ns;
  }
  graph_.set_clock(chain_, clock_.estimate_ns(), proven_ns);
  clock_proven_ns_ = panorama_stamp_ns;
  graph_.solve();
  latest_ = localized(chain_.latest());
}

/// Turns against one reference panorama share its error: the latest, longest one replaces those before. What it tells of
/// the odometry's errors also corrects the path so far.
void Localizer::take_reference(std::int64_t panorama_stamp_ns) {
  if (last_from_ns_ == panorama_stamp_ns) return chain_.revert();
  if (turn_seen_) {
    chain_.correct_turns(turn_error_.add(turn_seen_->disagreement_rad, turn_seen_->turn_rad, turn_seen_->way_m,
                                         turn_seen_->variance_rad2));
    if (!is_using_again_) {
      graph_.refresh(chain_, INT64_MIN);
      if (graph_.size() > 1) graph_.solve();
    }
  }
  chain_.mark(in_odometry_time(panorama_stamp_ns));
  turn_seen_.reset();
  check_.begin_reference();
  last_from_ns_ = panorama_stamp_ns;
}

/// Adds a turn, with the odometry as received, to the sum of small differences.
std::optional<YawBiasDetector::Bias> Localizer::add_to_lean(YawBiasDetector::Stretch turn) {
  const auto raw_rad = chain_.raw_turn(turn.from_ns, turn.to_ns);
  if (!raw_rad) return std::nullopt;
  const double way_m = chain_.at(turn.to_ns)->way_m - chain_.at(turn.from_ns)->way_m;
  const double said_rad = *raw_rad - turn_error_.error_rad(*raw_rad, way_m);
  turn.disagreement_rad = vision::wrapped(turn.compass_rad - said_rad);
  return lean_.add(turn);
}

/// Replaces biased turns of odometry by the compass.
void Localizer::straighten(const YawBiasDetector::Bias& lean) {
  const auto& [from_ns, to_ns, disagreement_rad, compass_rad, odometry_variance, compass_variance] = lean.uncorrected;
  const auto leaning = chain_.turn(from_ns, to_ns);
  const double wrong_rad = std::sqrt(lean.excess * odometry_variance);
  if (leaning && leaning->variance_rad2 < wrong_rad * wrong_rad) inflate(from_ns, to_ns, wrong_rad);
  fuse(from_ns, to_ns, compass_rad, compass_variance);
  if (!is_using_again_) graph_.refresh(chain_, from_ns);
}

/// Raises the variance of the odometry's turn to the square of what it disagrees by.
void Localizer::inflate(std::int64_t from_ns, std::int64_t to_ns, double disagreement_rad) {
  const auto turn = chain_.turn(from_ns, to_ns);
  if (!turn) return;
  const double ratio = disagreement_rad * disagreement_rad / std::max(turn->variance_rad2, 1e-12);
  chain_.inflate_covariance(from_ns, to_ns, ratio, kMaxInflation);
}

/// Fuses a turn with the odometry's, by variance. The chain sums variances as if turns had independent errors.
void Localizer::fuse(std::int64_t from_ns, std::int64_t to_ns, double change_rad, double variance_rad2) {
  const auto turn = chain_.turn(from_ns, to_ns);
  if (!turn) return;
  const double gain = turn->variance_rad2 / (turn->variance_rad2 + in_sums(variance_rad2));
  const double by_rad = gain * vision::wrapped(change_rad - turn->change_rad);
  chain_.apply_yaw_correction(from_ns, to_ns, by_rad, 1.0 - gain);
  turn_error_.measure_turn();
}

}  // namespace panvo::localizer
