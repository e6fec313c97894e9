// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace panvo::v4l2_camera {

/// A device node, as the kernel describes it without its being opened.
struct VideoNode {
  std::string path;    ///< "/dev/video0": another one after each plugging in
  std::string name;    ///< the camera's: "ZED 2: ZED 2"
  std::string serial;  ///< USB's; empty: it has none
  std::string vendor;  ///< "2b03", or in words where the device tells them
  std::string port;    ///< of the bus, "1-2.3"; the same again when plugged in at the same place; empty: not known
  int index = 0;       ///< among the nodes of one device; other nodes than the first often carry no images
};

/// The video nodes there are, in order of path. `classes` and `devices` are /sys/class/video4linux and /dev.
std::vector<VideoNode> list_nodes(const std::filesystem::path& classes = "/sys/class/video4linux",
                                  const std::filesystem::path& devices = "/dev");

/// Which node a user means; in order: path (a link as in /dev/v4l/by-id, too), serial number, port, name.
struct FoundNode {
  std::optional<VideoNode> node;
  std::string problem;  ///< why there is none: none fits, or several do; with what there is
};

/// `selector` empty: the first camera there is.
FoundNode find_node(const std::vector<VideoNode>& nodes, const std::string& selector);

/// The camera that was `known`, wherever it is by now: of the same serial number and name; without a serial number, at the same port.
FoundNode find_again(const std::vector<VideoNode>& nodes, const VideoNode& known);

}  // namespace panvo::v4l2_camera
