// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <fstream>
#include <optional>
#include <set>

#include "output_file.hpp"
#include "panvo/runner/run_files.hpp"
#include "run_json.hpp"

namespace panvo::runner {
namespace {

/// nullopt if the file is missing or not valid JSON: the container was killed.
std::optional<Json> read_json(const std::filesystem::path& file) {
  std::ifstream stream(file);
  Json json = Json::parse(stream, nullptr, false);
  return json.is_discarded() ? std::nullopt : std::optional(std::move(json));
}

std::optional<RunSummary> read_summary(const std::filesystem::path& file) {
  const auto json = read_json(file);
  try {
    return json ? std::optional(summary_from(*json)) : std::nullopt;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

template <class Item>
void append(std::vector<Item>& all, const std::vector<Item>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

void add(RunSummary& all, const RunSummary& one) {
  all.frames_in += one.frames_in;
  all.frames_out += one.frames_out;
  all.frames_unreliable += one.frames_unreliable;
  all.lines += one.lines;
  append(all.queues, one.queues);
  all.cpu_s += one.cpu_s;
  all.wall_s = std::max(all.wall_s, one.wall_s);
  all.peak_memory_mb += one.peak_memory_mb;  // upper bound: the peaks may not coincide
  for (const auto& [component, parameters] : one.changed_parameters) {
    all.changed_parameters[component].insert(parameters.begin(), parameters.end());
  }
  append(all.problems, one.problems);
  // A container stopped because another one failed is not the cause.
  const bool is_reason = one.exit_status != 0 && (all.exit_status == 0 || (all.interrupted && !one.interrupted));
  if (is_reason) all.exit_status = one.exit_status;
  all.interrupted |= one.interrupted;
}

/// Name of the second of two items with equal names.
std::string apart(const std::string& container, char separator, const std::string& name) {
  return std::string(container).append(1, separator).append(name);
}

/// Each container lists its own components; a duplicate is prefixed with the container's name.
void add_components(Json& all, const Json& timing, const std::string& container) {
  const auto components = timing.find("components");
  if (components == timing.end() || !components->is_object()) {
    return;
  }
  for (const auto& [name, component] : components->items()) {
    all[all.contains(name) ? apart(container, '/', name) : name] = component;
  }
}

void move_up(const std::filesystem::path& folder, const std::string& subfolder, std::set<std::string>& taken) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder / subfolder, error)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    auto name = file.filename().string();
    if (name == kTimingFile || name == kSummaryFile) {
      std::filesystem::remove(file, error);
      continue;
    }
    if (!taken.insert(name).second) {
      name = apart(subfolder, '_', name);
      taken.insert(name);
    }
    std::filesystem::rename(file, folder / name, error);
    if (error) {
      throw_cannot_write(folder / name, error.value());
    }
  }
  std::filesystem::remove(folder / subfolder, error);
}

}  // namespace

bool merge_run_files(const std::filesystem::path& folder, const std::vector<std::string>& subfolders,
                     bool must_have_results) {
  std::optional<RunSummary> all;
  RunSummary killed;
  Json timing{{"components", Json::object()}};
  for (const auto& subfolder : subfolders) {
    if (const auto one = read_summary(folder / subfolder / kSummaryFile)) {
      if (all) {
        add(*all, *one);
      } else {
        all = one;
      }
    } else {
      killed.problems.push_back("container " + subfolder + " left no " + kSummaryFile + ": it did not finish");
      killed.exit_status = 1;
    }
    if (const auto one = read_json(folder / subfolder / kTimingFile)) {
      add_components(timing["components"], *one, subfolder);
    }
  }
  RunSummary merged = all.value_or(RunSummary{});
  add(merged, killed);
  const bool lacks_results = must_have_results && merged.lines == 0 && merged.exit_status == 0;
  if (lacks_results) {
    merged.problems.push_back(nothing_written(folder));
    merged.exit_status = 1;
  }
  write_atomically(folder / kTimingFile, to_text(timing));
  write_atomically(folder / kSummaryFile, to_text(summary_json(merged)));
  std::set<std::string> taken;
  for (const auto& subfolder : subfolders) {
    move_up(folder, subfolder, taken);
  }
  return !lacks_results;
}

}  // namespace panvo::runner
