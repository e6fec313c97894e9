// SPDX-License-Identifier: Apache-2.0
#include "parameters.hpp"

#include <stdexcept>

#include "panvo/runtime/errors.hpp"

namespace panvo::aravis_camera {
namespace {

CameraSettings common_settings(const Parameters& parameters) {
  CameraSettings settings;
  settings.pixel_format = parameters.pixel_format;
  settings.width = parameters.width;
  settings.height = parameters.height;
  settings.offset_x = parameters.offset_x;
  settings.offset_y = parameters.offset_y;
  settings.frame_rate_hz = parameters.frame_rate_hz;
  settings.exposure_us = parameters.exposure_us;
  settings.trigger = parameters.trigger == "software" ? Trigger::kSoftware
                     : parameters.trigger == "line"   ? Trigger::kLine
                                                      : Trigger::kFreeRun;
  settings.trigger_line = parameters.trigger_line;
  settings.software_trigger_hz = parameters.software_trigger_hz;
  settings.ptp = parameters.clock == "ptp";
  settings.chunks = parameters.chunks;
  settings.packet_size = parameters.packet_size;
  if (parameters.packet_delay_ns >= 0) settings.packet_delay_ns = parameters.packet_delay_ns;
  settings.resend = parameters.resend;
  settings.packet_socket = parameters.packet_socket == "on"    ? PacketSocket::kOn
                           : parameters.packet_socket == "off" ? PacketSocket::kOff
                                                               : PacketSocket::kAuto;
  settings.buffers = parameters.buffers;
  return settings;
}

GrabberSettings grabber_settings(const Parameters& parameters, const camera_stream::CameraRole& role) {
  GrabberSettings settings;
  settings.name = role.name;
  settings.frame_id = role.frame_id;
  settings.camera = common_settings(parameters);
  settings.stamps = parameters.clock == "ptp"       ? StampSource::kPtp
                    : parameters.clock == "arrival" ? StampSource::kArrival
                                                    : StampSource::kMapped;
  settings.output = parameters.encoding == "grey"      ? camera_stream::ImageOutput::kGrey
                    : parameters.encoding == "as_sent" ? camera_stream::ImageOutput::kAsSent
                                                       : camera_stream::ImageOutput::kReadable;
  settings.watchdog_ns = static_cast<std::int64_t>(parameters.watchdog_s * 1e9);
  return settings;
}

std::vector<std::string> names_of(const std::vector<camera_stream::CameraRole>& roles) {
  std::vector<std::string> names;
  for (const auto& role : roles) names.push_back(role.name);
  return names;
}

}  // namespace

camera_group::CameraSet<GrabberSettings> cameras_of(const Parameters& parameters) {
  auto selectors = parameters.cameras;
  if (selectors.empty()) selectors.emplace_back();
  std::vector<camera_stream::CameraRole> roles;
  try {
    roles = roles_of(camera_stream::layout_of(parameters.layout), selectors.size());
  } catch (const std::invalid_argument& error) {
    throw runtime::ConfigError(std::string("cameras: ") + error.what() +
                               "; name them by serial number (`panvo devices` lists them)");
  }
  camera_group::CameraSet<GrabberSettings> cameras;
  cameras.tolerance_ns = static_cast<std::int64_t>(parameters.pair_tolerance_ms * 1e6);
  std::vector<std::string> problems;
  for (std::size_t i = 0; i < roles.size(); ++i) {
    auto settings = grabber_settings(parameters, roles[i]);
    settings.camera.camera = selectors[i];
    for (std::size_t other = 0; other < i; ++other) {
      if (selectors[other] == selectors[i]) problems.push_back("cameras: " + selectors[i] + " is named twice");
    }
    try {
      settings.camera.features =
          camera_group::settings_of("features", parameters.features, settings.name, names_of(roles));
    } catch (const std::invalid_argument& error) {
      problems.emplace_back(error.what());
    }
    cameras.devices.push_back(std::move(settings));
  }
  cameras.images = camera_group::images_of(roles, parameters.calibration, problems);
  if (!problems.empty()) throw runtime::ConfigError(std::move(problems));
  return cameras;
}

}  // namespace panvo::aravis_camera
