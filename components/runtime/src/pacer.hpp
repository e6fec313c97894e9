// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "panvo/runtime/source.hpp"

namespace panvo::runtime {

/// When the steps of the sources are due: stamps in proportion to the monotonic clock, from the last change on.
class Pacer final : public Playback {
 public:
  /// Read at one time. `version` differs after each change.
  struct State {
    std::uint64_t version = 0;
    bool is_paused = false;
    double rate = 1;  ///< 0: as fast as possible
    std::int64_t stamp_ns = 0, since_ns = 0;

    /// Monotonic time at which a stamp is due unless paused. Not for rate 0.
    std::int64_t due_ns(std::int64_t stamp) const;
  };

  /// `rate` 0: as fast as possible.
  explicit Pacer(double rate = 1) { state_.rate = rate; }

  /// At the begin of a run. What was requested before it, such as another rate, stays.
  void start(std::int64_t first_stamp_ns, std::int64_t now_ns);
  /// `changed` is called after each change, `moved` before it after a move.
  void on_change(std::function<void()> changed, std::function<void()> moved);
  /// seek() moves the source until it is removed.
  void add(Source& source);
  void remove(Source& source);

  /// A source steps.
  void reach(std::int64_t stamp_ns) { reached_ns_ = stamp_ns; }

  /// Whether all sources have reached their end.
  void set_at_end(bool is_at_end) { is_at_end_ = is_at_end; }

  State state() const;

  void pause() override { set_paused(true); }
  void resume() override { set_paused(false); }
  bool is_paused() const override { return state().is_paused; }
  std::optional<std::int64_t> stamp_ns() const override;
  double rate() const override { return state().rate; }
  bool is_at_end() const override { return is_at_end_; }
  bool set_rate(double rate) override;
  std::optional<StampRange> range() const override;
  bool seek(std::int64_t stamp_ns) override;

 private:
  void set_paused(bool is_paused);
  std::optional<StampRange> range_of_sources() const;
  /// What is stamped so is due now.
  void move_to(std::int64_t stamp_ns);
  /// Continues from the present stamp.
  void go_on_from_here();
  void tell(bool is_move);

  static constexpr std::int64_t kNever = INT64_MIN;

  mutable std::mutex mutex_;
  State state_;
  std::atomic<std::int64_t> reached_ns_ = kNever;
  std::atomic<bool> is_at_end_ = false;
  std::mutex seeking_mutex_;          // locked before the others
  mutable std::mutex sources_mutex_;  // released before `changed_`, whose callee may call range()
  std::vector<Source*> sources_;
  std::mutex telling_mutex_;
  std::function<void()> changed_ = [] {}, moved_ = [] {};
};

}  // namespace panvo::runtime
