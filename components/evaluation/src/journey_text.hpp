// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace panvo::evaluation {

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

/// "-" for an unknown value.
inline std::string metres(const std::optional<double>& value, int digits = 2) {
  return value ? fmt::format("{:.{}f}", *value, digits) : "-";
}

inline std::string degrees(const std::optional<double>& value_rad, int digits = 1) {
  return value_rad ? fmt::format("{:+.{}f}", *value_rad * kDegreesPerRadian, digits) : "-";
}

/// Absolute value of an angle.
inline std::string turn(const std::optional<double>& value_rad, int digits = 2) {
  return value_rad ? fmt::format("{:.{}f}", std::abs(*value_rad) * kDegreesPerRadian, digits) : "-";
}

/// Number of code points of UTF-8 text: its width on a terminal, for the characters used here.
inline std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// Text table with columns as wide as their widest cell; the first `left_columns` are left-aligned, the others
/// right-aligned.
class TextTable {
 public:
  TextTable(std::vector<std::string> header, std::size_t left_columns)
      : left_columns_(left_columns), rows_{std::move(header)} {}

  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }

  std::string text() const {
    std::vector<std::size_t> widths(rows_.front().size(), 0);
    for (const auto& row : rows_) {
      for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
    }
    std::string text;
    for (const auto& row : rows_) {
      std::string line;
      for (std::size_t i = 0; i < row.size(); ++i) {
        const std::string blanks(widths[i] - width_of(row[i]), ' ');
        line += "  ";
        line += i < left_columns_ ? row[i] + blanks : blanks + row[i];
      }
      text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
  }

 private:
  std::size_t left_columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace panvo::evaluation
