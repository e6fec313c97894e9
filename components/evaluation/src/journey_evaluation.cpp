// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/journey_evaluation.hpp"

#include <algorithm>

#include "panvo/evaluation/paper_figures.hpp"

namespace panvo::evaluation {

std::vector<StageRow> stage_rows(const StageTimes& times) {
  std::vector<StageRow> rows;
  for (const auto& line : paper::table_3()) {
    const std::string group(line.group);
    const std::string item(line.item);
    bool is_first = true;
    for (const auto& stage : line.stages) {
      const auto found = std::find_if(times.begin(), times.end(), [&](const StageTime& time) {
        return time.component.starts_with(line.component) && time.stage == stage;
      });
      if (found == times.end()) continue;
      rows.push_back({group, item, is_first ? std::optional(line.time_ms) : std::nullopt, *found});
      is_first = false;
    }
    if (is_first) rows.push_back({group, item, line.time_ms, std::nullopt});
  }
  return rows;
}

RunEvaluation evaluate_run(const JourneyRun& run, const JourneyRecording& recording, const JourneyRecording* earlier) {
  const auto frames = journey_frames(run, recording, earlier);
  return {frames, score_revisits(frames), score_paths(frames), score_azimuth(frames), stage_rows(run.times)};
}

}  // namespace panvo::evaluation
