// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace panvo::evaluation {

/// A line of a comma-separated file with the columns that were asked for, in the order they were asked for. Every reader throws
/// InputError (file, line, what to do) for a field that is none.
class CsvRow {
 public:
  CsvRow(std::filesystem::path file, std::size_t line, std::vector<std::string> fields)
      : file_(std::move(file)), line_(line), fields_(std::move(fields)) {}

  const std::string& text(std::size_t column) const { return fields_[column]; }
  std::int64_t integer(std::size_t column) const;
  double number(std::size_t column) const;                          ///< finite
  std::optional<double> optional_number(std::size_t column) const;  ///< nullopt for an empty field
  bool flag(std::size_t column) const;                              ///< 0 or 1
  /// x y z qx qy qz qw from `first` on.
  Eigen::Isometry3d pose(std::size_t first) const;
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;

 private:
  std::filesystem::path file_;
  std::size_t line_;
  std::vector<std::string> fields_;
};

/// The rows below the header; none is no error. Fields may stand in quotes. Throws InputError for a file that is missing or
/// has not even a header, a header without one of `columns`, and a line with fewer or more fields than the header.
std::vector<CsvRow> read_csv(const std::filesystem::path& file, const std::vector<std::string>& columns);

/// "prefixx", "prefixy" .. "prefixqw", as CsvRow::pose wants them.
std::vector<std::string> with_pose(std::vector<std::string> columns, const std::string& prefix);

}  // namespace panvo::evaluation
