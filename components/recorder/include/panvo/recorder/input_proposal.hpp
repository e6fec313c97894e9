// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "panvo/recorder/bag_metadata.hpp"

namespace panvo::recorder {

/// A recorded topic, and the topic that panvo's components read it as.
struct TopicRename {
  std::string recorded, read_as;

  bool operator==(const TopicRename&) const = default;
};

/// The cameras of a bag, as far as names and types of its topics tell.
struct InputProposal {
  std::vector<TopicRename> renames;  ///< stereo images, their camera_info, panorama; without those of equal names
  bool has_stereo = false;
  bool has_camera_info = false;  ///< of both stereo cameras
  bool has_panorama = false;
  bool is_compressed = false;  ///< the stereo images are of type CompressedImage
};

/// Finds the stereo pair and the panorama by the names that drivers use: left and right, cam0 and cam1, infra1 and
/// infra2; panorama, 360, equirectangular, theta, insta360. Rectified images are preferred, because a driver that
/// rectifies often records no raw calibration; depth images and single heads of panoramic cameras are not considered.
InputProposal propose_inputs(const std::vector<BagTopic>& recorded);

}  // namespace panvo::recorder
