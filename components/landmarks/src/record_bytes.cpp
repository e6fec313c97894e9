// SPDX-License-Identifier: Apache-2.0
#include "record_bytes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <type_traits>

namespace panvo::landmarks {
namespace {

template <std::size_t Size>
using Unsigned = std::conditional_t<
    Size == 1, std::uint8_t,
    std::conditional_t<Size == 2, std::uint16_t, std::conditional_t<Size == 4, std::uint32_t, std::uint64_t>>>;

template <class Number>
void put(Bytes& bytes, Number number) {
  const auto bits = std::bit_cast<Unsigned<sizeof(Number)>>(number);
  for (std::size_t i = 0; i < sizeof(Number); ++i) bytes.push_back(static_cast<std::uint8_t>(bits >> (8 * i)));
}

/// Reads numbers from the front; records whether bytes were missing or a number was not finite.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  template <class Number>
  Number take() {
    if (!has(sizeof(Number))) {
      fail();
      return Number{};
    }
    Unsigned<sizeof(Number)> bits = 0;
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
      bits = static_cast<decltype(bits)>(bits | static_cast<decltype(bits)>(bytes_[i]) << (8 * i));
    }
    bytes_ = bytes_.subspan(sizeof(Number));
    const auto number = std::bit_cast<Number>(bits);
    if constexpr (std::is_floating_point_v<Number>) is_good_ = is_good_ && std::isfinite(number);
    return number;
  }
  Eigen::Vector3f take_vector() {
    const float x = take<float>();
    const float y = take<float>();
    return {x, y, take<float>()};
  }
  void take_bytes(std::span<std::uint8_t> into) {
    if (!has(into.size())) return fail();
    std::copy_n(bytes_.begin(), into.size(), into.begin());
    bytes_ = bytes_.subspan(into.size());
  }

  bool at_end() const noexcept { return bytes_.empty(); }
  bool is_good() const noexcept { return is_good_; }

 private:
  bool has(std::size_t count) const { return is_good_ && bytes_.size() >= count; }
  void fail() {
    is_good_ = false;
    bytes_ = {};
  }

  std::span<const std::uint8_t> bytes_;
  bool is_good_ = true;
};

/// Reads values until the bytes are used up.
template <class Value, class Take>
std::optional<std::vector<Value>> read_all(std::span<const std::uint8_t> bytes, std::size_t bytes_each, Take take) {
  std::vector<Value> values;
  values.reserve(bytes.size() / bytes_each);
  Reader reader(bytes);
  while (!reader.at_end()) {
    values.push_back(take(reader));
    if (!reader.is_good()) return std::nullopt;
  }
  return values;
}

AdaptiveFeature take_feature(Reader& reader) {
  AdaptiveFeature feature;
  feature.row = reader.take<std::uint16_t>();
  feature.value = reader.take<float>();
  feature.scale = reader.take<float>();
  feature.weight = reader.take<float>();
  return feature;
}

void put(Bytes& bytes, const Eigen::Vector3f& vector) {
  for (const float value : vector) put(bytes, value);
}

Keypoint take_keypoint(Reader& reader) {
  Keypoint keypoint;
  keypoint.bearing = reader.take_vector();
  keypoint.size_px = reader.take<float>();
  reader.take_bytes(keypoint.descriptor);
  keypoint.has_point = reader.take<std::uint8_t>() != 0;
  if (keypoint.has_point) {
    keypoint.point_in_panorama = reader.take_vector();
    keypoint.inverse_range_sigma = reader.take<float>();
  }
  return keypoint;
}

template <class Number>
Bytes numbers_to_bytes(std::span<const Number> values) {
  Bytes bytes;
  bytes.reserve(values.size_bytes());
  for (const Number value : values) put(bytes, value);
  return bytes;
}

template <class Number>
std::optional<std::vector<Number>> numbers_from(std::span<const std::uint8_t> bytes) {
  return read_all<Number>(bytes, sizeof(Number), [](Reader& reader) { return reader.take<Number>(); });
}

}  // namespace

Bytes to_bytes(std::span<const float> values) { return numbers_to_bytes(values); }
Bytes to_bytes(std::span<const double> values) { return numbers_to_bytes(values); }
std::optional<std::vector<float>> floats_from(std::span<const std::uint8_t> bytes) {
  return numbers_from<float>(bytes);
}
std::optional<std::vector<double>> doubles_from(std::span<const std::uint8_t> bytes) {
  return numbers_from<double>(bytes);
}

Bytes to_bytes(std::span<const AdaptiveFeature> features) {
  Bytes bytes;
  bytes.reserve(features.size() * 14);
  for (const auto& feature : features) {
    put(bytes, feature.row);
    put(bytes, feature.value);
    put(bytes, feature.scale);
    put(bytes, feature.weight);
  }
  return bytes;
}

std::optional<std::vector<AdaptiveFeature>> features_from(std::span<const std::uint8_t> bytes) {
  return read_all<AdaptiveFeature>(bytes, 14, take_feature);
}

Bytes to_bytes(std::span<const Keypoint> keypoints) {
  Bytes bytes;
  bytes.reserve(keypoints.size() * 161);
  for (const auto& keypoint : keypoints) {
    put(bytes, keypoint.bearing);
    put(bytes, keypoint.size_px);
    bytes.insert(bytes.end(), keypoint.descriptor.begin(), keypoint.descriptor.end());
    put(bytes, static_cast<std::uint8_t>(keypoint.has_point));
    if (!keypoint.has_point) continue;
    put(bytes, keypoint.point_in_panorama);
    put(bytes, keypoint.inverse_range_sigma);
  }
  return bytes;
}

std::optional<std::vector<Keypoint>> keypoints_from(std::span<const std::uint8_t> bytes) {
  return read_all<Keypoint>(bytes, 145, take_keypoint);
}

}  // namespace panvo::landmarks
