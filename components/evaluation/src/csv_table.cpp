// SPDX-License-Identifier: Apache-2.0
#include "csv_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "panvo/evaluation/input_error.hpp"
#include "text_file.hpp"

namespace panvo::evaluation {
namespace {

constexpr const char* kStopped = "the run was stopped while writing: remove the line, or run again";

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += '"';
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  if (quoted) fields.clear();  // unclosed quote: the line is truncated
  return fields;
}

template <class Number>
std::optional<Number> parse(const std::string& text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::vector<std::size_t> places_of(const std::vector<std::string>& columns, const std::vector<std::string>& header,
                                   const std::filesystem::path& file) {
  std::vector<std::size_t> places;
  for (const auto& column : columns) {
    const auto found = std::find(header.begin(), header.end(), column);
    if (found == header.end()) {
      throw InputError(file, 1, "has no column '" + column + "'", "run again with this version of panvo");
    }
    places.push_back(static_cast<std::size_t>(found - header.begin()));
  }
  return places;
}

}  // namespace

std::int64_t CsvRow::integer(std::size_t column) const {
  const auto value = parse<std::int64_t>(text(column));
  if (!value) fail("'" + text(column) + "' is not a whole number", kStopped);
  return *value;
}

double CsvRow::number(std::size_t column) const {
  const auto value = parse<double>(text(column));
  if (!value || !std::isfinite(*value)) fail("'" + text(column) + "' is not a finite number", kStopped);
  return *value;
}

std::optional<double> CsvRow::optional_number(std::size_t column) const {
  return text(column).empty() ? std::nullopt : std::optional(number(column));
}

bool CsvRow::flag(std::size_t column) const {
  if (text(column) != "0" && text(column) != "1") fail("'" + text(column) + "' is neither 0 nor 1", kStopped);
  return text(column) == "1";
}

Eigen::Isometry3d CsvRow::pose(std::size_t first) const {
  const Eigen::Quaterniond turn(number(first + 6), number(first + 3), number(first + 4), number(first + 5));
  if (std::abs(turn.norm() - 1.0) > kRotationTolerance) fail("has a quaternion whose norm is not 1", kStopped);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = turn.normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(number(first), number(first + 1), number(first + 2));
  return pose;
}

void CsvRow::fail(const std::string& problem, const std::string& remedy) const {
  throw InputError(file_, line_, problem, remedy);
}

std::vector<CsvRow> read_csv(const std::filesystem::path& file, const std::vector<std::string>& columns) {
  std::istringstream text(read_text(file));
  std::string line;
  if (!std::getline(text, line) || line.empty()) {
    throw InputError(file, "is empty", "the run is incomplete: run again");
  }
  const auto header = split(line);
  const auto places = places_of(columns, header, file);
  std::vector<CsvRow> rows;
  for (std::size_t number = 2; std::getline(text, line); ++number) {
    if (line.empty()) continue;
    const auto all = split(line);
    if (all.size() != header.size()) {
      throw InputError(file, number, "does not have the header's " + std::to_string(header.size()) + " fields",
                       kStopped);
    }
    std::vector<std::string> fields;
    for (const auto place : places) fields.push_back(all[place]);
    rows.emplace_back(file, number, std::move(fields));
  }
  return rows;
}

std::vector<std::string> with_pose(std::vector<std::string> columns, const std::string& prefix) {
  for (const char* name : {"x", "y", "z", "qx", "qy", "qz", "qw"}) columns.push_back(prefix + name);
  return columns;
}

}  // namespace panvo::evaluation
