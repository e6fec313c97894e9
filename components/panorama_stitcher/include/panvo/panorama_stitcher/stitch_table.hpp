// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "panvo/panorama_stitcher/panorama_rig.hpp"

namespace panvo::panorama_stitcher {

inline constexpr std::uint8_t kNoHead = 255;

/// Where each pixel of a panorama comes from: packed look-ups, run by run, in tiles, so that what is read of the heads' images lies
/// together in whatever way a head is turned. Four bytes a pixel and head, one more for the weight where two heads are blended.
struct StitchTable {
  /// Neighbouring pixels of a row that come from the same heads.
  struct Run {
    std::uint32_t destination_px = 0;  ///< offset of the first pixel
    std::uint32_t count = 0;
    std::uint8_t first = kNoHead;                         ///< none: black
    std::uint8_t second = kNoHead;                        ///< blended with the first; none: the first alone
    std::uint32_t first_base_px = 0, second_base_px = 0;  ///< where in their images their look-ups count from
    std::uint32_t lookups = 0;                            ///< index of the first's; the second's follow
    std::uint32_t weights = 0;                            ///< index of the second's weights
  };
  /// A pixel whose four neighbours do not lie side by side: where an equirectangular image closes, or at the end of an image.
  struct Patch {
    std::uint32_t destination_px = 0;
    std::uint8_t head = kNoHead;
    std::uint8_t across = 0, down = 0;             ///< 1/32 px
    std::array<std::uint32_t, 4> neighbours_px{};  ///< offsets: upper left, upper right, lower left, lower right
  };
  /// Two heads' pixels that show the same.
  struct Sample {
    std::uint8_t first = kNoHead, second = kNoHead;
    std::uint32_t first_px = 0, second_px = 0;
  };
  /// Directions that no head sees, although one should.
  struct Gap {
    double share = 0.0;                             ///< of the solid angle that must be seen
    double azimuth_rad = 0.0, elevation_rad = 0.0;  ///< one of them, that nearest to the horizon; downwards positive
  };

  int columns = 0, rows = 0;
  std::vector<Run> runs;
  std::vector<std::uint32_t> lookups;
  std::vector<std::uint8_t> weights;
  std::vector<Patch> patches;
  std::vector<Sample> samples;
  std::optional<Gap> gap;
};

/// The table of a panorama of `columns` x `columns` / 2 px. Of the heads that `is_used`, the one that sees a direction farthest from its
/// border shows it; within blend_rad about the seam it is blended with the second. `heads` up to 254.
StitchTable make_stitch_table(const PanoramaRig& rig, int columns, const std::vector<bool>& is_used);

}  // namespace panvo::panorama_stitcher
