// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/run_comparison.hpp"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <sstream>

#include "format.hpp"
#include "panvo/evaluation/input_error.hpp"
#include "panvo/evaluation/trajectory_files.hpp"
#include "text_file.hpp"

namespace panvo::evaluation {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> result_files(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InputError(folder, "is not a folder", "name a run folder");
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const auto extension = entry.path().extension();
    if (extension == ".tum" || extension == ".csv") files.push_back(entry.path());
  }
  if (files.empty()) {
    throw InputError(folder, "holds no results (*.tum, *.csv)", "name a run folder (--out of `panvo run`)");
  }
  std::sort(files.begin(), files.end());
  return files;
}

bool is_number(const std::string& field) {
  char* end = nullptr;
  std::strtod(field.c_str(), &end);
  return end != field.c_str() && *end == '\0';
}

/// Whether both are measured numbers, which may be rounded differently on another machine: at least one has a decimal
/// point or an exponent.
bool are_measured(const std::string& a, const std::string& b) {
  const auto has_point = [](const std::string& field) { return field.find_first_of(".e") != std::string::npos; };
  return is_number(a) && is_number(b) && (has_point(a) || has_point(b));
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::istringstream text(read_text(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  bool is_quoted = false;
  for (const char character : line) {
    if (character == '"') is_quoted = !is_quoted;
    if (character == ',' && !is_quoted) {
      fields.emplace_back();
    } else {
      fields.back().push_back(character);
    }
  }
  return fields;
}

/// Whether both lines are the same event, ignoring measured numbers and quoted texts, which contain such numbers.
bool is_same_event(const std::string& line, const std::string& expected) {
  const auto ours = fields_of(line), theirs = fields_of(expected);
  if (ours.size() != theirs.size()) return false;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const bool is_text = ours[i].starts_with('"') && theirs[i].starts_with('"');
    if (ours[i] != theirs[i] && !is_text && !are_measured(ours[i], theirs[i])) return false;
  }
  return true;
}

template <class Same>
void compare_lines(const fs::path& file, const fs::path& expected, const Same& same, FileComparison& comparison) {
  const auto ours = lines_of(file), theirs = lines_of(expected);
  comparison.lines = theirs.size();
  for (std::size_t i = 0; i < std::min(ours.size(), theirs.size()); ++i) {
    if (same(ours[i], theirs[i])) continue;
    comparison.difference = "line " + std::to_string(i + 1) + ": '" + ours[i] + "', expected '" + theirs[i] + "'";
    return;
  }
  if (ours.size() != theirs.size()) {
    comparison.difference = std::to_string(ours.size()) + " lines, expected " + std::to_string(theirs.size());
  }
}

void compare_poses(const fs::path& file, const fs::path& expected, const RunTolerance& tolerance,
                   FileComparison& comparison) {
  const Trajectory ours = read_tum(file), theirs = read_tum(expected);
  comparison.lines = theirs.poses.size();
  comparison.worst_m = comparison.worst_deg = 0.0;
  const auto differs = [&](const std::string& how) {
    if (!comparison.difference) comparison.difference = how;
  };
  if (ours.poses.size() != theirs.poses.size()) {
    differs(std::to_string(ours.poses.size()) + " poses, expected " + std::to_string(theirs.poses.size()));
  }
  for (std::size_t i = 0; i < std::min(ours.poses.size(), theirs.poses.size()); ++i) {
    const auto& our = ours.poses[i];
    const auto& their = theirs.poses[i];
    if (our.stamp_ns != their.stamp_ns) {
      differs("pose " + std::to_string(i + 1) + " has stamp " + std::to_string(our.stamp_ns) + " ns, expected " +
              std::to_string(their.stamp_ns) + " ns");
      return;
    }
    const Eigen::Isometry3d between = their.world_from_base.inverse() * our.world_from_base;
    const double apart_m = between.translation().norm();
    const double apart_deg = rotation_vector(between.linear()).norm() * 180.0 / std::numbers::pi;
    comparison.worst_m = std::max(*comparison.worst_m, apart_m);
    comparison.worst_deg = std::max(*comparison.worst_deg, apart_deg);
    if (apart_m > tolerance.position_m || apart_deg > tolerance.rotation_deg) {
      differs("pose " + std::to_string(i + 1) + " differs by " + to_text(apart_m, 3) + " m and " +
              to_text(apart_deg, 3) + " deg");
    }
  }
}

FileComparison compare(const fs::path& file, const fs::path& expected, const RunTolerance& tolerance) {
  FileComparison comparison;
  comparison.name = expected.filename().string();
  if (!fs::exists(file)) {
    comparison.lines = lines_of(expected).size();
    comparison.difference = "is missing";
  } else if (tolerance.is_exact()) {
    compare_lines(file, expected, std::equal_to<std::string>(), comparison);
  } else if (expected.extension() == ".tum") {
    compare_poses(file, expected, tolerance, comparison);
  } else {
    compare_lines(file, expected, is_same_event, comparison);
  }
  return comparison;
}

}  // namespace

std::vector<FileComparison> compare_runs(const fs::path& run, const fs::path& expected, const RunTolerance& tolerance) {
  result_files(run);
  std::vector<FileComparison> comparisons;
  for (const auto& file : result_files(expected)) {
    comparisons.push_back(compare(run / file.filename(), file, tolerance));
  }
  return comparisons;
}

}  // namespace panvo::evaluation
