// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "usbip_link.hpp"

namespace panvo::test {

/// A USB Video Class camera in user space, which the kernel's USB and uvcvideo drivers see as plugged in. The
/// destructor unplugs it.
class UsbCamera {
 public:
  /// Returns the JPEG file of a frame, numbered since plugging in; called on the camera's thread.
  using Picture = std::function<Bytes(std::uint32_t number)>;

  UsbCamera(int port, CameraModel model, Picture picture);

  /// Value of a control ("brightness" or "gain") as set by the host.
  int value(const std::string& name) const;
  /// Sends the next frame with its error bit set.
  void damage_next() { is_next_damaged_ = true; }
  /// Number of completely sent frames.
  std::uint32_t sent() const { return sent_; }

 private:
  struct Control {
    std::string name;
    int least, most, resolution, standard, size, value;
  };

  void run(const std::stop_token& stop);
  void serve(const UsbRequest& request);
  void serve_standard(const UsbRequest& request);
  void serve_streaming(const UsbRequest& request, int selector);
  void serve_control(const UsbRequest& request, std::pair<int, int> entity_and_selector);
  void reply(const UsbRequest& request, const Bytes& data);
  Bytes negotiated() const;
  void take_negotiation(const Bytes& data);
  void send_frames();
  void begin_frame();
  Bytes next_payload(std::uint32_t room);

  const CameraModel model_;
  const Picture picture_;
  UsbipLink link_;
  mutable std::mutex mutex_;  // guards controls_
  std::map<std::pair<int, int>, Control> controls_;
  std::atomic<bool> is_next_damaged_ = false;
  std::atomic<std::uint32_t> sent_ = 0;

  // Used by the thread only.
  std::uint8_t format_ = kMjpgFormat;
  std::uint32_t interval_;  // 100 ns
  bool is_streaming_ = false, is_damaged_ = false;
  std::int64_t next_ns_ = 0;
  std::uint32_t number_ = 0;
  std::uint8_t toggle_ = 0;                                        // changes with each frame
  std::deque<std::pair<std::uint32_t, std::uint32_t>> transfers_;  // waiting for data: number, length
  Bytes frame_;
  std::size_t position_ = 0;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace panvo::test
