// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "panvo/camera_group/camera_component.hpp"
#include "panvo/v4l2_camera/camera_settings.hpp"

namespace panvo::v4l2_camera {

/// Parameters of the component.
struct Parameters {
  std::vector<std::string> cameras;
  std::string layout = "mono";
  bool swap_eyes = false;
  std::string interleaved = "mono8";
  std::string pixel_format;
  int width = 0, height = 0;
  double frame_rate_hz = 0.0;
  std::vector<std::string> controls;
  std::string clock = "driver";
  int buffers = 4;
  double watchdog_s = 1.0;
  double pair_tolerance_ms = 5.0;
  std::string encoding = "readable";
  std::string calibration;
  std::vector<double> mount;

  bool operator==(const Parameters&) const = default;

  template <class Field>
  static void describe(Field&& field) {
    using P = Parameters;
    field(&P::cameras, "cameras", "",
          "serial number, path (/dev/video0, /dev/v4l/by-id/...), USB port or name, as listed by `panvo devices`; "
          "empty: the first camera found");
    field(&P::layout, "layout", "",
          "one camera; one that sends a panorama; two fisheyes in one image; left and right in one image; two cameras; "
          "heads of a panoramic camera",
          {"mono", "panorama", "dual_fisheye", "side_by_side", "top_bottom", "byte_interleaved", "stereo", "rig"});
    field(&P::swap_eyes, "swap_eyes", "", "if one image has both eyes: the right eye comes first");
    field(&P::interleaved, "interleaved", "", "with layout byte_interleaved: format of each byte",
          {"mono8", "bayer_rggb8", "bayer_grbg8", "bayer_gbrg8", "bayer_bggr8"});
    field(&P::pixel_format, "pixel_format", "",
          "V4L2 code of four characters: MJPG, YUYV, GREY, ...; empty: the format closest to the rate");
    field(&P::width, "width", "px", "width of the whole image, both eyes; 0: the camera's setting", 0, 65536);
    field(&P::height, "height", "px", "height of the whole image; 0: the camera's setting", 0, 65536);
    field(&P::frame_rate_hz, "frame_rate_hz", "Hz", "frame rate; 0: the camera's setting", 0.0, 10000.0);
    field(&P::controls, "controls", "",
          "camera controls, set in order: name=value, or left:name=value for one camera; can change while streaming");
    field(&P::clock, "clock", "", "source of stamps: kernel driver or arrival time", {"driver", "arrival"});
    field(&P::buffers, "buffers", "", "number of frame buffers in the kernel", 2, 32);
    field(&P::watchdog_s, "watchdog_s", "s",
          "a camera without frames for this time, and at least three frame periods, is closed and searched for; "
          "0: only if it is reported lost",
          0.0, 3600.0);
    field(&P::pair_tolerance_ms, "pair_tolerance_ms", "ms",
          "stereo and rig: largest stamp difference within a set; keep below half a frame period", 0.0, 1000.0);
    field(&P::encoding, "encoding", "",
          "published encoding: readable by all components (Bayer and YUV as bgr8), grey, or as sent by the camera",
          {"readable", "grey", "as_sent"});
    field.path(&P::calibration, "calibration",
               "folder of ROS camera_info files: camera.yaml; panorama.yaml; left.yaml, right.yaml; head_0.yaml ...");
    field(&P::mount, "mount", "",
          "camera poses on base_link, for /tf_static: x, y, z in m, roll, pitch, yaw in degrees of each camera, "
          "or of the left camera of a calibrated pair; empty: not published");
  }
};

/// The selected cameras with their settings. Throws runtime::ConfigError with all problems.
camera_group::CameraSet<CameraSettings> cameras_of(const Parameters& parameters);

}  // namespace panvo::v4l2_camera
