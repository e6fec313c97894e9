// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "panvo/dataset_player/dataset.hpp"
#include "panvo/evaluation/journey_recording.hpp"

namespace panvo::evaluation {

/// The stereo images of the recording, in order of time; none if it has none.
std::vector<dataset_player::StereoFrame> left_images(const JourneyRecording& recording);

}  // namespace panvo::evaluation
