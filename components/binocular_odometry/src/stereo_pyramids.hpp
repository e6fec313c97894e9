// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "panvo/vision/image_pyramid.hpp"

namespace panvo::binocular_odometry {

/// The images of a frame.
struct StereoPyramids {
  std::shared_ptr<const vision::ImagePyramid> left;  ///< shared with the tracks that it hosts
  vision::ImagePyramid right;
};

}  // namespace panvo::binocular_odometry
