// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/clock_search.hpp"

#include <algorithm>
#include <cmath>

#include "panvo/vision/angle.hpp"
#include "panvo/vision/seconds.hpp"

namespace panvo::vision {
namespace {

constexpr std::size_t kMaxPending = 64;
constexpr double kKept = 0.995;       // of the costs per turn: about 40 s of panoramas at 5 Hz
constexpr double kMaxCost = 9.0;      // per turn: a wrong one decides nothing
constexpr double kClear = 60.0;       // excess of a cost that excludes a candidate: seven turns or more
constexpr std::size_t kNear = 4;      // steps: candidates that need not be excluded
constexpr double kLeast_rad = 0.003;  // standard deviation that no turn falls below
constexpr double kScale = 0.02;       // relative error of a turn by an aged calibration

}  // namespace

void ClockSearch::add(std::int64_t from_ns, std::int64_t to_ns, const Turn& turn) {
  pending_.push_back({from_ns, to_ns, turn});
  if (pending_.size() > kMaxPending) pending_.pop_front();
}

std::optional<double> ClockSearch::find(std::int64_t latest_ns, const Reference& reference) {
  while (!pending_.empty() && pending_.front().to_ns + to_ns(kFarthest_s) <= latest_ns) {
    compare(pending_.front(), reference);
    pending_.pop_front();
  }
  const auto found = best();
  if (!found) return std::nullopt;
  // The vertex of the parabola through the costs around the best candidate.
  const double before = cost_[*found - 1], at = cost_[*found], after = cost_[*found + 1];
  const double bend = before - 2.0 * at + after;
  const double vertex = bend > 0.0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
  cost_ = {};
  has_found_ = true;
  return offset_s(static_cast<double>(*found) + vertex);
}

void ClockSearch::compare(const Pending& seen, const Reference& reference) {
  std::array<Turn, kCandidates> expected;
  for (std::size_t i = 0; i < kCandidates; ++i) {
    const std::int64_t by_ns = to_ns(offset_s(static_cast<double>(i)));
    const auto turn = reference(seen.from_ns - by_ns, seen.to_ns - by_ns);
    if (!turn) return;
    expected[i] = *turn;
  }
  const double unsure_rad2 =
      seen.turn.variance_rad2 + kLeast_rad * kLeast_rad + std::pow(kScale * seen.turn.change_rad, 2);
  for (std::size_t i = 0; i < kCandidates; ++i) {
    const double deviation = wrapped(seen.turn.change_rad - expected[i].change_rad);
    // The true offset lies anywhere between the candidates.
    const double slope =
        wrapped(expected[std::min(i + 1, kCandidates - 1)].change_rad - expected[i > 0 ? i - 1 : 0].change_rad) / 2.0;
    const double variance = unsure_rad2 + expected[i].variance_rad2 + slope * slope / 12.0;
    cost_[i] = kKept * cost_[i] + std::min(deviation * deviation / variance, kMaxCost);
  }
}

/// The candidate that excludes all others but its neighbours.
std::optional<std::size_t> ClockSearch::best() const {
  const auto least = static_cast<std::size_t>(std::ranges::min_element(cost_) - cost_.begin());
  if (least == 0 || least == kCandidates - 1) return std::nullopt;
  for (std::size_t i = 0; i < kCandidates; ++i) {
    const std::size_t apart = i > least ? i - least : least - i;
    if (apart > kNear && cost_[i] < cost_[least] + kClear) return std::nullopt;
  }
  return least;
}

bool ClockDoubt::add(std::int64_t from_ns, std::int64_t to_ns, double change_rad, double within_rad,
                     std::int64_t known_ahead_ns, const ClockSearch::Reference& reference) {
  const auto agrees = [&](std::int64_t reference_from_ns, std::int64_t reference_to_ns) {
    if (reference_from_ns >= reference_to_ns) return false;
    const auto turn = reference(reference_from_ns, reference_to_ns);
    return turn && std::abs(wrapped(change_rad - turn->change_rad)) < within_rad;
  };
  for (std::size_t i = 0; i < possible_.size(); ++i) {
    if (!possible_[i]) continue;
    const std::int64_t by_ns = vision::to_ns(ClockSearch::offset_s(static_cast<double>(i)));
    possible_[i] = agrees(from_ns - by_ns, to_ns - by_ns) ||
                   (from_ns <= agreed_ns_ && agrees(from_ns - known_ahead_ns, to_ns - by_ns));
  }
  return possible_.any();
}

}  // namespace panvo::vision
