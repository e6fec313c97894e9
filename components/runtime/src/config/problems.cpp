// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/problems.hpp"

#include <algorithm>
#include <set>

namespace panvo::runtime {
namespace {

std::string join_lines(const std::vector<std::string>& lines) {
  std::string joined;
  for (const auto& line : lines) {
    joined += (joined.empty() ? "" : "\n") + line;
  }
  return joined;
}

}  // namespace

ConfigError::ConfigError(std::vector<std::string> problems)
    : std::runtime_error(join_lines(problems)), problems_(std::move(problems)) {}

void Problems::add(Location where, std::string what) { found_.emplace_back(std::move(where), std::move(what)); }

std::vector<std::string> Problems::sorted() const {
  std::vector<std::string> files;
  for (const auto& [where, what] : found_) {
    if (std::find(files.begin(), files.end(), where.file) == files.end()) {
      files.push_back(where.file);
    }
  }
  const auto key = [&files](const auto& problem) {
    return std::pair(std::find(files.begin(), files.end(), problem.first.file), problem.first.line);
  };
  auto in_order = found_;
  std::stable_sort(in_order.begin(), in_order.end(), [&key](const auto& a, const auto& b) { return key(a) < key(b); });

  std::vector<std::string> lines;
  std::set<std::string> known;
  for (const auto& [where, what] : in_order) {
    auto line = where.file.empty() ? what : where.to_string() + ": " + what;
    if (known.insert(line).second) lines.push_back(std::move(line));
  }
  return lines;
}

void Problems::throw_if_any() const {
  if (!empty()) {
    throw ConfigError(sorted());
  }
}

}  // namespace panvo::runtime
