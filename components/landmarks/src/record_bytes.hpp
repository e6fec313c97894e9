// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "panvo/landmarks/panoramic_landmark.hpp"

/// Serialisation of a landmark's lists for the store: little-endian, packed, lossless. Reading returns nullopt if the
/// length does not fit or a number is not finite.
namespace panvo::landmarks {

using Bytes = std::vector<std::uint8_t>;

/// 4 bytes per value.
Bytes to_bytes(std::span<const float> values);
std::optional<std::vector<float>> floats_from(std::span<const std::uint8_t> bytes);

/// 8 bytes per value.
Bytes to_bytes(std::span<const double> values);
std::optional<std::vector<double>> doubles_from(std::span<const std::uint8_t> bytes);

/// 14 bytes per feature: row, value, scale, weight.
Bytes to_bytes(std::span<const AdaptiveFeature> features);
std::optional<std::vector<AdaptiveFeature>> features_from(std::span<const std::uint8_t> bytes);

/// 145 bytes per keypoint, 161 with a point: bearing, size, descriptor, whether there is a point, the point and its
/// sigma.
Bytes to_bytes(std::span<const Keypoint> keypoints);
std::optional<std::vector<Keypoint>> keypoints_from(std::span<const std::uint8_t> bytes);

}  // namespace panvo::landmarks
