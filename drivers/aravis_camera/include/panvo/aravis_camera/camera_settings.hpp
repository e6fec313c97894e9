// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "panvo/camera_group/device_setting.hpp"

namespace panvo::aravis_camera {

/// What triggers a frame.
enum class Trigger {
  kFreeRun,   ///< the camera's own clock
  kSoftware,  ///< a command from this driver
  kLine,      ///< a signal on an input line of the camera
};

/// How the packets of a GigE camera are received. A packet socket bypasses the host's IP stack: it needs less CPU time,
/// and CAP_NET_RAW; on some interfaces, such as loopback, it receives nothing.
enum class PacketSocket {
  kAuto,  ///< if permitted; falls back to a UDP socket if it receives nothing
  kOn,
  kOff,  ///< a UDP socket
};

/// How one camera is found and configured. Values that are zero, empty or absent keep the camera's setting.
struct CameraSettings {
  /// Serial number, user-defined name, model, IP or MAC address, or Aravis's id; empty: the first camera found.
  std::string camera;
  std::vector<camera_group::DeviceSetting> features{};  ///< GenICam features, set in order before all else
  std::string pixel_format{};                           ///< GenICam name
  int width = 0, height = 0;                            ///< px
  int offset_x = 0, offset_y = 0;                       ///< px; used with a width or height
  double frame_rate_hz = 0.0;
  double exposure_us = 0.0;
  Trigger trigger = Trigger::kFreeRun;
  std::string trigger_line = "Line0";
  double software_trigger_hz = 10.0;
  bool ptp = false;                      ///< synchronise the camera clock by PTP
  std::vector<std::string> chunks{};     ///< GenICam names of the chunk data to send with each frame
  int packet_size = 0;                   ///< bytes; 0: the largest possible
  std::optional<int> packet_delay_ns{};  ///< between packets
  bool resend = true;                    ///< request lost packets again
  PacketSocket packet_socket = PacketSocket::kAuto;
  int buffers = 16;
};

}  // namespace panvo::aravis_camera
