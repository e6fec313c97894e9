// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::stereo_places {

/// Ranks places by their SIFT descriptors, without training. Random sums of a descriptor's values, whose signs form
/// keys of 16 bits, are compressive features of it: similar descriptors share one of eight keys with a probability that
/// falls steeply with their distance. A place scores for each key that it shares with the query, the more the fewer
/// places have it.
///
/// A place takes 16 bytes per keypoint. A query reads the keys of each place that is asked for: 3 microseconds for 300
/// keypoints.
class PlaceRanking {
 public:
  struct Ranked {
    std::uint32_t id = 0;
    double score = 0.0;
  };

  PlaceRanking();

  /// Adds a place. Throws std::invalid_argument if the id is taken.
  void add(std::uint32_t id, std::span<const landmarks::Keypoint> keypoints);

  /// The places with the highest scores above 0, at most `most`, among those whose id `is_asked` accepts; the best
  /// first, equal scores in order of ids.
  std::vector<Ranked> rank(std::span<const landmarks::Keypoint> query,
                           const std::function<bool(std::uint32_t)>& is_asked, std::size_t most) const;

  std::size_t size() const noexcept { return places_.size(); }

 private:
  static constexpr int kTables = 8;
  static constexpr int kBits = 16;
  static constexpr int kTerms = 32;  // values in a sum, half of them negative
  static constexpr std::size_t kKeys = std::size_t{1} << kBits;

  using Keys = std::array<std::uint16_t, kTables>;  // of one descriptor

  Keys keys_of(const landmarks::Keypoint& keypoint) const;

  std::array<std::array<std::uint8_t, kTerms>, kTables * kBits> terms_{};  // indices of descriptor values
  std::vector<std::uint16_t> places_with_key_;                             // tables x keys
  std::map<std::uint32_t, std::vector<Keys>> places_;
};

}  // namespace panvo::stereo_places
