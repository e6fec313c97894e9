// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace panvo::v4l2_camera {

/// A device node, as described in sysfs without opening it.
struct VideoNode {
  std::string path;    ///< "/dev/video0"; may change each time the camera is plugged in
  std::string name;    ///< name of the camera: "ZED 2: ZED 2"
  std::string serial;  ///< USB serial number; empty: none
  std::string vendor;  ///< manufacturer, or else the USB vendor id: "2b03"
  std::string port;    ///< USB port, "1-2.3"; constant for a given socket; empty: not known
  int index = 0;       ///< among the nodes of the device; nodes other than the first often have no images
};

/// Lists the video nodes, in order of path. `classes` and `devices` are /sys/class/video4linux and /dev.
std::vector<VideoNode> list_nodes(const std::filesystem::path& classes = "/sys/class/video4linux",
                                  const std::filesystem::path& devices = "/dev");

/// The result of a search for a node.
struct FoundNode {
  std::optional<VideoNode> node;
  std::string problem;  ///< why there is no node: no match or several, with the available cameras
};

/// The node selected by, in this order, path (including links as in /dev/v4l/by-id), serial number, port or name. An
/// empty `selector` selects the first camera.
FoundNode find_node(const std::vector<VideoNode>& nodes, const std::string& selector);

/// Finds a known camera again at any path: same serial number and name; without a serial number, same port.
FoundNode find_again(const std::vector<VideoNode>& nodes, const VideoNode& known);

}  // namespace panvo::v4l2_camera
