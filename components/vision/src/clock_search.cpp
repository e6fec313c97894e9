// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/clock_search.hpp"

#include <algorithm>
#include <cmath>

#include "panvo/vision/angle.hpp"
#include "panvo/vision/seconds.hpp"

namespace panvo::vision {
namespace {

constexpr std::size_t kMaxPending = 256;
constexpr double kKept = 0.995;                 // of the costs per turn: about 40 s of panoramas at 5 Hz
constexpr double kMaxCost = 9.0;                // per turn: a wrong one decides nothing
constexpr double kClear = 60.0;                 // excess of a cost that excludes a candidate: seven turns or more
constexpr std::size_t kNear = 4;                // steps: candidates that need not be excluded
constexpr std::size_t kCoarse = 8;              // the same, if the offset so far is excluded
constexpr double kLeast_rad = 0.003;            // standard deviation that no turn falls below
constexpr double kScale = 0.02;                 // relative error of a turn by an aged calibration
constexpr std::size_t kMaxContradictions = 10;  // two seconds of panoramas
constexpr std::int64_t kSoon_ns = 100'000'000;  // of turn that the reference sensor may lack: extrapolated

}  // namespace

void ClockSearch::add(std::int64_t from_ns, std::int64_t to_ns, const Turn& turn) {
  for (Row* row : {&usual_, &far_}) row->add({from_ns, to_ns, turn});
}

auto ClockSearch::find(std::int64_t latest_ns, const Reference& reference, const std::optional<double>& doubted_s)
    -> std::optional<Found> {
  auto found = usual_.find(latest_ns, reference, doubted_s);
  if (!found) found = far_.find(latest_ns, reference, doubted_s);
  if (!found) return std::nullopt;
  usual_.forget_costs();
  far_.forget_costs();
  has_found_ = true;
  return found;
}

void ClockSearch::forget_turns() {
  for (Row* row : {&usual_, &far_}) row->forget();
}

ClockSearch::Row::Row(double farthest_s)
    : farthest_s_(farthest_s), cost_(static_cast<std::size_t>(2 * std::lround(farthest_s / kStep_s) + 1)) {}

void ClockSearch::Row::add(const Seen& seen) {
  pending_.push_back(seen);
  if (pending_.size() > kMaxPending) pending_.pop_front();
}

auto ClockSearch::Row::find(std::int64_t latest_ns, const Reference& reference, const std::optional<double>& doubted_s)
    -> std::optional<Found> {
  while (!pending_.empty() && pending_.front().to_ns + to_ns(farthest_s_) <= latest_ns) {
    compare(pending_.front(), reference);
    pending_.pop_front();
  }
  const auto least = static_cast<std::size_t>(std::ranges::min_element(cost_) - cost_.begin());
  if (least == 0 || least == cost_.size() - 1) return std::nullopt;
  const bool is_sure = excludes_all_but(least, kNear);
  if (!is_sure && !(doubted_s && excludes(*doubted_s, least) && excludes_all_but(least, kCoarse))) return std::nullopt;
  // The vertex of the parabola through the costs around the best candidate.
  const double before = cost_[least - 1], at = cost_[least], after = cost_[least + 1];
  const double bend = before - 2.0 * at + after;
  const double vertex = bend > 0.0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
  return Found{offset_s(static_cast<double>(least) + vertex), is_sure ? kSigma_s : 0.5 * kCoarse * kStep_s};
}

void ClockSearch::Row::forget() {
  pending_.clear();
  forget_costs();
}

void ClockSearch::Row::compare(const Seen& seen, const Reference& reference) {
  std::vector<Turn> expected(cost_.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const std::int64_t by_ns = to_ns(offset_s(static_cast<double>(i)));
    const auto turn = reference(seen.from_ns - by_ns, seen.to_ns - by_ns);
    if (!turn) return;
    expected[i] = *turn;
  }
  const double unsure_rad2 =
      seen.turn.variance_rad2 + kLeast_rad * kLeast_rad + std::pow(kScale * seen.turn.change_rad, 2);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double deviation = wrapped(seen.turn.change_rad - expected[i].change_rad);
    // The true offset lies anywhere between the candidates.
    const double slope =
        wrapped(expected[std::min(i + 1, expected.size() - 1)].change_rad - expected[i > 0 ? i - 1 : 0].change_rad) /
        2.0;
    const double variance = unsure_rad2 + expected[i].variance_rad2 + slope * slope / 12.0;
    cost_[i] = kKept * cost_[i] + std::min(deviation * deviation / variance, kMaxCost);
  }
}

bool ClockSearch::Row::excludes_all_but(std::size_t least, std::size_t near) const {
  for (std::size_t i = 0; i < cost_.size(); ++i) {
    const std::size_t apart = i > least ? i - least : least - i;
    if (apart > near && cost_[i] < cost_[least] + kClear) return false;
  }
  return true;
}

/// Whether both candidates beside an offset are excluded.
bool ClockSearch::Row::excludes(double offset_s, std::size_t least) const {
  const double at = (offset_s + farthest_s_) / kStep_s;
  if (at < 0.0 || at > static_cast<double>(cost_.size() - 1)) return true;
  const double of_nearer =
      std::min(cost_[static_cast<std::size_t>(at)], cost_[static_cast<std::size_t>(std::ceil(at))]);
  return of_nearer > cost_[least] + kClear;
}

bool ClockDoubt::add(std::int64_t from_ns, std::int64_t to_ns, double change_rad, double within_rad,
                     std::int64_t known_ahead_ns, std::int64_t latest_ns, const ClockSearch::Reference& reference) {
  contradictions_.push_back({from_ns, to_ns, change_rad, within_rad});
  if (contradictions_.size() > kMaxContradictions) contradictions_.pop_front();
  const auto recent = reference(latest_ns - kSoon_ns, latest_ns);
  const auto is_explained = [&](const Contradiction& turn, std::int64_t first_ns, std::int64_t last_ns) {
    const std::int64_t missing_ns = std::max<std::int64_t>(0, last_ns - latest_ns);
    if (first_ns >= last_ns - missing_ns || missing_ns > kSoon_ns || (missing_ns > 0 && !recent)) return false;
    const auto measured = reference(first_ns, last_ns - missing_ns);
    if (!measured) return false;
    const double missing_rad =
        missing_ns > 0 ? recent->change_rad * static_cast<double>(missing_ns) / static_cast<double>(kSoon_ns) : 0.0;
    return std::abs(wrapped(turn.change_rad - measured->change_rad - missing_rad)) < turn.within_rad;
  };
  constexpr int kSide = static_cast<int>(ClockSearch::kUsual_s / ClockSearch::kStep_s + 0.5);
  for (int i = -kSide; i <= kSide; ++i) {
    const std::int64_t by_ns = known_ahead_ns + vision::to_ns(i * ClockSearch::kStep_s);
    const bool explains_all = std::ranges::all_of(contradictions_, [&](const Contradiction& turn) {
      return is_explained(turn, turn.from_ns - by_ns, turn.to_ns - by_ns) ||
             (turn.from_ns <= agreed_ns_ && is_explained(turn, turn.from_ns - known_ahead_ns, turn.to_ns - by_ns));
    });
    if (explains_all) return true;
  }
  return false;
}

}  // namespace panvo::vision
