// SPDX-License-Identifier: Apache-2.0
#include "usb_camera.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <optional>

namespace panvo::test {
namespace {

// Requests of USB and of the video class.
constexpr int kGetDescriptor = 6, kSetCurrent = 0x01, kGetCurrent = 0x81, kGetLeast = 0x82, kGetMost = 0x83,
              kGetResolution = 0x84, kGetLength = 0x85, kGetInfo = 0x86, kGetStandard = 0x87;
constexpr int kProbe = 1, kCommit = 2;
constexpr std::size_t kHeaderBytes = 2;

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

bool is_to_host(const UsbRequest& request) { return (request.setup[0] & 0x80) != 0; }
bool is_of_class(const UsbRequest& request) { return (request.setup[0] & 0x60) == 0x20; }

}  // namespace

UsbCamera::UsbCamera(int port, CameraModel model, Picture picture)
    : model_(std::move(model)),
      picture_(std::move(picture)),
      link_(port),
      controls_{{{kProcessingUnit, 2}, {"brightness", 0, 255, 1, 128, 2, 128}},
                {{kProcessingUnit, 4}, {"gain", 0, 100, 1, 10, 2, 10}},
                {{kCameraTerminal, 2}, {"auto_exposure", 1, 2, 3, 1, 1, 1}},
                {{kCameraTerminal, 4}, {"exposure_time_absolute", 1, 5000, 1, 100, 4, 100}}},
      interval_(interval_of(model_.rate_hz)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

int UsbCamera::value(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  for (const auto& [place, control] : controls_) {
    if (control.name == name) return control.value;
  }
  return -1;
}

void UsbCamera::run(const std::stop_token& stop) {
  while (!stop.stop_requested() && link_.is_alive()) {
    constexpr std::int64_t kMax_ms = 20;
    const bool is_due_next = is_streaming_ && !transfers_.empty();
    const std::int64_t until_due_ms =
        is_due_next ? std::max<std::int64_t>(0, (next_ns_ - now_ns()) / 1'000'000) : kMax_ms;
    if (const auto request = link_.receive(std::chrono::milliseconds(std::min(until_due_ms, kMax_ms)))) serve(*request);
    send_frames();
  }
}

void UsbCamera::serve(const UsbRequest& request) {
  if (request.is_unlink) {
    const auto found = std::find_if(transfers_.begin(), transfers_.end(),
                                    [&](const auto& transfer) { return transfer.first == request.unlinked; });
    const bool was_waiting = found != transfers_.end();
    if (was_waiting) transfers_.erase(found);
    return link_.answer_unlink(request.number, was_waiting);
  }
  if (request.endpoint != 0) {
    transfers_.emplace_back(request.number, request.length);
    return;
  }
  if (!is_of_class(request)) return serve_standard(request);
  const int selector = request.setup[3], interface = request.setup[4], entity = request.setup[5];
  if (interface == 1) return serve_streaming(request, selector);
  if (entity != 0) return serve_control(request, {entity, selector});
  reply(request, {0});  // the last error: none
}

void UsbCamera::serve_standard(const UsbRequest& request) {
  if (!is_to_host(request)) return link_.answer_taken(request.number, 0);
  if (request.setup[1] != kGetDescriptor) return reply(request, {0, 0});  // status and configuration: unchanged
  const int kind = request.setup[3], number = request.setup[2];
  const Bytes descriptor = kind == 1   ? device_descriptor()
                           : kind == 2 ? configuration_descriptor(model_)
                           : kind == 3 ? text_descriptor(model_, number)
                                       : Bytes{};
  descriptor.empty() ? link_.refuse(request.number) : reply(request, descriptor);
}

void UsbCamera::serve_streaming(const UsbRequest& request, int selector) {
  const int what = request.setup[1];
  if (selector != kProbe && selector != kCommit) return link_.refuse(request.number);
  if (what == kGetLength) return reply(request, {static_cast<std::uint8_t>(negotiated().size()), 0});
  if (what == kGetInfo) return reply(request, {3});
  if (what != kSetCurrent) return reply(request, negotiated());
  take_negotiation(request.data);
  if (selector == kCommit) {
    is_streaming_ = true;
    frame_.clear();
    next_ns_ = now_ns();
  }
  link_.answer_taken(request.number, request.length);
}

void UsbCamera::serve_control(const UsbRequest& request, std::pair<int, int> entity_and_selector) {
  const std::lock_guard lock(mutex_);
  const auto found = controls_.find(entity_and_selector);
  if (found == controls_.end()) return link_.refuse(request.number);
  Control& control = found->second;
  const auto number = [&](int value) {
    Bytes bytes;
    put(bytes, static_cast<std::uint64_t>(value), control.size);
    return bytes;
  };
  switch (request.setup[1]) {
    case kSetCurrent:
      control.value = 0;
      std::memcpy(&control.value, request.data.data(), std::min(request.data.size(), std::size_t{4}));
      return link_.answer_taken(request.number, request.length);
    case kGetCurrent:
      return reply(request, number(control.value));
    case kGetLeast:
      return reply(request, number(control.least));
    case kGetMost:
      return reply(request, number(control.most));
    case kGetResolution:
      return reply(request, number(control.resolution));
    case kGetStandard:
      return reply(request, number(control.standard));
    case kGetInfo:
      return reply(request, {3});  // may be read and set
    case kGetLength:
      return reply(request, {static_cast<std::uint8_t>(control.size), 0});
    default:
      return link_.refuse(request.number);
  }
}

void UsbCamera::reply(const UsbRequest& request, const Bytes& data) {
  link_.answer(request.number, Bytes(data.begin(), data.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(
                                                                      data.size(), request.length))));
}

Bytes UsbCamera::negotiated() const {
  Bytes bytes;
  put(bytes, 1, 2);
  put(bytes, format_, 1);
  put(bytes, 1, 1);  // the only size
  put(bytes, interval_, 4);
  put(bytes, 0, 10);
  put(bytes, static_cast<std::uint64_t>(model_.width * model_.height * 2), 4);
  put(bytes, kPayloadBytes, 4);
  put(bytes, 48'000'000, 4);
  put(bytes, 3, 4);
  return bytes;
}

void UsbCamera::take_negotiation(const Bytes& data) {
  constexpr std::size_t kFormatAt = 2, kIntervalAt = 4, kMin = 8;
  if (data.size() < kMin) return;
  format_ = std::clamp(data[kFormatAt], kMjpgFormat, kYuy2Format);
  std::memcpy(&interval_, &data[kIntervalAt], sizeof interval_);
  const int max_hz = format_ == kMjpgFormat ? model_.rate_hz : static_cast<int>(kSlowest_hz);
  interval_ = std::clamp(interval_, interval_of(max_hz), interval_of(static_cast<int>(kSlowest_hz)));
}

void UsbCamera::send_frames() {
  while (is_streaming_ && !transfers_.empty() && link_.is_alive()) {
    if (frame_.empty()) {
      if (now_ns() < next_ns_) return;
      begin_frame();
    }
    const auto [number, length] = transfers_.front();
    transfers_.pop_front();
    link_.answer(number, next_payload(std::min(length, kPayloadBytes)));
  }
}

void UsbCamera::begin_frame() {
  constexpr std::int64_t kLate_ns = 1'000'000'000;
  next_ns_ += std::int64_t{interval_} * 100;
  if (now_ns() > next_ns_ + kLate_ns) next_ns_ = now_ns();
  // MJPG: the picture with this number; YUY2: uniform grey.
  frame_ = format_ == kMjpgFormat ? picture_(number_)
                                  : Bytes(static_cast<std::size_t>(model_.width * model_.height * 2), 128);
  ++number_;
  position_ = 0;
  is_damaged_ = is_next_damaged_.exchange(false);
}

/// The next part of the frame with its header, which contains the frame toggle and marks the last part.
Bytes UsbCamera::next_payload(std::uint32_t room) {
  const std::size_t size = std::min<std::size_t>(room - kHeaderBytes, frame_.size() - position_);
  const bool is_last = position_ + size == frame_.size();
  constexpr std::uint8_t kEndOfHeader = 0x80, kError = 0x40, kLast = 0x02;
  Bytes payload;
  payload.reserve(kHeaderBytes + size);
  payload.push_back(static_cast<std::uint8_t>(kHeaderBytes));
  payload.push_back(
      static_cast<std::uint8_t>(kEndOfHeader | (is_damaged_ ? kError : 0) | (is_last ? kLast : 0) | toggle_));
  const auto begin = frame_.begin() + static_cast<std::ptrdiff_t>(position_);
  payload.insert(payload.end(), begin, begin + static_cast<std::ptrdiff_t>(size));
  position_ += size;
  if (is_last) {
    frame_.clear();
    toggle_ ^= 1U;
    ++sent_;
  }
  return payload;
}

}  // namespace panvo::test
