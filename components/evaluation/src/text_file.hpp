// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace panvo::evaluation {

inline constexpr double kRotationTolerance = 1e-3;  // of the norm of a quaternion, for rounded digits

// A non-empty line and its number in the file, from 1.
struct Line {
  std::size_t number = 0;
  std::string text;
};

// Skips blank lines and comments. Throws InputError if the file is missing, a folder, unreadable, or has no other
// lines.
std::vector<Line> read_lines(const std::filesystem::path& file);

// The fields of one line. Errors name file, line and field.
class Fields {
 public:
  // ',' splits at commas, ' ' at any white space. Keeps references to `file` and `line`, which must outlive this
  // object.
  Fields(const std::filesystem::path& file, const Line& line, char separator);

  std::size_t size() const { return fields_.size(); }
  // Throws InputError unless there are `count` fields (with `or_more`, at least `count`).
  void expect(std::size_t count, bool or_more, std::string_view layout) const;

  double number(std::size_t index) const;  // finite
  std::int64_t integer(std::size_t index) const;
  std::int64_t seconds_as_ns(std::size_t index) const;  // "1403636579.763555584" without loss
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;

 private:
  const std::filesystem::path& file_;
  const Line& line_;
  std::vector<std::string_view> fields_;
};

// Reads a whole file. Throws InputError if it cannot be read.
std::string read_text(const std::filesystem::path& file);

}  // namespace panvo::evaluation
