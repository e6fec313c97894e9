// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "panvo/landmark_builder/road_junction_detector.hpp"

/// Pictures of the detector's steps, 8UC3, for inspection. `scale` enlarges by whole pixels.
namespace panvo::landmark_builder {

/// Bird's-eye view, ahead is up. The vehicle body is darkened; the training area of the road model has a yellow border.
cv::Mat draw_birds_eye(const JunctionView& view, int scale = 2);

/// Log ratio of road per pixel: green road, red not road, black neither.
cv::Mat draw_road_ratio(const JunctionView& view, int scale = 2);

/// The road mask, grey; its passable region, white; the vehicle, blue; the centre and the arms, or the lines of the
/// Radon field's maxima.
cv::Mat draw_road(const JunctionView& view, double resolution_m, int scale = 2);

/// The Radon field of the passable region with its maxima [Lu2015 4.1]: direction to the right over half a turn, offset
/// down.
cv::Mat draw_radon(const JunctionView& view, int height_px);

/// The field along half-lines around the best centre: direction to the right over the full turn, counter-clockwise from
/// "up"; height is the reach of the road; the horizontal line is an arm's length.
cv::Mat draw_ray_radon(const JunctionView& view, double arm_length_m, int height_px);

/// All pictures side by side.
cv::Mat draw_junction_view(const JunctionView& view, const JunctionDetectorParameters& parameters, int scale = 2);

}  // namespace panvo::landmark_builder
