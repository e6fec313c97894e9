// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "panvo/camera_group/device_setting.hpp"

namespace panvo::aravis_camera {

/// What begins a frame.
enum class Trigger {
  kFreeRun,   ///< the camera's own clock
  kSoftware,  ///< a command from here
  kLine,      ///< a signal on one of its lines
};

/// How the packets of a GigE camera are received. A packet socket takes them before the host's IP stack: less work, and it needs CAP_NET_RAW;
/// on some interfaces, loopback among them, nothing comes that way.
enum class PacketSocket {
  kAuto,  ///< where it may be opened; when nothing comes that way, a UDP socket from then on
  kOn,
  kOff,  ///< a UDP socket
};

/// How one camera is found and set. What is zero, empty or absent stays as the camera has it.
struct CameraSettings {
  std::string
      camera;  ///< serial number, user-defined name, IP or MAC address, or Aravis's id; empty: the first that is found
  std::vector<camera_group::DeviceSetting> features{};  ///< GenICam's; set before all else, in order
  std::string pixel_format{};                           ///< GenICam's name
  int width = 0, height = 0;                            ///< px
  int offset_x = 0, offset_y = 0;                       ///< px, with a width or height
  double frame_rate_hz = 0.0;
  double exposure_us = 0.0;
  Trigger trigger = Trigger::kFreeRun;
  std::string trigger_line = "Line0";
  double software_trigger_hz = 10.0;
  bool ptp = false;                      ///< have the camera follow the network's clock
  std::vector<std::string> chunks{};     ///< GenICam's names of data to be sent with each frame
  int packet_size = 0;                   ///< bytes; 0: the largest that passes
  std::optional<int> packet_delay_ns{};  ///< between packets
  bool resend = true;                    ///< ask for lost packets again
  PacketSocket packet_socket = PacketSocket::kAuto;
  int buffers = 16;
};

}  // namespace panvo::aravis_camera
