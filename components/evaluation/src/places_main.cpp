// SPDX-License-Identifier: Apache-2.0
// panvo_evaluate_places: evaluates place recognition on a recording with known revisits.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "panvo/evaluation/brief_gist.hpp"
#include "panvo/evaluation/compressive_places.hpp"
#include "panvo/evaluation/cyclic_brief_gist.hpp"
#include "panvo/evaluation/folder_places.hpp"
#include "panvo/evaluation/fourier_signature.hpp"
#include "panvo/evaluation/histogram_places.hpp"
#include "panvo/evaluation/input_error.hpp"
#include "panvo/evaluation/output_file.hpp"
#include "panvo/evaluation/place_journey.hpp"
#include "panvo/evaluation/place_plots.hpp"
#include "panvo/evaluation/place_table.hpp"
#include "panvo/evaluation/plot.hpp"

namespace {

namespace fs = std::filesystem;
using namespace panvo::evaluation;

enum ExitStatus { kSuccess = 0, kFailed = 1, kUsage = 2, kNoPlot = 3 };

constexpr double kDegrees = 180.0 / std::numbers::pi;

struct Arguments {
  std::string recording;
  std::string library_from;
  std::string out = "places";
  std::uint64_t seed = 1;
  double position_sigma_m = -1.0;
  bool only_table = false;
  bool only_journey = false;
  int curves = 3;
  double same_place_m = 15.0;
  std::string poses;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.add_option("recording", arguments.recording,
                 "EuRoC/ASL data set with cam2, ground truth and sequence.yaml; or a plain folder of panoramas with "
                 "poses or places.csv")
      ->required();
  app.add_option("--library-from", arguments.library_from,
                 "earlier recording of the same area, from which the library is built");
  app.add_option("--out", arguments.out, "folder for tables and pictures")->capture_default_str();
  app.add_option("--seed", arguments.seed, "random seed of the measurement matrices")->capture_default_str();
  app.add_option("--position-sigma", arguments.position_sigma_m,
                 "give the matcher the position with this standard deviation, m; negative: search the whole library")
      ->capture_default_str();
  app.add_option("--same-place", arguments.same_place_m, "distance within which two panoramas show the same place, m")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  app.add_option("--poses", arguments.poses,
                 "plain folder: poses, as for panvo places build (default: poses.csv or poses.txt in the folder)");
  app.add_option("--curves", arguments.curves, "maximum number of plots of distances along a pass (Fig. 7)")
      ->capture_default_str();
  auto* table = app.add_flag("--only-table", arguments.only_table,
                             "only Table 1 and its plots, without matching the whole journey");
  app.add_flag("--only-journey", arguments.only_journey,
               "only match the whole journey, without Table 1 and plots; places of an earlier recording need not occur")
      ->excludes(table);
}

std::vector<std::unique_ptr<PlaceMethod>> all_methods(std::uint64_t seed) {
  std::vector<std::unique_ptr<PlaceMethod>> methods;
  methods.push_back(brief_gist(seed));
  methods.push_back(cyclic_brief_gist(seed));
  methods.push_back(fourier_signature());
  methods.push_back(histogram_places({}));
  for (const auto scale : {FeatureScale::kLarge, FeatureScale::kSmall}) {
    for (const auto selection : {FeatureSelection::kPlain, FeatureSelection::kAdaptive}) {
      methods.push_back(compressive_places(scale, selection, {}, seed));
    }
  }
  return methods;
}

void print_journey(const JourneyScore& score, const PlaceTask& task, const PlaceRecording& then) {
  std::cout << "\nMatches of all panoramas of the journey:\n"
            << fmt::format("{:>7} {:>6} {:>9} {:>9} {:>9} {:>9} {:>6} {:>6}\n", "place", "", "after (m)", "offset",
                           "error", "heading", "D_l", "D_s");
  for (const auto& match : score.matches) {
    std::cout << fmt::format("{:>7} {:>6} {:>9.1f} {:>7.2f} m {:>7.2f} m {:>5.2f} deg {:>6.2f} {:>6.2f}\n",
                             task.places[match.known].place, match.is_right ? "right" : "WRONG",
                             then.panoramas[match.panorama].travelled_m, match.offset_m, match.position_error_m,
                             match.heading_error_rad * kDegrees, match.match.large_distance,
                             match.match.small_distance);
  }
  for (std::size_t i = 0; i < task.revisits.size(); ++i) {
    if (score.found[i]) continue;
    const auto& revisit = task.revisits[i];
    std::cout << fmt::format("{:>7} missed {:>8.1f} {:>7.2f} m, entrance {:+.0f} deg\n",
                             task.places[revisit.known].place, then.panoramas[revisit.panorama].travelled_m,
                             revisit.offset_m, revisit.entrance_rad * kDegrees);
  }
  const auto found = std::count(score.found.begin(), score.found.end(), true);
  std::cout << fmt::format("revisits found {} of {}, wrong matches {}\n", found, task.revisits.size(), score.wrong);
}

void warn_skipped(const std::string& problem) { std::cerr << problem << ": skipped\n"; }

nlohmann::json json_of(const std::vector<FolderScore>& scores) {
  auto json = nlohmann::json::array();
  for (const auto& score : scores) {
    json.push_back({{"method", score.method},
                    {"known", score.known},
                    {"unknown", score.unknown},
                    {"right_first", score.right_first},
                    {"right_at_full_precision", score.right_at_full_precision}});
    if (score.answers_unknown) json.back().update({{"right", score.right}, {"wrong", score.wrong}});
    const auto& errors = score.heading_errors_rad;
    if (!errors.empty()) json.back()["median_heading_error_deg"] = errors[(errors.size() - 1) / 2] * kDegrees;
  }
  return json;
}

/// A plain folder: places by labels or poses, and the baselines beside `panvo places`.
int run_folder(const Arguments& arguments) {
  const auto folder = read_folder_panoramas(arguments.recording, arguments.poses, {}, warn_skipped);
  std::vector<FolderPanorama> earlier;
  if (!arguments.library_from.empty()) earlier = read_folder_panoramas(arguments.library_from, {}, {}, warn_skipped);
  const auto task = folder_task(folder, earlier.empty() ? nullptr : &earlier, arguments.same_place_m);
  if (task.queries.empty()) {
    throw InputError(arguments.recording, "shows no place twice",
                     "name an earlier folder of the same places with --library-from");
  }
  std::vector<FolderScore> scores;
  for (const auto& method : all_methods(arguments.seed)) scores.push_back(score_folder(*method, task));
  scores.push_back(score_folder(panvo::places::PlaceFinderParameters{}, task));
  std::cout << fmt::format("{} places, {} panoramas to recognise, of which {} show no known place\n\n",
                           task.library.size(), task.queries.size(), scores.back().unknown)
            << folder_table(scores);
  fs::create_directories(arguments.out);
  const nlohmann::json json{
      {"places", task.library.size()}, {"queries", task.queries.size()}, {"methods", json_of(scores)}};
  write_output(fs::path(arguments.out) / "places.json", json.dump(2) + '\n');
  return kSuccess;
}

nlohmann::json json_of(const std::vector<PlaceScore>& scores, const std::optional<JourneyScore>& journey,
                       const PlaceTask& task, std::size_t panoramas) {
  nlohmann::json json;
  json["places"] = task.places.size();
  json["revisits"] = task.revisits.size();
  json["panoramas"] = panoramas;
  for (const auto& score : scores) {
    json["methods"].push_back({{"method", score.method},
                               {"v_sc", score.separation},
                               {"true_positives", score.true_positives},
                               {"false_positives", score.false_positives},
                               {"recall", score.recall},
                               {"precision", score.precision},
                               {"recall_at_full_precision", score.recall_at_full_precision},
                               {"median_heading_error_deg", score.median_heading_error_rad * kDegrees}});
  }
  if (journey) {
    json["journey"] = {{"found", std::count(journey->found.begin(), journey->found.end(), true)},
                       {"wrong", journey->wrong},
                       {"matches", nlohmann::json::array()}};
    for (const auto& match : journey->matches) {
      json["journey"]["matches"].push_back({{"place", task.places[match.known].place},
                                            {"stamp_ns", match.match.stamp_ns},
                                            {"right", match.is_right},
                                            {"offset_m", match.offset_m},
                                            {"position_error_m", match.position_error_m},
                                            {"heading_deg", match.match.heading_rad * kDegrees},
                                            {"heading_error_deg", match.heading_error_rad * kDegrees}});
    }
  }
  return json;
}

int run(const Arguments& arguments) {
  if (fs::is_directory(arguments.recording) && !fs::exists(fs::path(arguments.recording) / "mav0"))
    return run_folder(arguments);
  auto recording = read_place_recording(arguments.recording);
  drop_unreadable(recording, warn_skipped);
  std::optional<PlaceRecording> earlier;
  if (!arguments.library_from.empty()) {
    earlier = read_place_recording(arguments.library_from);
    drop_unreadable(*earlier, warn_skipped);
  }
  const auto& first = earlier ? *earlier : recording;
  const auto task = place_task(first, earlier ? &recording : nullptr);
  if (task.revisits.empty() && !(earlier && arguments.only_journey)) {
    throw InputError(recording.folder / "sequence.yaml", "lists no revisits",
                     "use a recording with revisits, or name an earlier one of the same area with --library-from");
  }
  std::cout << fmt::format("{} places, {} revisits, {} panoramas\n\n", task.places.size(), task.revisits.size(),
                           recording.panoramas.size());

  std::vector<std::unique_ptr<PlaceMethod>> methods;
  std::vector<PlaceScore> scores;
  if (!arguments.only_journey) {
    methods = all_methods(arguments.seed);
    for (const auto& method : methods) scores.push_back(score_places(*method, task, first, recording));
    std::cout << place_table(scores) << std::flush;
  }

  std::optional<JourneyScore> journey;
  if (!arguments.only_table) {
    JourneySettings settings;
    settings.seed = arguments.seed;
    settings.same_place_m = arguments.same_place_m;
    if (arguments.position_sigma_m >= 0.0) settings.position_sigma_m = arguments.position_sigma_m;
    const bool is_terminal = isatty(STDERR_FILENO) != 0;
    journey = match_journey(task, first, recording, settings, [&](std::size_t i, std::size_t count) {
      if (is_terminal && i % 20 == 0) std::cerr << fmt::format("\r  panorama {} of {}", i, count) << std::flush;
    });
    if (is_terminal) std::cerr << "\r";
    print_journey(*journey, task, recording);
  }

  const fs::path out = arguments.out;
  fs::create_directories(out);
  write_output(out / "places.json", json_of(scores, journey, task, recording.panoramas.size()).dump(2) + '\n');
  if (arguments.only_journey) return kSuccess;
  draw_separation(scores, out);
  std::vector<const PlaceMethod*> compared;
  for (const auto& method : methods) compared.push_back(method.get());
  constexpr double kReach_m = 20.0;
  const auto curves =
      std::min<std::size_t>(task.revisits.size(), static_cast<std::size_t>(std::max(0, arguments.curves)));
  for (std::size_t i = 0; i < curves; ++i) {
    const auto& revisit = task.revisits[i];
    draw_local_curves(local_curves(compared, task, revisit, first, recording, kReach_m),
                      fmt::format("place {}, offset {:.1f} m, entrance {:+.0f} deg", task.places[revisit.known].place,
                                  revisit.offset_m, revisit.entrance_rad * kDegrees),
                      static_cast<int>(i + 1), out);
  }
  std::cout << fmt::format("\npictures and places.json: {}\n", out.string());
  return kSuccess;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app(
      "Evaluates place recognition on a recording with known revisits: Table 1, Figs. 6 and 7 of [Lu2015], and "
      "matching of the whole journey",
      "panvo evaluate places");
  describe(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kSuccess : kUsage;
  }
  try {
    return run(arguments);
  } catch (const PlotError& error) {
    std::cerr << "panvo evaluate places: " << error.what() << '\n';
    return kNoPlot;
  } catch (const std::exception& error) {
    std::cerr << "panvo evaluate places: " << error.what() << '\n';
    return kFailed;
  }
}
