// SPDX-License-Identifier: Apache-2.0
#include "text_file.hpp"

#include <charconv>
#include <cmath>
#include <fstream>

#include "panvo/interfaces/check.hpp"
#include "panvo/interfaces/stamp_range.hpp"

namespace panvo::dataset_player {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view trim(std::string_view text) {
  const auto begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

std::vector<std::string> split(std::string_view text, TextFile::Separator separator) {
  std::vector<std::string> fields;
  const bool comma = separator == TextFile::Separator::kComma;
  for (std::size_t begin = 0; begin <= text.size();) {
    const auto found = comma ? text.find(',', begin) : text.find_first_of(kBlanks, begin);
    const auto end = std::min(found, text.size());
    const auto field = trim(text.substr(begin, end - begin));
    if (comma || !field.empty()) fields.emplace_back(field);
    begin = end + 1;
  }
  return fields;
}

/// Parses all of `text` as one value. Returns whether that succeeds.
template <class Value>
bool parse(std::string_view text, Value& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

}  // namespace

TextFile::TextFile(std::filesystem::path path, Separator separator) : path_(std::move(path)) {
  std::ifstream file(path_);
  if (!file) throw DatasetError(path_.string() + ": cannot be opened; check that it exists and is readable");
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    const auto content = trim(line);
    if (!content.empty() && content.front() != '#') lines_.push_back({number, split(content, separator)});
  }
}

double TextFile::number(const TextLine& line, std::size_t field) const {
  double value = 0.0;
  if (!parse(text(line, field), value) || !(std::abs(value) <= interfaces::kMaxCoordinate_m)) {
    fail(line, "field " + std::to_string(field + 1) + " '" + line.fields[field] +
                   "' is not a finite number of a plausible size; correct or remove the line");
  }
  return value;
}

std::int64_t TextFile::nanoseconds(const TextLine& line, std::size_t field) const {
  std::int64_t value = 0;
  if (!parse(text(line, field), value) || value < 0 || value >= interfaces::kEndOfStamps_ns) {
    fail(line, "stamp '" + line.fields[field] +
                   "' is not a whole number of nanoseconds from 1970 to 2038; correct or remove the line");
  }
  return value;
}

std::int64_t TextFile::seconds_as_ns(const TextLine& line, std::size_t field) const {
  constexpr long double kEnd_s = interfaces::kEndOfStamps_ns / 1'000'000'000 - 1;  // rounding stays below
  long double seconds = 0.0L;  // a double loses hundreds of ns of a time since 1970
  if (!parse(text(line, field), seconds) || !(seconds >= 0.0L && seconds < kEnd_s)) {
    fail(line,
         "time '" + line.fields[field] + "' is not a number of seconds from 1970 to 2038; correct or remove the line");
  }
  return std::llround(seconds * 1e9L);
}

const std::string& TextFile::text(const TextLine& line, std::size_t field) const {
  if (field >= line.fields.size()) {
    fail(line, "has " + std::to_string(line.fields.size()) + " fields where at least " + std::to_string(field + 1) +
                   " are needed; was the file cut off?");
  }
  return line.fields[field];
}

void TextFile::expect_later(const TextLine& line, std::int64_t previous_ns, std::int64_t stamp_ns) const {
  if (stamp_ns > previous_ns) return;
  fail(line, "stamp " + std::to_string(stamp_ns) + " ns is not later than the previous one (" +
                 std::to_string(previous_ns) +
                 " ns); times must increase: sort the file, or split the recording where its clock was set");
}

void TextFile::fail(const TextLine& line, std::string_view what) const {
  throw DatasetError(path_.string() + ":" + std::to_string(line.number) + ": " + std::string(what));
}

}  // namespace panvo::dataset_player
