// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "panvo/evaluation/journey_revisits.hpp"

namespace panvo::evaluation {

/// What happened on a drive as rows for the page: `RecordedDrive` in components/web_view/page/src/model/recorded_drive.ts,
/// without its pictures. Times in s since the first pose, positions in the map.
nlohmann::ordered_json drive_rows(const JourneyFrames& frames);

}  // namespace panvo::evaluation
