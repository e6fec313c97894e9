// SPDX-License-Identifier: Apache-2.0
#include "parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "panvo/runtime/errors.hpp"
#include "panvo/v4l2_camera/control.hpp"

namespace panvo::v4l2_camera {
namespace {

using camera_stream::CameraRole;
using camera_stream::ImageOutput;
using camera_stream::Layout;
using camera_stream::PixelFormat;

ImageParts parts_of(const std::string& layout) {
  if (layout == "side_by_side") return ImageParts::kSideBySide;
  if (layout == "top_bottom") return ImageParts::kTopBottom;
  return layout == "byte_interleaved" ? ImageParts::kByteInterleaved : ImageParts::kOne;
}

PixelFormat byte_format(const std::string& encoding) {
  if (encoding == "bayer_rggb8") return PixelFormat::kBayerRG8;
  if (encoding == "bayer_grbg8") return PixelFormat::kBayerGR8;
  if (encoding == "bayer_gbrg8") return PixelFormat::kBayerGB8;
  return encoding == "bayer_bggr8" ? PixelFormat::kBayerBG8 : PixelFormat::kMono8;
}

/// The roles of the published images, in order. Throws std::invalid_argument with the allowed number of cameras.
std::vector<CameraRole> roles_of(const std::string& layout, std::size_t cameras) {
  const bool is_one_device = layout == "dual_fisheye" || parts_of(layout) != ImageParts::kOne;
  if (is_one_device && cameras != 1)
    throw std::invalid_argument(fmt::format("layout {} has one camera; {} given", layout, cameras));
  if (layout == "dual_fisheye") return camera_stream::roles_of(Layout::kRig, 1);  // the stitcher splits the image
  if (is_one_device) return camera_stream::roles_of(Layout::kStereo, 2);
  return camera_stream::roles_of(camera_stream::layout_of(layout), cameras);
}

CameraSettings common_settings(const Parameters& parameters) {
  CameraSettings settings;
  settings.format = {parameters.pixel_format, parameters.width, parameters.height, parameters.frame_rate_hz,
                     parameters.encoding == "grey"};
  settings.parts = {parts_of(parameters.layout), parameters.swap_eyes, byte_format(parameters.interleaved)};
  settings.output = parameters.encoding == "grey"      ? ImageOutput::kGrey
                    : parameters.encoding == "as_sent" ? ImageOutput::kAsSent
                                                       : ImageOutput::kReadable;
  settings.stamps = parameters.clock == "arrival" ? StampSource::kArrival : StampSource::kDriver;
  settings.buffers = parameters.buffers;
  settings.watchdog_ns = static_cast<std::int64_t>(parameters.watchdog_s * 1e9);
  return settings;
}

/// The roles of each device: one image per device, or both eyes from one.
std::vector<std::vector<CameraRole>> by_device(const std::vector<CameraRole>& roles, std::size_t devices) {
  std::vector<std::vector<CameraRole>> result(devices);
  for (std::size_t i = 0; i < roles.size(); ++i) result[devices == 1 ? 0 : i].push_back(roles[i]);
  return result;
}

}  // namespace

camera_group::CameraSet<CameraSettings> cameras_of(const Parameters& parameters) {
  auto selectors = parameters.cameras;
  if (selectors.empty()) selectors.emplace_back();
  camera_group::CameraSet<CameraSettings> cameras;
  cameras.tolerance_ns = static_cast<std::int64_t>(parameters.pair_tolerance_ms * 1e6);
  std::vector<CameraRole> roles;
  try {
    roles = roles_of(parameters.layout, selectors.size());
  } catch (const std::invalid_argument& error) {
    throw runtime::ConfigError(std::string("cameras: ") + error.what() +
                               "; name them by serial number (`panvo devices` lists them)");
  }
  std::vector<std::string> problems, devices;
  const auto of_devices = by_device(roles, selectors.size());
  for (const auto& its_roles : of_devices) devices.push_back(its_roles.size() == 1 ? its_roles[0].name : "camera");
  for (std::size_t i = 0; i < selectors.size(); ++i) {
    if (std::count(selectors.begin(), selectors.begin() + static_cast<std::ptrdiff_t>(i), selectors[i]) > 0)
      problems.push_back("cameras: " + selectors[i] + " is named twice");
    auto settings = common_settings(parameters);
    settings.name = devices[i];
    settings.camera = selectors[i];
    for (const auto& role : of_devices[i]) settings.frame_ids.push_back(role.frame_id);
    try {
      settings.controls = camera_group::settings_of("controls", parameters.controls, settings.name, devices);
      for (auto& control : settings.controls) control.name = control_name(control.name);
    } catch (const std::invalid_argument& error) {
      problems.emplace_back(error.what());
    }
    cameras.devices.push_back(std::move(settings));
  }
  cameras.images = camera_group::images_of(roles, parameters.calibration, problems);
  if (!problems.empty()) throw runtime::ConfigError(std::move(problems));
  return cameras;
}

}  // namespace panvo::v4l2_camera
