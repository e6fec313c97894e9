// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "panvo/landmarks/panoramic_landmark.hpp"

/// The lists of a landmark as bytes, for the store: little-endian, without gaps, exact to the last bit. Reading gives
/// nullopt for bytes that are none of this: a length that does not fit, a number that is none.
namespace panvo::landmarks {

using Bytes = std::vector<std::uint8_t>;

/// 4 bytes a value.
Bytes to_bytes(std::span<const float> values);
std::optional<std::vector<float>> floats_from(std::span<const std::uint8_t> bytes);

/// 8 bytes a value.
Bytes to_bytes(std::span<const double> values);
std::optional<std::vector<double>> doubles_from(std::span<const std::uint8_t> bytes);

/// 14 bytes a feature: row, value, scale, weight.
Bytes to_bytes(std::span<const AdaptiveFeature> features);
std::optional<std::vector<AdaptiveFeature>> features_from(std::span<const std::uint8_t> bytes);

/// 145 bytes a keypoint, 161 with a point: bearing, size, descriptor, whether there is a point, then it and its sigma.
Bytes to_bytes(std::span<const Keypoint> keypoints);
std::optional<std::vector<Keypoint>> keypoints_from(std::span<const std::uint8_t> bytes);

}  // namespace panvo::landmarks
