// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "gobject.hpp"
#include "panvo/aravis_camera/camera_settings.hpp"

namespace panvo::aravis_camera {

/// A camera that cannot be opened now; what() says why and what to do.
class OpenError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Which device it was: with this it is found again.
struct Identity {
  std::string id, serial, address, vendor, model, protocol;
};

/// What the camera was set to in the end.
struct Negotiated {
  int width = 0, height = 0;
  std::string pixel_format;
  double frame_rate_hz = 0.0;  ///< 0: not known
  unsigned packet_size = 0;    ///< 0: no GigE camera
  bool uses_packet_socket = false;
  std::vector<std::string> refused;  ///< settings that the camera did not take, and why
};

enum class FrameStatus { kWhole, kIncomplete, kDamaged };

/// A frame in a buffer of the stream; the buffer goes back when this goes.
class ReceivedFrame {
 public:
  ReceivedFrame(ArvStream* stream, ArvBuffer* buffer) : stream_(stream), buffer_(buffer) {}
  ~ReceivedFrame() { arv_stream_push_buffer(stream_, buffer_); }
  ReceivedFrame(const ReceivedFrame&) = delete;
  ReceivedFrame& operator=(const ReceivedFrame&) = delete;

  FrameStatus status() const;
  std::string status_text() const;
  std::uint64_t number() const { return arv_buffer_get_frame_id(buffer_); }
  std::int64_t device_ns() const { return static_cast<std::int64_t>(arv_buffer_get_timestamp(buffer_)); }
  /// Host time at which its first packet came; 0: not known.
  std::int64_t arrival_ns() const { return static_cast<std::int64_t>(arv_buffer_get_system_timestamp(buffer_)); }
  ArvBuffer* buffer() const { return buffer_; }

 private:
  ArvStream* stream_;
  ArvBuffer* buffer_;
};

/// A camera that is open, set and streaming. Closing it may take seconds when the device does not answer.
class OpenedCamera {
 public:
  enum class Search { kAtItsPlace, kEverywhere };
  /// Opens the device `known` where that is given, at its place or wherever it is by now; otherwise the one that the settings mean. Throws OpenError.
  OpenedCamera(const CameraSettings& settings, bool use_packet_socket, const std::optional<Identity>& known,
               Search search);
  ~OpenedCamera();
  OpenedCamera(const OpenedCamera&) = delete;
  OpenedCamera& operator=(const OpenedCamera&) = delete;

  const Identity& identity() const noexcept { return identity_; }
  const Negotiated& negotiated() const noexcept { return negotiated_; }
  bool is_gige() const noexcept { return is_gige_; }

  /// The device has told that it is not under this program's control any more.
  bool is_gone() const noexcept { return is_gone_; }

  /// nullptr: none came within `limit`.
  std::unique_ptr<ReceivedFrame> receive(std::chrono::microseconds limit);

  /// Sets features now; returns what the camera does not take, and why.
  std::vector<std::string> set(const std::vector<camera_group::DeviceSetting>& features);

  /// False when the device does not take the command.
  bool trigger();

  std::uint64_t resent_packets() const;
  /// The chunk data that came with a frame, as text; what is not in it is left out.
  std::map<std::string, std::string> chunk_data(const ReceivedFrame& frame) const;

 private:
  void open(const std::string& id, const std::optional<Identity>& known);
  void start(const CameraSettings& settings, bool use_packet_socket);
  void take_in_identity(const std::string& id);

  Identity identity_;
  Negotiated negotiated_;
  bool is_gige_ = false;
  std::atomic<bool> is_gone_ = false;
  std::vector<std::string> chunks_;
  ObjectPtr<ArvCamera> camera_;
  ObjectPtr<ArvChunkParser> chunk_parser_;
  ObjectPtr<ArvStream> stream_;
  gulong lost_handler_ = 0;
};

}  // namespace panvo::aravis_camera
