// SPDX-License-Identifier: Apache-2.0
// panvo_evaluate: a trajectory against ground truth, as a table, as files and as a plot.
#include <CLI/CLI.hpp>
#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "panvo/evaluation/evaluation.hpp"
#include "panvo/evaluation/input_error.hpp"
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
  app.add_option("estimate", arguments.estimate, "a run's output folder, or a trajectory (TUM, EuRoC csv, KITTI poses)")
      ->required();
  app.add_option("ground_truth", arguments.ground_truth, "a data set's folder (EuRoC/ASL, KITTI), or a trajectory")
      ->required();
  app.add_option("--name", arguments.name, "what to call the estimate (default: its folder or file)");
  app.add_option("--also", arguments.also, "NAME=PATH: one more estimate to compare; may be given again")
      ->expected(1)
      ->take_all();
  app.add_option("--out", arguments.out,
                 "where to write evaluation.json, errors.csv, evaluation.png and .svg "
                 "(default: the run's folder; for a single file, the current one)");
  app.add_option("--align", arguments.alignment, "alignment of the plot and of errors.csv")
      ->check(CLI::IsMember(kAlignments).description("{none,start,se3,sim3}"))
      ->capture_default_str();
  app.add_option("--segments", arguments.lengths_m, "lengths of the KITTI segments, m: 10,20,30 (default: to suit)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::PositiveNumber);
  app.add_option("--segment-step", arguments.options.segments.step,
                 "poses between the starts of segments (default: "
                 "10 from 100 m on, else 1)");
  app.add_option("--associate", arguments.method,
                 "ground truth at an estimate's stamp: between its neighbours, or the "
                 "nearest in time")
      ->check(CLI::IsMember(kMethods).description("{interpolate,nearest}"))
      ->capture_default_str();
  app.add_option("--tolerance", arguments.tolerance_s,
                 "widest gap that is interpolated over, or largest difference to "
                 "the nearest, s (default: 2.5 or 0.5 of its periods)")
      ->check(CLI::Range(1e-9, 1e6));
  app.add_option("--nees-steps", arguments.options.consistency.steps,
                 "steps of the motion whose covariance is checked "
                 "(default: 1)")
      ->check(CLI::Range(1, 1000000));
  app.add_option("--truth-noise-m", arguments.options.consistency.truth_noise_m,
                 "how far a pose of the ground truth is off by itself, m, one standard deviation an axis, for the "
                 "NEES (default: 0)")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--truth-noise-deg", arguments.truth_noise_deg, "the same for its orientation, degrees (default: 0)")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--title", arguments.title, "heading of the table and the plot (default: the ground truth's name)");
  app.add_flag("--json", arguments.json, "print evaluation.json instead of the table");
  app.add_flag("--partial", arguments.partial, "evaluate a run that was interrupted, too");
  app.add_flag("--no-plot", arguments.no_plot, "draw no plot");
}

// ".../kitti_03" for a folder; the folder of a file is more telling than "poses" or "data".
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
      throw InputError("--also " + also + ": no NAME=PATH; write for example --also other=runs/other");
    }
    estimates.push_back(read_estimate(also.substr(equals + 1)));
    estimates.back().name = also.substr(0, equals);
  }
  std::set<std::string> names;
  for (const Estimate& estimate : estimates) {
    if (!names.insert(estimate.name).second) {
      throw InputError("two estimates are called '" + estimate.name + "'; name them apart with --name and --also");
    }
  }
  return estimates;
}

/// Where to write. Somebody's data set or other folder is not written to unless it is named.
fs::path output_folder(const Arguments& arguments) {
  if (!arguments.out.empty()) return arguments.out;
  if (!fs::is_directory(arguments.estimate)) return ".";
  if (is_run_folder(arguments.estimate)) return arguments.estimate;
  throw InputError(arguments.estimate, "is not the folder of a run",
                   "give the run first and then its ground truth, or name a folder for the results with --out");
}

/// What an earlier evaluation left is replaced, files of these names that none left are not.
void require_ours(const fs::path& folder) {
  if (fs::exists(folder / "evaluation.json")) return;
  for (const char* name : {"errors.csv", "evaluation.png", "evaluation.svg"}) {
    if (fs::exists(folder / name)) {
      throw InputError(folder / name, "is there already, and of no evaluation", "name another folder with --out");
    }
  }
}

void check(const Arguments& arguments) {
  require_ours(output_folder(arguments));
  if (arguments.partial) return;
  require_finished(arguments.estimate);
  for (const std::string& also : arguments.also) require_finished(also.substr(also.find('=') + 1));
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  if (!(stream << text).flush()) throw InputError(file, "cannot be written", "choose a writable folder with --out");
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
  if (error) throw InputError(folder, "cannot be made: " + error.message(), "choose another folder with --out");
  write(folder / "evaluation.json", json);
  write(folder / "errors.csv", to_csv(report));
  if (!arguments.no_plot) draw_plot(report, folder);
  if (!arguments.json) {
    std::cout << "\nwritten to " << folder.string() << ": evaluation.json, errors.csv"
              << (arguments.no_plot ? "" : ", evaluation.png, evaluation.svg") << "\n";
  }
  return kSuccess;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures an estimated trajectory against ground truth.", "panvo evaluate");
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
