// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "panvo/landmarks/description_settings.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"

/// Validity rules of landmarks, equal to those of their message, for reading and writing files. nullopt if valid; else
/// the violated rule, e.g. "large_features.row is not a row of the measurement matrix".
namespace panvo::landmarks {

/// `settings`: those the landmark was described with. Keypoints are checked if present.
std::optional<std::string> problem_of(const PanoramicLandmark& landmark, const DescriptionSettings& settings);

std::optional<std::string> problem_of_pose(const Eigen::Isometry3d& map_from_base,
                                           const Eigen::Matrix<double, 6, 6>& covariance);

std::optional<std::string> problem_of(const std::vector<Keypoint>& keypoints);

}  // namespace panvo::landmarks
