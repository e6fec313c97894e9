// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "panvo/evaluation/journey_evaluation.hpp"

namespace panvo::evaluation {

/// Writes a video of the drive, `speed` times as fast as it was: a plan on which both trajectories grow, the left image,
/// the panorama, the place recognised last, state and errors. Needs the program ffmpeg. Throws PlotError (ffmpeg is
/// missing or failed) and InputError (images that cannot be decoded).
void write_video(const RunEvaluation& run, const std::filesystem::path& file, double speed);

}  // namespace panvo::evaluation
