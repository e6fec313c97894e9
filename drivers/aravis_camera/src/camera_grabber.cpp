// SPDX-License-Identifier: Apache-2.0
#include "panvo/aravis_camera/camera_grabber.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "closer.hpp"
#include "frame_stamper.hpp"
#include "gvcp_probe.hpp"
#include "opened_camera.hpp"
#include "panvo/camera_stream/frame_gaps.hpp"
#include "panvo/camera_stream/reconnection.hpp"
#include "pixel_formats.hpp"
#include "software_trigger.hpp"

namespace panvo::aravis_camera {
namespace {

using camera_stream::FrameGaps;
using camera_stream::FrameNumbering;
using camera_stream::Reconnection;

std::int64_t steady_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}
std::int64_t system_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

constexpr const char* kRemedy =
    "packets are lost: set the MTU of the camera's network to 9000, raise packet_delay_ns (several cameras on one "
    "link), raise net.core.rmem_max, or lower frame_rate_hz";

}  // namespace

class CameraGrabber::Implementation {
 public:
  Implementation(GrabberSettings settings, const runtime::Logger& log, OnFrame on_frame)
      : settings_(std::move(settings)),
        log_(log),
        on_frame_(std::move(on_frame)),
        machine_({.watchdog_ns = settings_.watchdog_ns}),
        stamper_(settings_.stamps),
        trigger_(settings_.camera.software_trigger_hz),
        packet_socket_fails_(
            settings_.camera.packet_socket == PacketSocket::kOff ||
            (settings_.camera.packet_socket == PacketSocket::kAuto && settings_.camera.trigger == Trigger::kLine)),
        thread_([this](const std::stop_token& stop) { run(stop); }) {}

  camera_stream::StreamReport report() const {
    const std::lock_guard lock(mutex_);
    return report_;
  }

  void set(std::vector<camera_group::DeviceSetting> features) {
    const std::lock_guard lock(mutex_);
    new_features_ = std::move(features);
  }

 private:
  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      take_new_features();
      switch (machine_.step(steady_ns())) {
        case Reconnection::Action::kOpen:
          open();
          break;
        case Reconnection::Action::kClose:
          close();
          break;
        case Reconnection::Action::kNone:
          camera_ ? receive() : wait(stop);
          break;
      }
    }
    if (camera_) closer_.close(std::move(camera_));
  }

  void take_new_features() {
    std::unique_lock lock(mutex_);
    if (!new_features_) return;
    settings_.camera.features = std::move(*new_features_);
    new_features_.reset();
    if (!camera_) return;
    lock.unlock();
    const auto refused = camera_->set(settings_.camera.features);
    say_what_was_refused(refused);
    lock.lock();
    report_.counters.refused_settings = refused.size();
  }

  void wait(const std::stop_token& stop) {
    constexpr auto kShort = std::chrono::milliseconds(20);
    std::unique_lock lock(mutex_);
    stopped_.wait_for(lock, stop, kShort, [] { return false; });
  }

  void open() {
    try {
      camera_ = std::make_unique<OpenedCamera>(settings_.camera, !packet_socket_fails_, identity_, where_to_search());
      opened();
    } catch (const OpenError& error) {
      machine_.failed(steady_ns());
      warn("open", error.what());
      const std::lock_guard lock(mutex_);
      ++report_.counters.failed_opens;
      report_.state = std::string(name_of(machine_.state())) + ": " + error.what();
    }
  }

  /// A lost device is probed at its last address, which is fast, and searched for everywhere from time to time, because
  /// its address may have changed.
  OpenedCamera::Search where_to_search() {
    constexpr std::int64_t kEverywhereEach_ns = 5'000'000'000;
    if (!identity_ || identity_->address.empty()) return OpenedCamera::Search::kEverywhere;
    if (answers(identity_->address, std::chrono::milliseconds(200))) return OpenedCamera::Search::kAtItsPlace;
    if (steady_ns() - searched_ns_ < kEverywhereEach_ns)
      throw OpenError(identity_->serial + " does not answer at " + identity_->address);
    searched_ns_ = steady_ns();
    return OpenedCamera::Search::kEverywhere;
  }

  void opened() {
    identity_ = camera_->identity();
    gaps_ = FrameGaps(camera_->is_gige() ? FrameNumbering::kGigEVision : FrameNumbering::kCounter64);
    stamper_.restart();
    const auto& negotiated = camera_->negotiated();
    machine_.set_watchdog_ns(watchdog_ns(negotiated));
    machine_.opened(steady_ns());
    resent_of_stream_ = 0;
    is_first_ = true;
    say_what_was_opened(negotiated);
    const std::lock_guard lock(mutex_);
    report_.serial = identity_->serial;
    report_.is_streaming = true;
    report_.state = "streaming";
    report_.counters.refused_settings = negotiated.refused.size();
    report_.details["camera"] = fmt::format("{} {} at {}", identity_->vendor, identity_->model, identity_->address);
    report_.details["image"] =
        fmt::format("{} x {} px {}", negotiated.width, negotiated.height, negotiated.pixel_format);
    if (camera_->is_gige()) {
      report_.details["packets"] =
          fmt::format("{} bytes, {} socket", negotiated.packet_size, negotiated.uses_packet_socket ? "packet" : "UDP");
    }
  }

  void say_what_was_opened(const Negotiated& negotiated) {
    log_.info("{}: {} ({} {}{}{}): {} x {} px {}{}{}", settings_.name, identity_->serial, identity_->vendor,
              identity_->model, identity_->address.empty() ? "" : " at ", identity_->address, negotiated.width,
              negotiated.height, negotiated.pixel_format,
              negotiated.frame_rate_hz > 0 ? fmt::format(", {:.4g} Hz", negotiated.frame_rate_hz) : "",
              negotiated.packet_size > 0 ? fmt::format(", packets of {} bytes", negotiated.packet_size) : "");
    say_what_was_refused(negotiated.refused);
  }

  /// Logs refused settings, except those already logged last time.
  void say_what_was_refused(const std::vector<std::string>& refused) {
    for (const auto& text : refused) {
      if (std::find(told_refusals_.begin(), told_refusals_.end(), text) != told_refusals_.end()) continue;
      log_.warn("{}: {} refused {}", settings_.name, identity_->serial, text);
    }
    told_refusals_ = refused;
  }

  /// The longer of the configured watchdog time and three frame periods; 0: no watchdog.
  std::int64_t watchdog_ns(const Negotiated& negotiated) const {
    if (settings_.watchdog_ns == 0 || settings_.camera.trigger == Trigger::kLine) return 0;
    const bool is_software = settings_.camera.trigger == Trigger::kSoftware;
    const double rate_hz = is_software ? settings_.camera.software_trigger_hz : negotiated.frame_rate_hz;
    constexpr double kFrames = 3.0;
    return rate_hz > 0 ? std::max(settings_.watchdog_ns, static_cast<std::int64_t>(kFrames / rate_hz * 1e9))
                       : settings_.watchdog_ns;
  }

  void close() {
    const bool is_gone = machine_.last_loss() == Reconnection::Loss::kDeviceGone;
    const std::string why = is_gone ? "is gone" : "sent no frame in time";
    warn(why, fmt::format("{} {}; searching for it", identity_->serial, why));
    if (!is_gone && !machine_.has_streamed() && camera_->negotiated().uses_packet_socket &&
        settings_.camera.packet_socket == PacketSocket::kAuto) {
      packet_socket_fails_ = true;
      log_.info("{}: no data on the packet socket; using a UDP socket from now on", settings_.name);
    }
    closer_.close(std::move(camera_));
    searched_ns_ = steady_ns();
    const std::lock_guard lock(mutex_);
    report_.is_streaming = false;
    report_.state = "not connected: " + identity_->serial + " " + why;
  }

  void receive() {
    constexpr std::chrono::microseconds kMaxWait(50'000);
    auto limit = kMaxWait;
    if (settings_.camera.trigger == Trigger::kSoftware) {
      if (trigger_.is_due(system_ns())) camera_->trigger();
      limit = std::min(limit, std::chrono::microseconds(trigger_.until_due_ns(system_ns()) / 1000 + 1));
    }
    const auto frame = camera_->receive(limit);
    if (camera_->is_gone()) machine_.device_gone();
    if (!frame) return;
    machine_.frame(steady_ns());
    take(*frame);
  }

  void take(const ReceivedFrame& frame) {
    const std::int64_t missing = gaps_.missing_before(frame.number());
    std::optional<Frame> whole;
    std::string problem;
    // The size of an incomplete frame is not meaningful, so its status is checked first.
    if (frame.status() == FrameStatus::kWhole) {
      const std::int64_t stamp_ns = stamper_.stamp_ns(frame, system_ns());
      auto image = image_of(frame);
      if (image) {
        whole = Frame{stamp_ns, {*image}};
      } else {
        problem = image.reason();
      }
    }
    count(frame, missing, whole);
    const bool is_first = std::exchange(is_first_, false);
    // A stream may start in the middle of a frame: that frame is counted, but is not a network fault.
    if (frame.status() == FrameStatus::kIncomplete && !is_first) {
      problem = fmt::format("delivers incomplete frames ({}); {}", frame.status_text(), kRemedy);
    } else if (frame.status() == FrameStatus::kDamaged) {
      problem = "delivers a damaged frame: " + frame.status_text();
    }
    if (problem.empty()) problem = stamper_.problem();
    if (!problem.empty()) warn(frame.status_text(), identity_->serial + " " + problem);
    if (whole) on_frame_(std::move(*whole));
  }

  conversions::Result<std::shared_ptr<sensor_msgs::msg::Image>> image_of(const ReceivedFrame& frame) const {
    ArvBuffer* buffer = frame.buffer();
    const auto payload = arv_buffer_get_payload_type(buffer);
    if (payload != ARV_BUFFER_PAYLOAD_TYPE_IMAGE && payload != ARV_BUFFER_PAYLOAD_TYPE_EXTENDED_CHUNK_DATA &&
        payload != ARV_BUFFER_PAYLOAD_TYPE_MULTIPART)
      return conversions::Reason{"sends data that is not an image: set pixel_format to an uncompressed one"};
    const auto arv_format = arv_buffer_get_image_pixel_format(buffer);
    const auto format = pixel_format_of(arv_format);
    if (!format) {
      return conversions::Reason{
          fmt::format("sends the unsupported pixel format {} (0x{:08x}): set pixel_format to one of {}",
                      camera_->negotiated().pixel_format, arv_format, readable_formats())};
    }
    std::size_t size = 0;
    const auto* data = static_cast<const std::uint8_t*>(arv_buffer_get_image_data(buffer, &size));
    camera_stream::RawImage raw{
        *format, arv_buffer_get_image_width(buffer), arv_buffer_get_image_height(buffer), 0, {data, size}};
    gint gap = 0, below = 0;
    arv_buffer_get_image_padding(buffer, &gap, &below);
    if (gap > 0) {
      const auto bits = ARV_PIXEL_FORMAT_BIT_PER_PIXEL(arv_format);
      raw.step = static_cast<std::size_t>(raw.width) * bits / 8 + static_cast<std::size_t>(gap);
    }
    return camera_stream::to_image(raw, settings_.output, settings_.frame_id);
  }

  void count(const ReceivedFrame& frame, std::int64_t missing, const std::optional<Frame>& whole) {
    const std::uint64_t resent = camera_->resent_packets();
    auto chunk_data = camera_->chunk_data(frame);
    const std::lock_guard lock(mutex_);
    auto& counters = report_.counters;
    counters.dropped += static_cast<std::uint64_t>(missing);  // -1 for a late frame
    counters.resent += resent - std::min(resent, resent_of_stream_);
    resent_of_stream_ = resent;
    counters.reconnects = machine_.reconnects();
    counters.clock_resets = stamper_.clock_resets();
    if (whole) {
      ++counters.frames;
      counters.newest_stamp_ns = whole->stamp_ns;
    } else {
      ++(frame.status() == FrameStatus::kIncomplete ? counters.incomplete : counters.damaged);
    }
    report_.remedy = kRemedy;
    if (auto clock = stamper_.description(); !clock.empty()) report_.details["clock"] = std::move(clock);
    for (auto& [name, value] : chunk_data) report_.details["chunk " + name] = std::move(value);
  }

  void warn(std::string_view kind, const std::string& what) {
    log_.warn_throttled(fmt::format("{}: {}", settings_.name, kind), "{}: {}", settings_.name, what);
  }

  GrabberSettings settings_;  // only the thread changes its features; the rest is constant
  const runtime::Logger& log_;
  const OnFrame on_frame_;

  // Used by the thread only.
  Reconnection machine_;
  FrameGaps gaps_{FrameNumbering::kGigEVision};
  FrameStamper stamper_;
  SoftwareTrigger trigger_;
  bool packet_socket_fails_;
  std::int64_t searched_ns_ = 0;  // time of the last search everywhere
  std::uint64_t resent_of_stream_ = 0;
  bool is_first_ = true;  // no frame of this stream yet
  std::optional<Identity> identity_;
  std::vector<std::string> told_refusals_;
  std::unique_ptr<OpenedCamera> camera_;
  Closer<OpenedCamera> closer_;

  mutable std::mutex mutex_;  // guards report_ and new_features_
  std::optional<std::vector<camera_group::DeviceSetting>> new_features_;
  std::condition_variable_any stopped_;
  camera_stream::StreamReport report_{.name = settings_.name,
                                      .serial = "",
                                      .is_streaming = false,
                                      .state = "not connected",
                                      .remedy = "",
                                      .counters = {},
                                      .details = {}};
  std::jthread thread_;  // last: it uses all of the above
};

CameraGrabber::CameraGrabber(GrabberSettings settings, const runtime::Logger& log, OnFrame on_frame)
    : implementation_(std::make_unique<Implementation>(std::move(settings), log, std::move(on_frame))) {}
CameraGrabber::~CameraGrabber() = default;

camera_stream::StreamReport CameraGrabber::report() const { return implementation_->report(); }

void CameraGrabber::set(std::vector<camera_group::DeviceSetting> features) {
  implementation_->set(std::move(features));
}

}  // namespace panvo::aravis_camera
