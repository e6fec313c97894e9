// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

namespace panvo::vision {

/// Finds a large offset between the clocks of two sensors that both see the vehicle turn, such as the latency of a video
/// stream whose images are stamped on arrival: of a row of candidates, the one at which the turns of both agree.
class ClockSearch {
 public:
  struct Turn {
    double change_rad = 0.0;
    double variance_rad2 = 0.0;
  };
  /// Turn by the reference sensor between two times of its clock; nullopt if it did not measure all of it.
  using Reference = std::function<std::optional<Turn>(std::int64_t from_ns, std::int64_t to_ns)>;

  static constexpr double kStep_s = 0.02;  ///< from candidate to candidate
  /// To both sides: of most cameras, which are found sooner, and of slow streams.
  static constexpr double kUsual_s = 0.6, kFarthest_s = 2.0;
  static constexpr double kSigma_s = 0.02;  ///< standard deviation of what is found, unless it says another one

  /// A turn by the other sensor, with stamps of its clock.
  void add(std::int64_t from_ns, std::int64_t to_ns, const Turn& turn);

  struct Found {
    double ahead_s = 0.0;  ///< the other clock
    double sigma_s = kSigma_s;
  };
  /// Compares the turns that the reference sensor, up to `latest_ns`, covers at every candidate. Returns the offset once
  /// the turns exclude all other candidates; then starts again. `doubted_s`: an offset that was found, which turns
  /// contradict: if they exclude it, too, a coarse offset is better than that one.
  std::optional<Found> find(std::int64_t latest_ns, const Reference& reference,
                            const std::optional<double>& doubted_s = {});

  /// The clock may have been set: turns so far no longer count.
  void forget_turns();

  /// Whether an offset was found so far, large or not.
  bool has_found() const noexcept { return has_found_; }

 private:
  struct Seen {
    std::int64_t from_ns, to_ns;
    Turn turn;
  };

  /// Candidates up to the same offset to both sides.
  class Row {
   public:
    explicit Row(double farthest_s);
    void add(const Seen& seen);
    std::optional<Found> find(std::int64_t latest_ns, const Reference& reference,
                              const std::optional<double>& doubted_s);
    void forget();
    void forget_costs() { std::ranges::fill(cost_, 0.0); }

   private:
    void compare(const Seen& seen, const Reference& reference);
    bool excludes_all_but(std::size_t least, std::size_t near) const;
    bool excludes(double offset_s, std::size_t least) const;
    double offset_s(double candidate) const { return candidate * kStep_s - farthest_s_; }

    double farthest_s_;
    std::vector<double> cost_;  // of each candidate: squared deviations, in variances
    std::deque<Seen> pending_;
  };

  Row usual_{kUsual_s}, far_{kFarthest_s};
  bool has_found_ = false;
};

/// Whether turns that contradict the reference sensor's are those of another time, because a clock was set.
class ClockDoubt {
 public:
  /// A turn that contradicts the reference sensor's, with stamps of the other clock, so far ahead by `known_ahead_ns`.
  /// Returns whether another offset, up to ClockSearch::kUsual_s from that, explains it and all others since the last
  /// agreement, by turns of the reference sensor up to `latest_ns` or a little later. A turn that began before that
  /// agreement may have its first stamp from before the clock was set.
  bool add(std::int64_t from_ns, std::int64_t to_ns, double change_rad, double within_rad, std::int64_t known_ahead_ns,
           std::int64_t latest_ns, const ClockSearch::Reference& reference);
  /// The turns agree up to this stamp of the other clock.
  void agree(std::int64_t to_ns) {
    contradictions_.clear();
    agreed_ns_ = to_ns;
  }
  void forget() { *this = {}; }

 private:
  struct Contradiction {
    std::int64_t from_ns, to_ns;
    double change_rad, within_rad;
  };
  std::deque<Contradiction> contradictions_;
  std::int64_t agreed_ns_ = INT64_MIN;
};

}  // namespace panvo::vision
