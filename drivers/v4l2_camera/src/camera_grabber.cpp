// SPDX-License-Identifier: Apache-2.0
#include "panvo/v4l2_camera/camera_grabber.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "panvo/camera_stream/frame_gaps.hpp"
#include "panvo/camera_stream/reconnection.hpp"
#include "panvo/v4l2_camera/frame_reader.hpp"
#include "panvo/v4l2_camera/host_stamps.hpp"
#include "panvo/v4l2_camera/negotiation.hpp"

namespace panvo::v4l2_camera {
namespace {

using camera_stream::FrameGaps;
using camera_stream::FrameNumbering;
using camera_stream::Reconnection;

template <class Clock>
std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch()).count();
}
/// The steady clock is CLOCK_MONOTONIC, the clock of the kernel's frame stamps.
std::int64_t steady_ns() { return now_ns<std::chrono::steady_clock>(); }
std::int64_t system_ns() { return now_ns<std::chrono::system_clock>(); }

constexpr const char* kRemedy =
    "images are truncated: try another USB cable or port, no hub, fewer cameras per controller, a smaller size or rate";

}  // namespace

class CameraGrabber::Implementation {
 public:
  Implementation(CameraSettings settings, const runtime::Logger& log, OnFrame on_frame, Devices devices)
      : settings_(std::move(settings)),
        log_(log),
        on_frame_(std::move(on_frame)),
        devices_(std::move(devices)),
        machine_({.watchdog_ns = settings_.watchdog_ns}),
        thread_([this](const std::stop_token& stop) { run(stop); }) {}

  camera_stream::StreamReport report() const {
    const std::lock_guard lock(mutex_);
    return report_;
  }

  void set(std::vector<camera_group::DeviceSetting> controls) {
    const std::lock_guard lock(mutex_);
    new_controls_ = std::move(controls);
  }

 private:
  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      take_new_controls();
      switch (machine_.step(steady_ns())) {
        case Reconnection::Action::kOpen:
          open();
          break;
        case Reconnection::Action::kClose:
          close();
          break;
        case Reconnection::Action::kNone:
          device_ ? receive() : wait(stop);
          break;
      }
    }
  }

  void wait(const std::stop_token& stop) {
    constexpr auto kShort = std::chrono::milliseconds(20);
    std::unique_lock lock(mutex_);
    stopped_.wait_for(lock, stop, kShort, [] { return false; });
  }

  void take_new_controls() {
    std::unique_lock lock(mutex_);
    if (!new_controls_) return;
    settings_.controls = *std::exchange(new_controls_, std::nullopt);
    lock.unlock();
    if (!device_) return;
    try {
      const auto refused = v4l2_camera::set_controls(*device_, settings_.controls);
      say_what_was_refused(refused);
      lock.lock();
      report_.counters.refused_settings = refused.size();
    } catch (const DeviceError& error) {
      lost(error);
    }
  }

  void open() {
    const auto found = known_ ? find_again(devices_.list(), *known_) : find_node(devices_.list(), settings_.camera);
    if (!found.node) return failed(found.problem);
    try {
      auto device = devices_.open(found.node->path);
      const auto negotiated = start(*device, found.node->path, settings_);
      device_ = std::move(device);
      opened(*found.node, negotiated);
    } catch (const DeviceError& error) {
      failed(error.what());
    }
  }

  /// Logs a failure only if it repeats: a new node is not yet accessible for a moment.
  void failed(const std::string& problem) {
    machine_.failed(steady_ns());
    if (std::exchange(last_failure_, problem) == problem) warn("open", problem);
    const std::lock_guard lock(mutex_);
    ++report_.counters.failed_opens;
    report_.state = "not connected: " + problem;
  }

  void opened(const VideoNode& node, const Negotiated& negotiated) {
    known_ = node;
    last_failure_.clear();
    gaps_.restart();
    reader_.emplace(settings_, negotiated.given);
    machine_.set_watchdog_ns(watchdog_ns(negotiated.rate_hz));
    machine_.opened(steady_ns());
    const std::string image =
        to_text(negotiated.given) + (negotiated.rate_hz > 0 ? fmt::format(", {:.4g} Hz", negotiated.rate_hz) : "");
    log_.info("{}: {} ({}) at {}: {}", settings_.name, node.serial.empty() ? "no serial" : node.serial, node.name,
              node.path, image);
    say_what_was_refused(negotiated.refused);
    const std::lock_guard lock(mutex_);
    report_.serial = node.serial;
    report_.is_streaming = true;
    report_.state = "streaming";
    report_.remedy = kRemedy;
    report_.counters.refused_settings = negotiated.refused.size();
    report_.details["camera"] = fmt::format("{} at {}", node.name, node.path);
    report_.details["asked"] = to_text(negotiated.asked);
    report_.details["given"] = image;
  }

  /// At least three frame periods, for slow cameras. `rate_hz`: 0 if unknown.
  std::int64_t watchdog_ns(double rate_hz) const {
    constexpr double kFrames = 3.0;
    if (settings_.watchdog_ns <= 0 || rate_hz <= 0.0) return settings_.watchdog_ns;
    return std::max(settings_.watchdog_ns, static_cast<std::int64_t>(kFrames / rate_hz * 1e9));
  }

  /// Logs refused settings, except those already logged last time.
  void say_what_was_refused(const std::vector<std::string>& refused) {
    for (const auto& text : refused) {
      if (std::find(told_refusals_.begin(), told_refusals_.end(), text) == told_refusals_.end())
        log_.warn("{}: {}", settings_.name, text);
    }
    told_refusals_ = refused;
  }

  void lost(const DeviceError& error) {
    lost_by_ = error.what();
    warn("lost", lost_by_);
    machine_.device_gone();
  }

  void close() {
    if (machine_.last_loss() == Reconnection::Loss::kNoFrames) {
      lost_by_ = fmt::format("{} sent no frame in time; reopening it", known_->path);
      warn("silent", lost_by_);
    }
    device_.reset();
    const std::lock_guard lock(mutex_);
    report_.is_streaming = false;
    report_.state = "not connected: " + lost_by_;
  }

  void receive() {
    try {
      constexpr auto kMaxWait = std::chrono::milliseconds(50);
      const auto frame = device_->receive(kMaxWait);
      if (!frame) return;
      const HostTime arrival{steady_ns(), system_ns()};
      machine_.frame(arrival.monotonic_ns);
      auto result = reader_->read(*frame);
      device_->give_back(*frame);
      take(*frame, arrival, std::move(result));
    } catch (const DeviceError& error) {
      lost(error);
    }
  }

  void take(const BufferedFrame& frame, const HostTime& arrival, ReadFrame result) {
    const bool is_whole = result.outcome == ReadFrame::Outcome::kWhole;
    const bool uses_driver = settings_.stamps == StampSource::kDriver;
    std::int64_t stamp_ns = 0;
    if (is_whole) stamp_ns = stamps_.stamp_ns(uses_driver ? frame.monotonic_ns : std::nullopt, arrival);
    {
      const std::lock_guard lock(mutex_);
      auto& counters = report_.counters;
      counters.dropped += static_cast<std::uint64_t>(gaps_.missing_before(frame.number));
      counters.reconnects = machine_.reconnects();
      counters.clock_resets = stamps_.disbelieved();
      if (is_whole) {
        ++counters.frames;
        counters.newest_stamp_ns = stamp_ns;
      } else {
        ++(result.outcome == ReadFrame::Outcome::kIncomplete ? counters.incomplete : counters.damaged);
      }
      report_.details["stamps"] = !uses_driver || !frame.monotonic_ns ? "arrival"
                                  : frame.is_stamped_at_start         ? "start of exposure"
                                                                      : "end of frame";
    }
    if (is_whole) {
      on_frame_({stamp_ns, std::move(result.images)});
    } else {
      warn(result.problem, fmt::format("a frame {}", result.problem));
    }
  }

  void warn(std::string_view kind, const std::string& what) {
    log_.warn_throttled(fmt::format("{}: {}", settings_.name, kind), "{}: {}", settings_.name, what);
  }

  CameraSettings settings_;  // only the thread changes its controls; the rest is constant
  const runtime::Logger& log_;
  const OnFrame on_frame_;
  const Devices devices_;

  // Used by the thread only.
  Reconnection machine_;
  FrameGaps gaps_{FrameNumbering::kCounter32};
  HostStamps stamps_;
  std::string lost_by_;
  std::string last_failure_;
  std::vector<std::string> told_refusals_;
  std::optional<VideoNode> known_;
  std::optional<FrameReader> reader_;
  std::unique_ptr<VideoDevice> device_;

  mutable std::mutex mutex_;  // guards report_ and new_controls_
  std::condition_variable_any stopped_;
  std::optional<std::vector<camera_group::DeviceSetting>> new_controls_;
  camera_stream::StreamReport report_{.name = settings_.name,
                                      .serial = "",
                                      .is_streaming = false,
                                      .state = "not connected",
                                      .remedy = "",
                                      .counters = {},
                                      .details = {}};
  std::jthread thread_;  // last: it uses all of the above
};

CameraGrabber::CameraGrabber(CameraSettings settings, const runtime::Logger& log, OnFrame on_frame, Devices devices)
    : implementation_(
          std::make_unique<Implementation>(std::move(settings), log, std::move(on_frame), std::move(devices))) {}
CameraGrabber::~CameraGrabber() = default;

camera_stream::StreamReport CameraGrabber::report() const { return implementation_->report(); }

void CameraGrabber::set(std::vector<camera_group::DeviceSetting> controls) {
  implementation_->set(std::move(controls));
}

}  // namespace panvo::v4l2_camera
