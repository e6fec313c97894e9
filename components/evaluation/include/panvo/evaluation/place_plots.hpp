// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "panvo/evaluation/place_table.hpp"

namespace panvo::evaluation {

/// Distance D of one method along a pass by a known place [Lu2015 Fig. 7].
struct LocalCurve {
  std::string method;
  std::vector<double> way_m;     ///< distance travelled from the panorama nearest to the known one; negative: before it
  std::vector<double> distance;  ///< normalised: 0 the smallest, 1 the largest
};

/// Curves over the panoramas within `reach_m` before and after a revisit.
std::vector<LocalCurve> local_curves(const std::vector<const PlaceMethod*>& methods, const PlaceTask& task,
                                     const PlaceRevisit& revisit, const PlaceRecording& first,
                                     const PlaceRecording& then, double reach_m);

/// Writes separation.png into `folder`: each method's positives and negatives [Lu2015 Fig. 6]. Throws PlotError.
void draw_separation(const std::vector<PlaceScore>& scores, const std::filesystem::path& folder);

/// Writes local_NUMBER.png into `folder` [Lu2015 Fig. 7]. Throws PlotError.
void draw_local_curves(const std::vector<LocalCurve>& curves, const std::string& title, int number,
                       const std::filesystem::path& folder);

}  // namespace panvo::evaluation
