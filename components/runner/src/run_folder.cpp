// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <vector>

#include "output_file.hpp"
#include "panvo/runner/run_files.hpp"
#include "panvo/runtime/errors.hpp"
#include "run_json.hpp"

namespace panvo::runner {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMarkFile = ".panvo_run";
constexpr const char* kMark = "Results of a run; the next run into this folder replaces them.\n";

/// By the mark, or by the files of runs from before the mark was introduced.
bool is_of_a_run(const fs::path& folder) {
  return fs::exists(folder / kMarkFile) || (fs::exists(folder / kSummaryFile) && fs::exists(folder / kTimingFile));
}

/// In a folder that is not a run's, a file with a prefix may be somebody else's.
void remove_results(const fs::path& folder) {
  const bool may_have_namespace = is_of_a_run(folder);
  std::vector<fs::path> results{folder / kSummaryFile, folder / kTimingFile};
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (is_result_file(entry.path().filename().string(), may_have_namespace)) results.push_back(entry.path());
  }
  for (const auto& file : results) fs::remove(file);
}

}  // namespace

void claim_run_folder(const fs::path& folder, bool overwrite) {
  try {
    if (fs::exists(folder) && !fs::is_directory(folder)) {
      throw runtime::ConfigError(folder.string() + ": is a file; results go into a folder, choose another name");
    }
    fs::create_directories(folder);
    if (!overwrite && !fs::is_empty(folder) && !is_of_a_run(folder)) {
      throw runtime::ConfigError(folder.string() + ": contains " +
                                 fs::directory_iterator(folder)->path().filename().string() +
                                 " and is not a run folder; choose another folder, or pass --overwrite");
    }
    remove_results(folder);
  } catch (const fs::filesystem_error& error) {
    throw_cannot_write(folder, error.code().value());
  }
  write_atomically(folder / kMarkFile, kMark);
}

}  // namespace panvo::runner
