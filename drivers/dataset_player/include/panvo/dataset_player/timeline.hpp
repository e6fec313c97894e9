// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "panvo/dataset_player/dataset.hpp"

namespace panvo::dataset_player {

/// An item of a data set to be published, and its time.
struct TimelineEvent {
  enum class Kind { kGroundTruth, kImu, kStereo, kPanorama };
  std::int64_t stamp_ns = 0;
  Kind kind = Kind::kStereo;
  std::size_t index = 0;  ///< into the data set's frames or poses of that kind
};

/// Part of a data set to play.
struct Selection {
  double start_s = 0.0;     ///< after the first image
  double duration_s = 0.0;  ///< 0: to the end
  bool stereo = true;
  bool panorama = true;
};

/// The selected images in order of time, with ground truth and inertial measurements from the last ones at or before the
/// first image to the first ones at or after the last. At equal stamps ground truth comes first, then inertial
/// measurements, then stereo. Throws DatasetError if no images are selected.
std::vector<TimelineEvent> timeline(const Dataset& dataset, const Selection& selection);

}  // namespace panvo::dataset_player
