// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "panvo/landmarks/panorama_describer.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::landmarks {

struct IndexedFeature;

/// Compares a query with all landmarks of a large library at the large scale, at all headings: the distance of
/// match_large_scale within 0.03, in integers of 16 bits, 8 bytes per feature. Ranks only: the few most similar ones
/// are to be compared by match_large_scale.
class LargeScaleIndex {
 public:
  LargeScaleIndex();
  ~LargeScaleIndex();
  LargeScaleIndex(LargeScaleIndex&&) noexcept;
  LargeScaleIndex& operator=(LargeScaleIndex&&) noexcept;

  /// Adds the next landmark. Ids need no order.
  void add(std::uint32_t id, const PanoramaDescription& description);

  /// Whether a landmark takes part.
  using Asked = std::function<bool(std::uint32_t id)>;

  struct Ranked {
    std::uint32_t id = 0;
    float distance = 1.0F;
  };
  struct Ranking {
    std::vector<Ranked> nearest;  ///< at most `count`, in order of distance, then of id
    std::size_t asked = 0;        ///< landmarks that took part
  };
  /// The query must have the basis of the landmarks' descriptions.
  Ranking rank(const QueryDescription& query, std::size_t count, const Asked& is_asked) const;

 private:
  class Features;
  struct Entry;
  std::vector<Entry> entries_;
  std::unique_ptr<Features> heavy_, rest_;  // of all entries
};

}  // namespace panvo::landmarks
