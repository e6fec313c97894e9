// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "panvo/aravis_camera/camera_grabber.hpp"
#include "panvo/camera_group/camera_component.hpp"

namespace panvo::aravis_camera {

/// Parameters of the component.
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
          "serial number, user-defined name, IP or MAC address of each camera: left, right; or the heads; "
          "empty: the first camera found");
    field(&P::layout, "layout", "", "arrangement of the cameras", {"mono", "panorama", "stereo", "rig"});
    field(&P::pixel_format, "pixel_format", "", "GenICam name, e.g. Mono8; empty: the camera's setting");
    field(&P::width, "width", "px", "image width; 0: the camera's setting", 0, 65536);
    field(&P::height, "height", "px", "image height; 0: the camera's setting", 0, 65536);
    field(&P::offset_x, "offset_x", "px", "left edge of the sensor region, with width or height", 0, 65536);
    field(&P::offset_y, "offset_y", "px", "top edge of the sensor region, with width or height", 0, 65536);
    field(&P::frame_rate_hz, "frame_rate_hz", "Hz", "frame rate; 0: the camera's setting", 0.0, 10000.0);
    field(&P::exposure_us, "exposure_us", "us", "exposure time; 0: the camera's setting", 0.0, 1e8);
    field(&P::features, "features", "",
          "GenICam features, set in order before all else: Name=value, or left:Name=value for one camera; "
          "can change while streaming");
    field(&P::trigger, "trigger", "",
          "frame trigger: none (free running), command from this driver, or signal on an input line",
          {"off", "software", "line"});
    field(&P::trigger_line, "trigger_line", "", "GenICam name of the input line");
    field(&P::software_trigger_hz, "software_trigger_hz", "Hz", "rate of the software trigger", 0.01, 1000.0);
    field(&P::clock, "clock", "",
          "source of stamps: camera clock mapped to the host clock, camera clock synchronised by PTP, or arrival time",
          {"mapped", "ptp", "arrival"});
    field(&P::chunks, "chunks", "",
          "GenICam names of chunk data to send with each frame, shown in diagnostics: ExposureTime");
    field(&P::packet_size, "packet_size", "B", "GigE: network packet size; 0: the largest possible", 0, 65536);
    field(&P::packet_delay_ns, "packet_delay_ns", "ns", "GigE: delay between packets; -1: the camera's setting", -1,
          1e9);
    field(&P::resend, "resend", "", "GigE: request lost packets again");
    field(&P::packet_socket, "packet_socket", "",
          "GigE: receive packets before the IP stack (needs CAP_NET_RAW); auto: if it works", {"auto", "on", "off"});
    field(&P::buffers, "buffers", "", "number of frame buffers in the driver", 2, 1000);
    field(&P::watchdog_s, "watchdog_s", "s",
          "a camera without frames for this time, and at least three frame periods, is closed and searched for; "
          "0, or trigger line: only if it is reported lost",
          0.0, 3600.0);
    field(&P::pair_tolerance_ms, "pair_tolerance_ms", "ms",
          "largest stamp difference within a set; keep below half a frame period", 0.0, 1000.0);
    field(&P::encoding, "encoding", "",
          "published encoding: readable by all components (Bayer and YUV as bgr8), grey, or as sent by the camera",
          {"readable", "grey", "as_sent"});
    field.path(&P::calibration, "calibration",
               "folder of ROS camera_info files: camera.yaml; panorama.yaml; left.yaml, right.yaml; head_0.yaml ...");
    field(&P::mount, "mount", "",
          "camera poses on base_link, for /tf_static: x, y, z in m, roll, pitch, yaw in degrees of each camera, "
          "or of the left camera of a calibrated pair; empty: not published");
    field(&P::simulated, "simulated", "", "enable Aravis's simulated camera Fake_1, for tests");
  }
};

/// The selected cameras with their settings. Throws runtime::ConfigError with all problems.
camera_group::CameraSet<GrabberSettings> cameras_of(const Parameters& parameters);

}  // namespace panvo::aravis_camera
