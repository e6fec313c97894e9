// SPDX-License-Identifier: Apache-2.0
#include "file_trial.hpp"

#include <spdlog/fmt/fmt.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace panvo::runtime {
namespace fs = std::filesystem;

namespace {

/// Files that SQLite keeps next to a database.
constexpr const char* kCompanions[] = {"-journal", "-wal", "-shm"};

fs::path with(const fs::path& file, const std::string& ending) {
  fs::path path = file;
  path += ending;
  return path;
}

fs::path counter_of(const fs::path& file) { return with(file, ".attempts"); }

int count_in(const fs::path& counter) {
  int count = 0;
  std::ifstream(counter) >> count;
  return count;
}

fs::path set_aside(const fs::path& file) {
  std::error_code error;
  int number = 1;
  while (fs::exists(with(file, fmt::format(".bad-{}", number)), error)) ++number;
  const fs::path bad = with(file, fmt::format(".bad-{}", number));
  fs::rename(file, bad, error);
  if (error) {
    throw std::runtime_error(
        fmt::format("{}: reading it failed {} times in a row, and it cannot be renamed: {}; move it away",
                    file.string(), kMaxFailures, error.message()));
  }
  for (const char* companion : kCompanions) fs::rename(with(file, companion), with(bad, companion), error);
  return bad;
}

}  // namespace

std::optional<fs::path> begin_trial(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) {
    end_trial(file);
    return std::nullopt;
  }
  const int failures = count_in(counter_of(file));
  if (failures >= kMaxFailures) {
    auto bad = set_aside(file);
    end_trial(file);
    return bad;
  }
  std::ofstream(counter_of(file)) << failures + 1 << "\n";
  return std::nullopt;
}

void end_trial(const fs::path& file) {
  std::error_code error;
  fs::remove(counter_of(file), error);
}

}  // namespace panvo::runtime
