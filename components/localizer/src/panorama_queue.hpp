// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <variant>

#include "panvo/localizer/localizer.hpp"

namespace panvo::localizer {

/// A landmark built on this journey.
struct Built {
  std::uint32_t id = 0;
  std::int64_t stamp_ns = 0;
};

using PanoramaFact = std::variant<AzimuthMeasurement, LandmarkSighting, Built>;

/// Stamp of the panorama concerned.
std::int64_t stamp_of(const PanoramaFact& fact);

/// Queue of panorama measurements until odometry reaches their stamps. First in, first out, but a stamp far ahead does
/// not block the others.
class PanoramaQueue {
 public:
  /// Returns false if the queue was full and the oldest entry was dropped.
  bool push(const PanoramaFact& fact);
  /// Removes and returns the next entry that need not wait.
  std::optional<PanoramaFact> next(const Localizer& localizer);
  void clear() { waiting_.clear(); }

 private:
  static constexpr std::size_t kMaxWaiting = 100;
  static constexpr std::int64_t kFarAhead_ns = 2'000'000'000;

  std::deque<PanoramaFact> waiting_;
};

}  // namespace panvo::localizer
