// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_stream/camera_role.hpp"
#include "panvo/interfaces/topics.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace panvo::camera_stream {

Layout layout_of(std::string_view name) {
  if (name == "mono") return Layout::kMono;
  if (name == "panorama") return Layout::kPanorama;
  if (name == "stereo") return Layout::kStereo;
  if (name == "rig") return Layout::kRig;
  throw std::invalid_argument(fmt::format("unknown layout '{}'; use mono, panorama, stereo or rig", name));
}

std::vector<CameraRole> roles_of(Layout layout, std::size_t cameras) {
  const auto expect = [&](std::size_t least, std::size_t most, const char* what) {
    if (cameras < least || cameras > most) throw std::invalid_argument(fmt::format("{}; {} given", what, cameras));
  };
  std::vector<CameraRole> roles;
  switch (layout) {
    case Layout::kMono:
      expect(1, 1, "layout mono has one camera");
      roles.push_back({"camera", "camera_optical", kCameraImageRaw, kCameraInfo});
      break;
    case Layout::kPanorama:
      expect(1, 1, "layout panorama has one camera");
      roles.push_back({"panorama", "panorama_optical", topics::kPanorama, kCameraInfo});
      break;
    case Layout::kStereo:
      expect(2, 2, "layout stereo has two cameras, left and right");
      roles.push_back({"left", "stereo_left_optical", topics::kStereoLeftImageRaw, topics::kStereoLeftCameraInfo});
      roles.push_back({"right", "stereo_right_optical", topics::kStereoRightImageRaw, topics::kStereoRightCameraInfo});
      break;
    case Layout::kRig:
      expect(1, topics::kPanoramaHeadImageRaw.size(), "layout rig has one to six heads");
      for (std::size_t i = 0; i < cameras; ++i) {
        roles.push_back({fmt::format("head_{}", i), fmt::format("panorama_head_{}_optical", i),
                         topics::kPanoramaHeadImageRaw.at(i), topics::kPanoramaHeadCameraInfo.at(i)});
      }
      break;
  }
  return roles;
}

}  // namespace panvo::camera_stream
