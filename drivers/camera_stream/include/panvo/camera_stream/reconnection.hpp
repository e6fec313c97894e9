// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace panvo::camera_stream {

/// When a camera is to be opened and closed, from what happens to it: a machine of events in and actions out, that knows no device and no clock.
/// Times are of any clock that does not go back, ns.
///
///     waiting --open--> opening --opened--> streaming --watchdog, lost--> waiting (close, then open at once; after a failure, each retry_ns)
///                          '-----failed----------------------------------------^
class Reconnection {
 public:
  enum class State { kWaiting, kOpening, kStreaming };
  enum class Action { kNone, kOpen, kClose };
  enum class Loss { kNone, kNoFrames, kDeviceGone };

  struct Settings {
    /// Watched for so long without a frame, the camera counts as lost; 0: never. From one step to the next, a quarter of it counts at most: who was
    /// kept from asking for longer, a machine that slept, did not watch, and does not know that the camera is silent.
    std::int64_t watchdog_ns = 1'000'000'000;
    std::int64_t retry_ns = 250'000'000;  ///< from a failure to open to the next try
  };

  explicit Reconnection(const Settings& settings) : settings_(settings) {}

  /// What is to be done now. To be asked often: at least several times in watchdog_ns and retry_ns. kOpen must be answered by opened() or failed().
  Action step(std::int64_t now_ns);

  void opened(std::int64_t now_ns);
  void failed(std::int64_t now_ns);
  void frame(std::int64_t now_ns);
  /// The device says itself that it is gone, or an operation on it did (ENODEV, EIO, control lost).
  void device_gone();
  /// The time without frames that is in order for the camera as it is set now.
  void set_watchdog_ns(std::int64_t watchdog_ns) { settings_.watchdog_ns = watchdog_ns; }

  State state() const noexcept { return state_; }
  /// Why the camera was closed last.
  Loss last_loss() const noexcept { return last_loss_; }
  /// Whether a frame has come since the camera was opened.
  bool has_streamed() const noexcept { return has_streamed_; }
  /// How often frames came again after a loss.
  std::uint64_t reconnects() const noexcept { return reconnects_; }

 private:
  Action close(Loss loss, std::int64_t now_ns);
  bool is_silent(std::int64_t now_ns);
  void sign_of_life(std::int64_t now_ns);

  Settings settings_;
  State state_ = State::kWaiting;
  Loss last_loss_ = Loss::kNone;
  std::int64_t next_try_ns_ = 0;
  std::int64_t watched_ns_ = 0;  // until then,
  std::int64_t silent_ns_ = 0;   // and so long without a sign of life: opened, or a frame
  bool is_gone_ = false, has_streamed_ = false, has_been_lost_ = false;
  std::uint64_t reconnects_ = 0;
};

std::string_view name_of(Reconnection::State state);

}  // namespace panvo::camera_stream
