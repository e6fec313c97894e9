// SPDX-License-Identifier: Apache-2.0
#include "text_file.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

#include "panvo/evaluation/input_error.hpp"

namespace panvo::evaluation {
namespace {

constexpr std::string_view kWhiteSpace = " \t\r";

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(kWhiteSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kWhiteSpace) - first + 1);
}

template <class Number>
std::optional<Number> parse_number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// Plain decimals only: "12.345" -> 12'345'000'000. nullopt for anything else, such as an exponent.
std::optional<std::int64_t> decimal_seconds_as_ns(std::string_view text) {
  const auto point = text.find('.');
  const auto whole = parse_number<std::int64_t>(text.substr(0, point));
  const std::string_view digits = point == std::string_view::npos ? "" : text.substr(point + 1);
  if (!whole || *whole < 0 || digits.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
  if (*whole >= std::numeric_limits<std::int64_t>::max() / 1'000'000'000) return std::nullopt;
  std::int64_t fraction_ns = 0;
  for (std::size_t place = 0; place < 9; ++place) {
    fraction_ns = 10 * fraction_ns + (place < digits.size() ? digits[place] - '0' : 0);
  }
  const bool round_up = digits.size() > 9 && digits[9] >= '5';
  return *whole * 1'000'000'000 + fraction_ns + (round_up ? 1 : 0);
}

}  // namespace

std::string read_text(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) throw InputError(file, "no such file", "check the path");
  if (std::filesystem::is_directory(file, ignored)) throw InputError(file, "is a folder", "name a file in it");
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (!stream || (stream.peek() != std::ifstream::traits_type::eof() && !(text << stream.rdbuf()))) {
    throw InputError(file, "cannot be read", "check its permissions");
  }
  return std::move(text).str();
}

std::vector<Line> read_lines(const std::filesystem::path& file) {
  std::istringstream text(read_text(file));
  std::vector<Line> lines;
  std::string line;
  for (std::size_t number = 1; std::getline(text, line); ++number) {
    const std::string_view content = trim(line);
    if (!content.empty() && content.front() != '#') lines.push_back({number, std::string(content)});
  }
  if (lines.empty()) {
    throw InputError(file, "is empty", "check that the program that wrote it finished and produced poses");
  }
  return lines;
}

Fields::Fields(const std::filesystem::path& file, const Line& line, char separator) : file_(file), line_(line) {
  std::string_view rest = line.text;
  while (!rest.empty()) {
    const auto end = separator == ',' ? rest.find(',') : rest.find_first_of(kWhiteSpace);
    const std::string_view field = trim(rest.substr(0, end));
    if (separator == ',' || !field.empty()) fields_.push_back(field);
    if (end == std::string_view::npos) break;
    rest.remove_prefix(end + 1);
  }
}

void Fields::expect(std::size_t count, bool or_more, std::string_view layout) const {
  if (size() == count || (or_more && size() > count)) return;
  fail(std::to_string(size()) + " fields, " + std::to_string(count) + " expected",
       "each line must read: " + std::string(layout));
}

double Fields::number(std::size_t index) const {
  const auto value = parse_number<double>(fields_[index]);
  if (!value || !std::isfinite(*value)) {
    fail("field " + std::to_string(index + 1) + " is not a finite number: '" + std::string(fields_[index]) + "'",
         "remove the line, or find out how it was written");
  }
  return *value;
}

std::int64_t Fields::integer(std::size_t index) const {
  const auto value = parse_number<std::int64_t>(fields_[index]);
  if (!value) {
    fail("field " + std::to_string(index + 1) + " is not a whole number: '" + std::string(fields_[index]) + "'",
         "stamps in this format are nanoseconds");
  }
  return *value;
}

std::int64_t Fields::seconds_as_ns(std::size_t index) const {
  if (const auto stamp = decimal_seconds_as_ns(fields_[index])) return *stamp;
  const double seconds = number(index);
  if (seconds < 0.0 || seconds > 9e9) {
    fail("invalid stamp " + std::string(fields_[index]) + " s", "stamps are seconds from 0 to 9e9");
  }
  return std::llround(seconds * 1e9);
}

void Fields::fail(const std::string& problem, const std::string& remedy) const {
  throw InputError(file_, line_.number, problem, remedy);
}

}  // namespace panvo::evaluation
