// SPDX-License-Identifier: Apache-2.0
#include "left_images.hpp"

#include <utility>

namespace panvo::evaluation {

std::vector<dataset_player::StereoFrame> left_images(const JourneyRecording& recording) {
  try {
    auto dataset = dataset_player::open_dataset(recording.folder);
    return dataset.stereo ? std::move(dataset.stereo->frames) : std::vector<dataset_player::StereoFrame>{};
  } catch (const dataset_player::DatasetError&) {
    return {};  // a run folder, or a trajectory
  }
}

}  // namespace panvo::evaluation
