// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "panvo/aravis_camera/camera_grabber.hpp"
#include "panvo/camera_group/camera_component.hpp"

namespace panvo::aravis_camera {

/// What the component takes from a system file.
struct Parameters {
  std::vector<std::string> cameras;
  std::string layout = "mono";
  std::string pixel_format;
  int width = 0, height = 0, offset_x = 0, offset_y = 0;
  double frame_rate_hz = 0.0;
  double exposure_us = 0.0;
  std::vector<std::string> features;
  std::string trigger = "off";
  std::string trigger_line = "Line0";
  double software_trigger_hz = 10.0;
  std::string clock = "mapped";
  std::vector<std::string> chunks;
  int packet_size = 0;
  int packet_delay_ns = -1;
  bool resend = true;
  std::string packet_socket = "auto";
  int buffers = 16;
  double watchdog_s = 1.0;
  double pair_tolerance_ms = 5.0;
  std::string encoding = "readable";
  std::string calibration;
  std::vector<double> mount;
  bool simulated = false;

  bool operator==(const Parameters&) const = default;

  template <class Field>
  static void describe(Field&& field) {
    using P = Parameters;
    field(&P::cameras, "cameras", "",
          "serial number, user-defined name, IP or MAC address of each: left, right; or the heads. Empty: the first "
          "that is "
          "found");
    field(&P::layout, "layout", "", "how they belong together", {"mono", "panorama", "stereo", "rig"});
    field(&P::pixel_format, "pixel_format", "", "GenICam's name, as Mono8; empty: as the camera has it");
    field(&P::width, "width", "px", "0: as the camera has it", 0, 65536);
    field(&P::height, "height", "px", "0: as the camera has it", 0, 65536);
    field(&P::offset_x, "offset_x", "px", "of the part of the sensor that is read, with width or height", 0, 65536);
    field(&P::offset_y, "offset_y", "px", "the same, down", 0, 65536);
    field(&P::frame_rate_hz, "frame_rate_hz", "Hz", "0: as the camera has it", 0.0, 10000.0);
    field(&P::exposure_us, "exposure_us", "us", "0: as the camera has it", 0.0, 1e8);
    field(&P::features, "features", "",
          "GenICam features to be set before all else, in order: Name=value, or left:Name=value for one camera; may be "
          "set while "
          "the cameras stream");
    field(&P::trigger, "trigger", "",
          "what begins a frame: the camera itself, a command from here, a signal on its line",
          {"off", "software", "line"});
    field(&P::trigger_line, "trigger_line", "", "GenICam's name of the line");
    field(&P::software_trigger_hz, "software_trigger_hz", "Hz", "how often, with trigger software", 0.01, 1000.0);
    field(&P::clock, "clock", "",
          "where stamps come from: the camera's clock mapped to the host's, the camera's clock where both follow PTP, "
          "or the "
          "arrival",
          {"mapped", "ptp", "arrival"});
    field(&P::chunks, "chunks", "",
          "GenICam's names of data to be sent with each frame, shown in diagnostics: ExposureTime");
    field(&P::packet_size, "packet_size", "B", "GigE: of the network's packets; 0: the largest that passes", 0, 65536);
    field(&P::packet_delay_ns, "packet_delay_ns", "ns", "GigE: between packets; -1: as the camera has it", -1, 1e9);
    field(&P::resend, "resend", "", "GigE: ask for lost packets again");
    field(&P::packet_socket, "packet_socket", "",
          "GigE: receive packets before the IP stack does, which needs CAP_NET_RAW; auto: where it works",
          {"auto", "on", "off"});
    field(&P::buffers, "buffers", "", "frames that may wait in the driver", 2, 1000);
    field(&P::watchdog_s, "watchdog_s", "s",
          "without a frame for so long, and three frames' time, a camera is closed and looked for; 0: only when it "
          "says that "
          "it is gone, as always with trigger line",
          0.0, 3600.0);
    field(&P::pair_tolerance_ms, "pair_tolerance_ms", "ms",
          "by how much the stamps within a set may differ; less than half the time between two frames", 0.0, 1000.0);
    field(&P::encoding, "encoding", "",
          "of what is published: what every component here reads (Bayer and YUV as bgr8), grey, or as the camera sends "
          "it",
          {"readable", "grey", "as_sent"});
    field.path(&P::calibration, "calibration",
               "folder of ROS camera_info files camera.yaml; left.yaml, right.yaml; head_0.yaml ...");
    field(&P::mount, "mount", "",
          "where the cameras sit on base_link, for /tf_static: x, y, z in m, roll, pitch, yaw in degrees, of each, or "
          "of the "
          "left one of a calibrated pair; empty: not published");
    field(&P::simulated, "simulated", "", "Aravis's simulated camera Fake_1 counts as connected: for trials");
  }
};

/// The cameras that are meant. Throws runtime::ConfigError with every problem.
camera_group::CameraSet<GrabberSettings> cameras_of(const Parameters& parameters);

}  // namespace panvo::aravis_camera
