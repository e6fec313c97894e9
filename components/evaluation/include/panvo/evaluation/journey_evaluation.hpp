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

/// A stage of panvo and the corresponding line of the paper's Table 3. Further stages of the same line have no
/// `paper_ms`.
struct StageRow {
  std::string group, item;
  std::optional<double> paper_ms;
  std::optional<StageTime> ours;
};

/// All lines of Table 3, including those without a stage of panvo.
std::vector<StageRow> stage_rows(const StageTimes& times);

/// Results for one run.
struct RunEvaluation {
  JourneyFrames frames;
  RevisitScore revisits;
  PathScores paths;
  AzimuthScore azimuth;
  std::vector<StageRow> stages;
};

/// Throws InputError if run and recording do not belong together.
RunEvaluation evaluate_run(const JourneyRun& run, const JourneyRecording& recording, const JourneyRecording* earlier);

/// A journey, optionally with a second run that uses the paper's own correction.
struct JourneyReport {
  std::string title;
  RunEvaluation run;
  std::optional<RunEvaluation> paper_run;
  bool is_second_journey = false;  ///< true: compared with Table 4 of the paper, else with Table 2
};

/// A listed revisit in this run and in the run with the paper's own correction.
struct ComparedRevisit {
  const Revisit* ours = nullptr;
  const Revisit* papers = nullptr;
};
/// Empty without a `paper_run`.
std::vector<ComparedRevisit> side_by_side(const JourneyReport& report);

/// Text tables: Table 2 or 4, Table 3, trajectories and azimuths.
std::string journey_table(const JourneyReport& report);

/// journey.json: every figure, null if unknown, units in the names.
std::string journey_json(const JourneyReport& report);

/// Writes journey_paths.png, journey_error.png and journey_azimuth.png, and their gnuplot scripts, into `folder`.
/// Throws PlotError.
void draw_journey(const JourneyReport& report, const std::filesystem::path& folder);

}  // namespace panvo::evaluation
