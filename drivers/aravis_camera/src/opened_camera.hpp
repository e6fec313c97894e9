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

/// A camera that cannot be opened; what() gives cause and remedy.
class OpenError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Identity of a device, used to find it again.
struct Identity {
  std::string id, serial, address, vendor, model, protocol;
};

/// The camera's actual settings.
struct Negotiated {
  int width = 0, height = 0;
  std::string pixel_format;
  double frame_rate_hz = 0.0;  ///< 0: not known
  unsigned packet_size = 0;    ///< bytes; 0: not a GigE camera
  bool uses_packet_socket = false;
  std::vector<std::string> refused;  ///< one message for each refused setting
};

enum class FrameStatus { kWhole, kIncomplete, kDamaged };

/// A frame in a buffer of the stream; the destructor returns the buffer.
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
  /// Host time of the first packet's arrival; 0: not known.
  std::int64_t arrival_ns() const { return static_cast<std::int64_t>(arv_buffer_get_system_timestamp(buffer_)); }
  ArvBuffer* buffer() const { return buffer_; }

 private:
  ArvStream* stream_;
  ArvBuffer* buffer_;
};

/// An open, configured, streaming camera. Closing an unresponsive device may take seconds.
class OpenedCamera {
 public:
  enum class Search { kAtItsPlace, kEverywhere };
  /// Opens the device `known` if given, at its last address or by a search; otherwise the one that the settings select.
  /// Throws OpenError.
  OpenedCamera(const CameraSettings& settings, bool use_packet_socket, const std::optional<Identity>& known,
               Search search);
  ~OpenedCamera();
  OpenedCamera(const OpenedCamera&) = delete;
  OpenedCamera& operator=(const OpenedCamera&) = delete;

  const Identity& identity() const noexcept { return identity_; }
  const Negotiated& negotiated() const noexcept { return negotiated_; }
  bool is_gige() const noexcept { return is_gige_; }

  /// The device reported that this program lost control of it.
  bool is_gone() const noexcept { return is_gone_; }

  /// nullptr: no frame within `limit`.
  std::unique_ptr<ReceivedFrame> receive(std::chrono::microseconds limit);

  /// Sets features immediately; returns one message for each that is refused.
  std::vector<std::string> set(const std::vector<camera_group::DeviceSetting>& features);

  /// False if the device refuses the command.
  bool trigger();

  std::uint64_t resent_packets() const;
  /// The requested chunk data of a frame, as text by name; missing entries are omitted.
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
