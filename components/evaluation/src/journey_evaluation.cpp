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

std::vector<ComparedRevisit> side_by_side(const JourneyReport& report) {
  std::vector<ComparedRevisit> compared;
  if (!report.paper_run) return compared;
  // Both list the same passes in the same order, except for passes closer together than the reach of a revisit.
  const auto& papers = report.paper_run->revisits.revisits;
  auto next = papers.begin();
  for (const auto& ours : report.run.revisits.revisits) {
    if (!ours.place) continue;
    const auto found =
        std::find_if(next, papers.end(), [&](const Revisit& revisit) { return revisit.place == ours.place; });
    if (found == papers.end()) continue;
    compared.push_back({&ours, &*found});
    next = std::next(found);
  }
  return compared;
}

RunEvaluation evaluate_run(const JourneyRun& run, const JourneyRecording& recording, const JourneyRecording* earlier) {
  const auto frames = journey_frames(run, recording, earlier);
  return {frames, score_revisits(frames), score_paths(frames), score_azimuth(frames), stage_rows(run.times)};
}

}  // namespace panvo::evaluation
