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

/// A line of a CSV file with the requested columns in the requested order. Each reader throws InputError (file, line,
/// remedy) for an invalid field.
class CsvRow {
 public:
  CsvRow(std::filesystem::path file, std::size_t line, std::vector<std::string> fields)
      : file_(std::move(file)), line_(line), fields_(std::move(fields)) {}

  const std::string& text(std::size_t column) const { return fields_[column]; }
  std::int64_t integer(std::size_t column) const;
  double number(std::size_t column) const;                          ///< finite
  std::optional<double> optional_number(std::size_t column) const;  ///< nullopt for an empty field
  bool flag(std::size_t column) const;                              ///< 0 or 1
  /// Pose in the seven columns x y z qx qy qz qw that start at `first`.
  Eigen::Isometry3d pose(std::size_t first) const;
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;

 private:
  std::filesystem::path file_;
  std::size_t line_;
  std::vector<std::string> fields_;
};

/// Reads the rows below the header, of which there may be none. Fields may be quoted. Throws InputError for a missing
/// file, a missing header, a header without one of `columns`, and a line whose number of fields differs from the
/// header's.
std::vector<CsvRow> read_csv(const std::filesystem::path& file, const std::vector<std::string>& columns);

/// Appends "prefixx", "prefixy" .. "prefixqw", the columns that CsvRow::pose expects.
std::vector<std::string> with_pose(std::vector<std::string> columns, const std::string& prefix);

}  // namespace panvo::evaluation
