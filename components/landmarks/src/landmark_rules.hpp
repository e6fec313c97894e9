// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "panvo/landmarks/description_settings.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"

/// What a landmark may hold, by the rules of its message: for those that come from a file, or go there. nullopt: nothing is wrong; else what is, as
/// "large_features.row is beyond the rows of the measurement matrix".
namespace panvo::landmarks {

/// `settings`: what it was described with. Keypoints are looked at where there are some.
std::optional<std::string> problem_of(const PanoramicLandmark& landmark, const DescriptionSettings& settings);

std::optional<std::string> problem_of_pose(const Eigen::Isometry3d& map_from_base,
                                           const Eigen::Matrix<double, 6, 6>& covariance);

std::optional<std::string> problem_of(const std::vector<Keypoint>& keypoints);

}  // namespace panvo::landmarks
