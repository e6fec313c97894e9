// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "panvo/evaluation/journey_revisits.hpp"

namespace panvo::evaluation {

/// Left images and panoramas along the drive, evenly over time, as base64 JPEG with their times:
/// {"left": [[time, jpeg], ...], "panorama": ...}. None if the recording has none. Throws InputError for an invalid
/// image.
nlohmann::ordered_json drive_pictures(const JourneyFrames& frames);

/// A small JPEG of the panorama of that stamp, in this or the earlier recording; empty if there is none.
std::string thumbnail(const JourneyFrames& frames, std::int64_t stamp_ns);

}  // namespace panvo::evaluation
