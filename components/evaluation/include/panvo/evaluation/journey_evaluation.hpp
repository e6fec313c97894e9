// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "panvo/evaluation/journey_azimuth.hpp"
#include "panvo/evaluation/journey_paths.hpp"
#include "panvo/evaluation/journey_revisits.hpp"
#include "panvo/evaluation/timing.hpp"

namespace panvo::evaluation {

/// A stage of ours beside the paper's line of Table 3; without a paper's time: a stage that is not in it.
struct StageRow {
  std::string group, item;
  std::optional<double> paper_ms;
  std::optional<StageTime> ours;
};

/// All lines of Table 3, those without a stage of ours too.
std::vector<StageRow> stage_rows(const StageTimes& times);

/// All that is said about one run.
struct RunEvaluation {
  JourneyFrames frames;
  RevisitScore revisits;
  PathScores paths;
  AzimuthScore azimuth;
  std::vector<StageRow> stages;
};

/// Throws InputError where run and recording do not belong together.
RunEvaluation evaluate_run(const JourneyRun& run, const JourneyRecording& recording, const JourneyRecording* earlier);

/// The journey, and with it the same journey with the paper's own correction, where that was run.
struct JourneyReport {
  std::string title;
  RunEvaluation run;
  std::optional<RunEvaluation> paper_run;
  bool is_second_journey = false;  ///< Table 4 is its match in the paper, else Table 2
};

/// A listed revisit as this run and as the paper's own correction took it. Empty without a `paper_run`.
struct ComparedRevisit {
  const Revisit* ours = nullptr;
  const Revisit* papers = nullptr;
};
std::vector<ComparedRevisit> side_by_side(const JourneyReport& report);

/// Tables 2 or 4, 3, the paths and the azimuths, for people.
std::string journey_table(const JourneyReport& report);

/// journey.json: every figure, null for what is not known, units in the names.
std::string journey_json(const JourneyReport& report);

/// Writes journey_paths.png, journey_error.png and journey_azimuth.png, and what draws them, into `folder`. Throws PlotError.
void draw_journey(const JourneyReport& report, const std::filesystem::path& folder);

}  // namespace panvo::evaluation
