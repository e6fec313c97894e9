// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "panvo/vision/camera.hpp"
#include "panvo/vision/image_pyramid.hpp"

namespace panvo::binocular_odometry {

/// Turn of a camera between two images, current_from_previous, to a fortieth of the image's width: the shift at which tiny versions of
/// both correlate best, up to 40 % of their size. For a jerk that no feature could be followed through; the motion's translation
/// is not looked at.
Eigen::Matrix3d coarse_turn(const vision::PinholeCamera& camera, const vision::ImagePyramid& previous,
                            const vision::ImagePyramid& current);

}  // namespace panvo::binocular_odometry
