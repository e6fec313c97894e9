// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "panvo/camera_group/camera_component.hpp"
#include "panvo/v4l2_camera/camera_settings.hpp"

namespace panvo::v4l2_camera {

/// What the component takes from a system file.
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
          "by serial number, path (/dev/video0, /dev/v4l/by-id/...), USB port or name, as `panvo devices` lists them; "
          "empty: the first there is");
    field(&P::layout, "layout", "",
          "one camera; one that sends a panorama; two fisheyes in one image; left and right in one image; two cameras; "
          "the heads of a panoramic camera",
          {"mono", "panorama", "dual_fisheye", "side_by_side", "top_bottom", "byte_interleaved", "stereo", "rig"});
    field(&P::swap_eyes, "swap_eyes", "", "of one image with both eyes, the right one's part comes first");
    field(&P::interleaved, "interleaved", "", "with layout byte_interleaved, what each byte is",
          {"mono8", "bayer_rggb8", "bayer_grbg8", "bayer_gbrg8", "bayer_bggr8"});
    field(&P::pixel_format, "pixel_format", "",
          "V4L2's four characters: MJPG, YUYV, GREY, ...; empty: what comes nearest to the rate");
    field(&P::width, "width", "px", "of the whole image, both eyes; 0: as the camera has it", 0, 65536);
    field(&P::height, "height", "px", "the same, down", 0, 65536);
    field(&P::frame_rate_hz, "frame_rate_hz", "Hz", "0: as the camera has it", 0.0, 10000.0);
    field(
        &P::controls, "controls", "",
        "the camera's controls, in order: name=value, or left:name=value for one camera; may be set while the cameras "
        "stream");
    field(&P::clock, "clock", "", "where stamps come from: the kernel's driver, or the arrival", {"driver", "arrival"});
    field(&P::buffers, "buffers", "", "frames that may wait in the kernel", 2, 32);
    field(
        &P::watchdog_s, "watchdog_s", "s",
        "without a frame for so long, and three frames' time, a camera is closed and looked for; 0: only when it says "
        "that it is gone",
        0.0, 3600.0);
    field(
        &P::pair_tolerance_ms, "pair_tolerance_ms", "ms",
        "of stereo and rig, by how much the stamps within a set may differ; less than half the time between two frames",
        0.0, 1000.0);
    field(&P::encoding, "encoding", "",
          "of what is published: what every component here reads (Bayer and YUV as bgr8), grey, or as the camera sends "
          "it",
          {"readable", "grey", "as_sent"});
    field.path(&P::calibration, "calibration",
               "folder of ROS camera_info files camera.yaml; left.yaml, right.yaml; head_0.yaml ...");
    field(
        &P::mount, "mount", "",
        "where the cameras sit on base_link, for /tf_static: x, y, z in m, roll, pitch, yaw in degrees, of each, or of "
        "the left one of a calibrated pair; empty: not published");
  }
};

/// What is meant. Throws runtime::ConfigError with every problem.
camera_group::CameraSet<CameraSettings> cameras_of(const Parameters& parameters);

}  // namespace panvo::v4l2_camera
