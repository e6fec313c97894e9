// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace panvo::camera_stream {

/// State machine that decides when to open and close a camera. Events go in, actions come out; it accesses neither
/// device nor clock. Times are in ns of any monotonic clock.
///
///     waiting --open--> opening --opened--> streaming --watchdog, lost--> waiting (close, then open at once; after a failure, each retry_ns)
///                          '-----failed----------------------------------------^
class Reconnection {
 public:
  enum class State { kWaiting, kOpening, kStreaming };
  enum class Action { kNone, kOpen, kClose };
  enum class Loss { kNone, kNoFrames, kDeviceGone };

  struct Settings {
    /// The camera counts as lost after this time without a frame; 0: never. Each step() adds at most a quarter of it,
    /// so that a suspended or overloaded host does not make the camera appear silent.
    std::int64_t watchdog_ns = 1'000'000'000;
    std::int64_t retry_ns = 250'000'000;  ///< from a failed attempt to open to the next one
  };

  explicit Reconnection(const Settings& settings) : settings_(settings) {}

  /// The next action. Call this several times within watchdog_ns and retry_ns. Answer kOpen with opened() or failed().
  Action step(std::int64_t now_ns);

  void opened(std::int64_t now_ns);
  void failed(std::int64_t now_ns);
  void frame(std::int64_t now_ns);
  /// The device reported that it is gone, or an operation on it failed (ENODEV, EIO, control lost).
  void device_gone();
  /// Adapts the watchdog time to the camera's current settings.
  void set_watchdog_ns(std::int64_t watchdog_ns) { settings_.watchdog_ns = watchdog_ns; }

  State state() const noexcept { return state_; }
  /// Reason of the last close.
  Loss last_loss() const noexcept { return last_loss_; }
  /// Whether a frame was received since the camera was opened.
  bool has_streamed() const noexcept { return has_streamed_; }
  /// Number of losses after which frames arrived again.
  std::uint64_t reconnects() const noexcept { return reconnects_; }

 private:
  Action close(Loss loss, std::int64_t now_ns);
  void count_silence(std::int64_t now_ns);
  bool is_silent() const;
  void sign_of_life(std::int64_t now_ns);

  Settings settings_;
  State state_ = State::kWaiting;
  Loss last_loss_ = Loss::kNone;
  std::int64_t next_try_ns_ = 0;
  std::int64_t watched_ns_ = 0;  // time of the last step, opening or frame
  std::int64_t silent_ns_ = 0;   // counted time since the camera was opened or sent a frame
  bool is_gone_ = false, has_streamed_ = false, has_been_lost_ = false;
  std::uint64_t reconnects_ = 0;
};

std::string_view name_of(Reconnection::State state);

}  // namespace panvo::camera_stream
