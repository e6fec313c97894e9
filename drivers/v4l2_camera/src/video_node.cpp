// SPDX-License-Identifier: Apache-2.0
#include "panvo/v4l2_camera/video_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>

#include "usb_interface.hpp"

namespace panvo::v4l2_camera {
namespace {

namespace fs = std::filesystem;

std::string first_line(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  line.erase(line.find_last_not_of(" \r\n") + 1);
  return line;
}

VideoNode read_node(const fs::path& folder, const fs::path& devices) {
  VideoNode node;
  node.path = (devices / folder.filename()).string();
  node.name = first_line(folder / "name");
  const std::string index = first_line(folder / "index");
  node.index = index.empty() ? 0 : std::atoi(index.c_str());
  if (const fs::path interface = usb_interface(folder); !interface.empty()) {
    const fs::path usb = interface.parent_path();  // the device
    node.serial = first_line(usb / "serial");
    node.vendor = first_line(usb / "manufacturer");
    if (node.vendor.empty()) node.vendor = first_line(usb / "idVendor");
    node.port = usb.filename().string();
  }
  return node;
}

std::string nodes_text(const std::vector<VideoNode>& nodes) {
  std::string text;
  for (const auto& node : nodes) {
    if (node.index != 0) continue;
    text +=
        fmt::format("{}{} ({} at {}{}{})", text.empty() ? "" : ", ", node.serial.empty() ? "no serial" : node.serial,
                    node.name, node.path, node.port.empty() ? "" : ", USB port ", node.port);
  }
  return text.empty() ? "no camera is connected" : "available: " + text;
}

std::vector<VideoNode> that(const std::vector<VideoNode>& nodes, const std::function<bool(const VideoNode&)>& fits) {
  std::vector<VideoNode> found;
  std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(found), fits);
  return found;
}

/// The first node of each camera.
std::vector<VideoNode> cameras_on(const std::vector<VideoNode>& nodes) {
  return that(nodes, [](const VideoNode& node) { return node.index == 0; });
}

bool is_same_file(const std::string& path, const std::string& other) {
  std::error_code error;
  return path == other || (path.starts_with("/") && fs::equivalent(path, other, error) && !error);
}

}  // namespace

std::vector<VideoNode> list_nodes(const fs::path& classes, const fs::path& devices) {
  std::vector<VideoNode> nodes;
  std::error_code error;
  for (fs::directory_iterator entry(classes, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().filename().string().starts_with("video")) nodes.push_back(read_node(entry->path(), devices));
  }
  std::sort(nodes.begin(), nodes.end(), [](const VideoNode& a, const VideoNode& b) {
    return std::pair(a.path.size(), a.path) < std::pair(b.path.size(), b.path);  // video2 before video10
  });
  return nodes;
}

FoundNode find_node(const std::vector<VideoNode>& nodes, const std::string& selector) {
  const auto cameras = cameras_on(nodes);
  if (selector.empty()) {
    if (cameras.empty()) return {std::nullopt, "no camera is connected: plug one in (`panvo devices` lists cameras)"};
    return {cameras.front(), ""};
  }
  if (const auto at_path = that(nodes, [&](const VideoNode& node) { return is_same_file(selector, node.path); });
      !at_path.empty())
    return {at_path.front(), ""};
  const auto fields = {&VideoNode::serial, &VideoNode::port, &VideoNode::name};
  for (const auto field : fields) {
    const auto fitting = that(cameras, [&](const VideoNode& node) { return node.*field == selector; });
    if (fitting.size() == 1) return {fitting.front(), ""};
    if (fitting.size() > 1) {
      return {std::nullopt, fmt::format("'{}' matches {} cameras: select one by USB port or path; {}", selector,
                                        fitting.size(), nodes_text(fitting))};
    }
  }
  return {std::nullopt, fmt::format("camera '{}' not found; {}", selector, nodes_text(nodes))};
}

FoundNode find_again(const std::vector<VideoNode>& nodes, const VideoNode& known) {
  const bool has_serial = !known.serial.empty();
  auto fitting = that(nodes, [&](const VideoNode& node) {
    return node.index == known.index && node.name == known.name && node.serial == known.serial &&
           (has_serial || node.port == known.port) && (has_serial || !known.port.empty() || node.path == known.path);
  });
  if (fitting.size() > 1) {  // many cheap cameras share a serial number
    const auto at_port = that(fitting, [&](const VideoNode& node) { return node.port == known.port; });
    if (!at_port.empty()) fitting = at_port;
  }
  if (!fitting.empty()) return {fitting.front(), ""};
  return {std::nullopt, fmt::format("{} {} is no longer connected; {}", known.name,
                                    has_serial ? known.serial : "at " + (known.port.empty() ? known.path : known.port),
                                    nodes_text(nodes))};
}

}  // namespace panvo::v4l2_camera
