// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "panvo/landmark_builder/road_junction_detector.hpp"

/// Pictures of what the detector saw, 8UC3, for people. `scale` enlarges by whole pixels.
namespace panvo::landmark_builder {

/// The ground from above, ahead is up; the vehicle's own body is darkened, what was learned from has a yellow border.
cv::Mat draw_birds_eye(const JunctionView& view, int scale = 2);

/// How much each pixel of it looks like road: green road, red not, black neither.
cv::Mat draw_road_ratio(const JunctionView& view, int scale = 2);

/// The road that is judged, grey; its passable region, white; the vehicle, blue; the centre and the arms, or the lines of the
/// Radon field's maxima.
cv::Mat draw_road(const JunctionView& view, double resolution_m, int scale = 2);

/// The Radon field of the passable region with its maxima [Lu2015 4.1]: direction to the right over half a turn, offset downward.
cv::Mat draw_radon(const JunctionView& view, int height_px);

/// The field along half-lines about the best centre: direction to the right over the full turn, counter-clockwise from the
/// picture's "up"; height is how far road reaches; the line is an arm's length.
cv::Mat draw_ray_radon(const JunctionView& view, double arm_length_m, int height_px);

/// All of them side by side.
cv::Mat draw_junction_view(const JunctionView& view, const JunctionDetectorParameters& parameters, int scale = 2);

}  // namespace panvo::landmark_builder
