// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <variant>

#include "panvo/localizer/localizer.hpp"

namespace panvo::localizer {

/// A landmark that was built on this journey.
struct Built {
  std::uint32_t id = 0;
  std::int64_t stamp_ns = 0;
};

using PanoramaFact = std::variant<AzimuthMeasurement, LandmarkSighting, Built>;

/// The stamp of the panorama that it is about.
std::int64_t stamp_of(const PanoramaFact& fact);

/// What is said of panoramas waits until odometry has come as far as their stamps. First in, first out, but one of a time far ahead keeps none
/// waiting.
class PanoramaQueue {
 public:
  /// False when it is full: the oldest was dropped.
  bool push(const PanoramaFact& fact);
  /// The next that need not wait, taken out.
  std::optional<PanoramaFact> next(const Localizer& localizer);

 private:
  static constexpr std::size_t kMost = 100;
  static constexpr std::int64_t kFarAhead_ns = 2'000'000'000;

  std::deque<PanoramaFact> waiting_;
};

}  // namespace panvo::localizer
