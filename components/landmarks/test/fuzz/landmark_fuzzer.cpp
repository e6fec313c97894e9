// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: the lists of a landmark in store format, concatenated. They must be rejected by the rules, or be
// usable by a library and a matcher.
#include <span>

#include "landmark_rules.hpp"
#include "places.hpp"
#include "record_bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace panvo::landmarks;
  if (size < 4) return 0;
  std::span<const std::uint8_t> rest(data + 4, size - 4);
  const auto take = [&](std::uint8_t bytes, std::size_t each) {
    const auto part = rest.first(std::min(rest.size(), bytes * each));
    rest = rest.subspan(part.size());
    return part;
  };
  auto histogram = floats_from(take(data[0], 4));
  auto large = features_from(take(data[1], 14));
  auto small = features_from(take(data[2], 14));
  auto keypoints = keypoints_from(take(data[3], 145));
  if (!histogram || !large || !small || !keypoints) return 0;
  PanoramicLandmark landmark;
  landmark.id = 1;
  landmark.description = {std::move(*histogram), std::move(*large), std::move(*small)};
  landmark.keypoints = std::move(*keypoints);
  const bool is_valid = !problem_of(landmark, fuzz::here().settings);
  LandmarkLibrary library(nullptr, fuzz::here().describer.basis().limits());
  try {
    library.add(landmark);
  } catch (const std::invalid_argument&) {
    if (is_valid) std::abort();  // a landmark that passes the rules must be usable
    return 0;
  }
  if (is_valid) fuzz::compare(library.find(1)->description);
  return 0;
}
