// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/run_folder.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "csv_table.hpp"
#include "panvo/evaluation/input_error.hpp"
#include "panvo/evaluation/trajectory_files.hpp"
#include "text_file.hpp"

namespace panvo::evaluation {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kOdometryFile = "odometry_binocular.tum";
constexpr std::string_view kEnhanced = "odometry_enhanced.tum";
constexpr std::string_view kCovariances = "odometry_binocular_covariance.csv";
constexpr std::string_view kTiming = "timing.json";
constexpr std::string_view kSummary = "summary.json";
constexpr std::string_view kMark = ".panvo_run";  // created by `panvo run --out` at its start
constexpr std::string_view kQuality = "quality.csv";

// Name of the folder, or of the file without extension; "runs/monday/", "runs/monday" and "." work alike.
std::string name_of(const fs::path& file_or_folder) {
  const fs::path path = fs::weakly_canonical(file_or_folder);
  if (fs::is_directory(path)) return path.filename().string();
  return path.stem().string();
}

std::size_t count_unreliable(const fs::path& file) {
  const auto rows = read_csv(file, {"reliable"});
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [](const CsvRow& row) { return !row.flag(0); }));
}

}  // namespace

bool is_run_folder(const fs::path& folder) {
  return fs::exists(folder / kOdometryFile) || fs::exists(folder / kEnhanced);
}

void require_finished(const fs::path& file_or_folder) {
  const fs::path folder = fs::is_directory(file_or_folder) ? file_or_folder : file_or_folder.parent_path();
  constexpr const char* kRemedy = "let the run finish, or evaluate the part that exists with --partial";
  if (!fs::exists(folder / kSummary)) {
    if (!fs::exists(folder / kMark)) return;  // not from `panvo run`
    throw InputError(folder, "the run is incomplete: it has no " + std::string(kSummary), kRemedy);
  }
  const auto summary = nlohmann::json::parse(read_text(folder / kSummary), nullptr, false);
  if (summary.is_object() && summary.value("interrupted", false)) {
    throw InputError(folder / kSummary, "the run was interrupted before its end", kRemedy);
  }
}

Estimate read_estimate(const fs::path& file_or_folder) {
  Estimate estimate;
  estimate.trajectory = read_trajectory(file_or_folder);
  estimate.name = name_of(file_or_folder);
  const fs::path file = estimate.trajectory.source;
  if (file.filename() != kOdometryFile && file.filename() != kEnhanced) return estimate;

  const fs::path folder = file.parent_path();
  if (fs::exists(folder / kQuality)) estimate.unreliable = count_unreliable(folder / kQuality);
  if (fs::exists(folder / kTiming)) estimate.timing = read_timing(folder / kTiming);
  if (fs::exists(folder / kCovariances) && fs::exists(folder / kOdometryFile)) {
    estimate.covariances = read_motion_covariances(folder / kCovariances);
    estimate.odometry = file.filename() == kOdometryFile ? estimate.trajectory : read_tum(folder / kOdometryFile);
  }
  return estimate;
}

}  // namespace panvo::evaluation
