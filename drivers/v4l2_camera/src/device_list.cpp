// SPDX-License-Identifier: Apache-2.0
#include "panvo/v4l2_camera/device_list.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

namespace panvo::v4l2_camera {
namespace {

std::string device_text(const OfferedSize& size) {
  if (size.step_x == 0 && size.step_y == 0) return fmt::format("{} x {}", size.width, size.height);
  return fmt::format("{} x {} to {} x {}", size.min_width, size.min_height, size.width, size.height);
}

/// "MJPG 1280 x 480, 640 x 240 px; YUYV 640 x 240 px": formats with equal sizes are grouped.
std::string sizes_of(const std::vector<OfferedFormat>& offered) {
  std::map<std::string, std::vector<std::string>> formats_of;  // by their sizes
  std::vector<std::string> order;
  for (const auto& format : offered) {
    std::vector<std::string> sizes;
    sizes.reserve(format.sizes.size());
    for (const auto& size : format.sizes) sizes.push_back(device_text(size));
    const std::string text = fmt::format("{}", fmt::join(sizes, ", "));
    if (text.empty()) continue;
    if (!formats_of.contains(text)) order.push_back(text);
    formats_of[text].push_back(to_text(format.pixels));
  }
  std::vector<std::string> parts;
  parts.reserve(order.size());
  for (const auto& text : order) {
    parts.push_back(order.size() == 1 ? text + " px" : fmt::format("{} {} px", fmt::join(formats_of[text], "/"), text));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

/// The supported formats, then the others: by name if they are few, else their number.
std::vector<std::string> formats_of(const std::vector<OfferedFormat>& offered) {
  constexpr std::size_t kFew = 4;
  std::vector<std::string> read, others;
  for (const auto& format : offered) {
    const Coding coding = coding_of(format.pixels);
    const bool is_read = coding == Coding::kRaw || coding == Coding::kJpeg;
    is_read ? read.push_back(to_text(format.pixels)) : others.push_back(to_text(format.pixels) + " (not supported)");
  }
  if (others.size() > kFew) others = {fmt::format("{} others (not supported)", others.size())};
  read.insert(read.end(), others.begin(), others.end());
  return read;
}

std::string rates_of(const std::vector<OfferedFormat>& offered) {
  std::set<double> rates;
  for (const auto& format : offered) {
    for (const auto& size : format.sizes) rates.insert(size.rates_hz.begin(), size.rates_hz.end());
  }
  if (rates.empty()) return {};
  return rates.size() == 1 ? fmt::format("{:.4g} Hz", *rates.begin())
                           : fmt::format("{:.3g} to {:.4g} Hz", *rates.begin(), *rates.rbegin());
}

}  // namespace

std::vector<camera_stream::FoundDevice> find_devices(const Devices& devices) {
  std::vector<camera_stream::FoundDevice> found;
  for (const auto& node : devices.list()) {
    camera_stream::FoundDevice device;
    device.driver = "v4l2_camera";
    device.protocol = node.port.empty() ? "V4L2" : "UVC";
    device.vendor = node.vendor;
    device.model = node.name;
    device.serial = node.serial;
    device.address = node.port.empty() ? node.path : node.path + ", USB port " + node.port;
    try {
      const auto offered = devices.open(node.path)->offered_formats();
      device.formats = formats_of(offered);
      device.sizes = sizes_of(offered);
      device.rates = rates_of(offered);
    } catch (const DeviceError& error) {
      if (error.kind() == DeviceError::Kind::kOther) continue;  // not a camera: metadata, outputs, codecs
      if (node.index != 0) continue;
      device.problem = error.what();
    }
    found.push_back(std::move(device));
  }
  return found;
}

}  // namespace panvo::v4l2_camera
