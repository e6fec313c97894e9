// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "panvo/panorama_stitcher/panorama_rig.hpp"

namespace panvo::panorama_stitcher {

inline constexpr std::uint8_t kNoHead = 255;

/// Source of each panorama pixel, as runs of packed look-ups. Runs are ordered in tiles, so that reads from the heads'
/// images are local for any orientation of a head. Four bytes per pixel and head, plus one for the weight of a blended
/// pixel.
struct StitchTable {
  /// Adjacent pixels of a row with the same source heads.
  struct Run {
    std::uint32_t destination_px = 0;  ///< offset of the first pixel
    std::uint32_t count = 0;
    std::uint8_t first = kNoHead;                         ///< kNoHead: black
    std::uint8_t second = kNoHead;                        ///< blended with the first; kNoHead: first only
    std::uint32_t first_base_px = 0, second_base_px = 0;  ///< base offsets of the look-ups in the images
    std::uint32_t lookups = 0;                            ///< index of the first head's look-ups; the second's follow
    std::uint32_t weights = 0;                            ///< index of the second head's weights
  };
  /// A pixel whose four source neighbours are not adjacent: at the wrap-around of an equirectangular image or at an
  /// image border.
  struct Patch {
    std::uint32_t destination_px = 0;
    std::uint8_t head = kNoHead;
    std::uint8_t across = 0, down = 0;             ///< 1/32 px
    std::array<std::uint32_t, 4> neighbours_px{};  ///< offsets: upper left, upper right, lower left, lower right
  };
  /// Pixels of two heads that show the same direction.
  struct Sample {
    std::uint8_t first = kNoHead, second = kNoHead;
    std::uint32_t first_px = 0, second_px = 0;
  };
  /// Required directions that no head sees.
  struct Gap {
    double share = 0.0;                             ///< fraction of the required solid angle
    double azimuth_rad = 0.0, elevation_rad = 0.0;  ///< the one nearest to the horizon; downwards positive
  };

  int columns = 0, rows = 0;
  std::vector<Run> runs;
  std::vector<std::uint32_t> lookups;
  std::vector<std::uint8_t> weights;
  std::vector<Patch> patches;
  std::vector<Sample> samples;
  std::optional<Gap> gap;
};

/// Computes the table of a panorama of `columns` x `columns` / 2 px. Each direction uses the head in `is_used` that
/// sees it farthest from its border, blended with the second one within blend_rad around the seam. Supports up to 254
/// heads.
StitchTable make_stitch_table(const PanoramaRig& rig, int columns, const std::vector<bool>& is_used);

}  // namespace panvo::panorama_stitcher
