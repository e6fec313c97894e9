// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "panvo/dataset_player/dataset.hpp"

namespace panvo::dataset_player {

/// Something of a data set that is to be published, and when.
struct TimelineEvent {
  enum class Kind { kGroundTruth, kStereo, kPanorama };
  std::int64_t stamp_ns = 0;
  Kind kind = Kind::kStereo;
  std::size_t index = 0;  ///< into the data set's frames or poses of that kind
};

/// Which part of a data set is played, and what of it.
struct Selection {
  double start_s = 0.0;     ///< after the first image
  double duration_s = 0.0;  ///< 0: to the end
  bool stereo = true;
  bool panorama = true;
};

/// The selected images in order of time, and the ground truth from the last pose before the first of them to the
/// first pose after the last. At equal stamps ground truth comes first, then stereo. Throws DatasetError when no
/// image is left.
std::vector<TimelineEvent> timeline(const Dataset& dataset, const Selection& selection);

}  // namespace panvo::dataset_player
