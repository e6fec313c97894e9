// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "panvo/dataset_player/dataset.hpp"

namespace panvo::dataset_player {

/// A line of a text table, split into trimmed fields.
struct TextLine {
  int number = 0;  ///< from 1
  std::vector<std::string> fields;
};

/// A text file with fields separated by commas or spaces. Skips empty lines and lines that begin with '#'.
class TextFile {
 public:
  enum class Separator { kComma, kBlank };
  TextFile(std::filesystem::path path, Separator separator);

  const std::vector<TextLine>& lines() const noexcept { return lines_; }
  const std::filesystem::path& path() const noexcept { return path_; }

  /// Parse a field: a finite number, a stamp in integer nanoseconds, a time in seconds (returned in ns). Throw
  /// DatasetError with the line.
  double number(const TextLine& line, std::size_t field) const;
  std::int64_t nanoseconds(const TextLine& line, std::size_t field) const;
  std::int64_t seconds_as_ns(const TextLine& line, std::size_t field) const;
  const std::string& text(const TextLine& line, std::size_t field) const;

  /// Throws DatasetError unless `stamp_ns` is later than `previous_ns`.
  void expect_later(const TextLine& line, std::int64_t previous_ns, std::int64_t stamp_ns) const;

  [[noreturn]] void fail(const TextLine& line, std::string_view what) const;

 private:
  std::filesystem::path path_;
  std::vector<TextLine> lines_;
};

}  // namespace panvo::dataset_player
