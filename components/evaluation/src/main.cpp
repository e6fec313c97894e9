// SPDX-License-Identifier: Apache-2.0
// panvo_evaluate: compares a trajectory with ground truth; prints a table, writes files and a plot.
#include <CLI/CLI.hpp>
#include <cmath>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "panvo/evaluation/evaluation.hpp"
#include "panvo/evaluation/input_error.hpp"
#include "panvo/evaluation/output_file.hpp"
#include "panvo/evaluation/plot.hpp"
#include "panvo/evaluation/report.hpp"
#include "panvo/evaluation/run_folder.hpp"
#include "panvo/evaluation/trajectory_files.hpp"

namespace {

namespace fs = std::filesystem;
using namespace panvo::evaluation;

enum ExitStatus { kSuccess = 0, kFailed = 1, kUsage = 2, kNoPlot = 3 };

struct Arguments {
  std::string estimate;
  std::string ground_truth;
  std::string name;
  std::vector<std::string> also;
  std::string out;
  std::string title;
  std::string alignment = "start";
  std::string method = "interpolate";
  std::vector<double> lengths_m;
  double tolerance_s = 0.0;
  double truth_noise_deg = 0.0;
  bool json = false;
  bool no_plot = false;
  bool partial = false;
  Options options;
};

const std::map<std::string, Alignment> kAlignments{
    {"none", Alignment::kNone}, {"start", Alignment::kStart}, {"se3", Alignment::kSe3}, {"sim3", Alignment::kSim3}};
const std::map<std::string, AssociationMethod> kMethods{{"interpolate", AssociationMethod::kInterpolate},
                                                        {"nearest", AssociationMethod::kNearest}};

void describe(CLI::App& app, Arguments& arguments) {
  app.add_option("estimate", arguments.estimate, "run folder, or trajectory (TUM, EuRoC csv, KITTI poses)")->required();
  app.add_option("ground_truth", arguments.ground_truth, "data set folder (EuRoC/ASL, KITTI), or trajectory")
      ->required();
  app.add_option("--name", arguments.name, "name of the estimate (default: name of its folder or file)");
  app.add_option("--also", arguments.also, "NAME=PATH: further estimate to compare; may be repeated")
      ->expected(1)
      ->take_all();
  app.add_option("--out", arguments.out,
                 "folder for evaluation.json, errors.csv, evaluation.png and .svg "
                 "(default: the run folder; for a single file, the current folder)");
  app.add_option("--align", arguments.alignment, "alignment of the plot and of errors.csv")
      ->check(CLI::IsMember(kAlignments).description("{none,start,se3,sim3}"))
      ->capture_default_str();
  app.add_option("--segments", arguments.lengths_m, "lengths of the KITTI segments, m: 10,20,30 (default: automatic)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::PositiveNumber);
  app.add_option("--segment-step", arguments.options.segments.step,
                 "poses between the starts of segments (default: "
                 "10 for lengths of at least 100 m, else 1)");
  app.add_option("--associate", arguments.method,
                 "ground truth at an estimate's stamp: interpolated, or the pose nearest in "
                 "time")
      ->check(CLI::IsMember(kMethods).description("{interpolate,nearest}"))
      ->capture_default_str();
  app.add_option("--tolerance", arguments.tolerance_s,
                 "largest gap to interpolate over, or largest time difference to "
                 "the nearest pose, s (default: 2.5 or 0.5 periods of the ground truth)")
      ->check(CLI::Range(1e-9, 1e6));
  app.add_option("--nees-steps", arguments.options.consistency.steps,
                 "number of steps of the motion whose covariance is evaluated "
                 "(default: 1)")
      ->check(CLI::Range(1, 1000000));
  app.add_option("--truth-noise-m", arguments.options.consistency.truth_noise_m,
                 "standard deviation of a ground-truth position per axis, m, for the "
                 "NEES (default: 0)")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--truth-noise-deg", arguments.truth_noise_deg, "the same for the orientation, degrees (default: 0)")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--title", arguments.title, "title of the table and the plot (default: name of the ground truth)");
  app.add_flag("--json", arguments.json, "print evaluation.json instead of the table");
  app.add_flag("--partial", arguments.partial, "also accept an interrupted run");
  app.add_flag("--no-plot", arguments.no_plot, "do not draw a plot");
}

// Name of the data set, such as "kitti_03": for a file the name of its folder, because "poses" or "data" would say
// little.
std::string default_title(const fs::path& ground_truth) {
  fs::path path = fs::weakly_canonical(ground_truth);
  if (!fs::is_directory(path)) path = path.parent_path();
  for (const char* part : {"state_groundtruth_estimate0", "mav0"}) {
    if (path.filename() == part) path = path.parent_path();
  }
  return path.filename().string();
}

std::vector<Estimate> read_estimates(const Arguments& arguments) {
  std::vector<Estimate> estimates{read_estimate(arguments.estimate)};
  if (!arguments.name.empty()) estimates.front().name = arguments.name;
  for (const std::string& also : arguments.also) {
    const auto equals = also.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == also.size()) {
      throw InputError("--also " + also + ": not NAME=PATH; for example: --also other=runs/other");
    }
    estimates.push_back(read_estimate(also.substr(equals + 1)));
    estimates.back().name = also.substr(0, equals);
  }
  std::set<std::string> names;
  for (const Estimate& estimate : estimates) {
    if (!names.insert(estimate.name).second) {
      throw InputError("two estimates are named '" + estimate.name + "'; use different names with --name and --also");
    }
  }
  return estimates;
}

/// Folder for the results. A folder other than a run folder is written to only if it is named with --out.
fs::path output_folder(const Arguments& arguments) {
  if (!arguments.out.empty()) return arguments.out;
  if (!fs::is_directory(arguments.estimate)) return ".";
  if (is_run_folder(arguments.estimate)) return arguments.estimate;
  throw InputError(arguments.estimate, "is not a run folder",
                   "give first the run and then its ground truth, or name a folder for the results with --out");
}

/// Results of an earlier evaluation are replaced. Throws if the folder has files with these names from another source.
void require_ours(const fs::path& folder) {
  if (fs::exists(folder / "evaluation.json")) return;
  for (const char* name : {"errors.csv", "evaluation.png", "evaluation.svg"}) {
    if (fs::exists(folder / name)) {
      throw InputError(folder / name, "exists and is not from an evaluation", "name another folder with --out");
    }
  }
}

void check(const Arguments& arguments) {
  require_ours(output_folder(arguments));
  if (arguments.partial) return;
  require_finished(arguments.estimate);
  for (const std::string& also : arguments.also) require_finished(also.substr(also.find('=') + 1));
}

int run(const Arguments& arguments) {
  check(arguments);
  Report report;
  report.ground_truth = read_trajectory(arguments.ground_truth);
  report.title = arguments.title.empty() ? default_title(arguments.ground_truth) : arguments.title;
  for (const Estimate& estimate : read_estimates(arguments)) {
    report.evaluations.push_back(evaluate(estimate, report.ground_truth, arguments.options));
  }
  const std::string json = to_json(report);
  std::cout << (arguments.json ? json : to_table(report)) << std::flush;

  const fs::path folder = output_folder(arguments);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder, "cannot be created: " + error.message(), "choose another folder with --out");
  write_output(folder / "evaluation.json", json);
  write_output(folder / "errors.csv", to_csv(report));
  if (!arguments.no_plot) draw_plot(report, folder);
  if (!arguments.json) {
    std::cout << "\nwritten to " << folder.string() << ": evaluation.json, errors.csv"
              << (arguments.no_plot ? "" : ", evaluation.png, evaluation.svg") << "\n";
  }
  return kSuccess;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compares an estimated trajectory with ground truth.", "panvo evaluate");
  Arguments arguments;
  describe(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kSuccess : kUsage;
  }
  arguments.options.alignment = kAlignments.at(arguments.alignment);
  arguments.options.association.method = kMethods.at(arguments.method);
  arguments.options.segments.lengths_m = arguments.lengths_m;
  arguments.options.consistency.truth_noise_rad = arguments.truth_noise_deg * std::numbers::pi / 180.0;
  arguments.options.association.tolerance_ns = std::llround(arguments.tolerance_s * 1e9);
  try {
    return run(arguments);
  } catch (const PlotError& error) {
    std::cerr << "panvo evaluate: no plot: " << error.what() << "\n";
    return kNoPlot;
  } catch (const std::exception& error) {
    std::cerr << "panvo evaluate: " << error.what() << "\n";
    return kFailed;
  }
}
