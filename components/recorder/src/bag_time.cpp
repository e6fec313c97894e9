// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

#include "panvo/recorder/bag_copy.hpp"

namespace panvo::recorder {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;
constexpr std::int64_t kMaxBagS = 100'000'000;  // three years; larger numbers are stamps
constexpr std::int64_t kLatestStampS = std::numeric_limits<std::int64_t>::max() / kNsPerS - 1;

bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789.") == std::string::npos &&
         std::count(text.begin(), text.end(), '.') <= 1 && text != ".";
}

}  // namespace

std::int64_t parse_bag_time(const std::string& text, std::int64_t start_ns) {
  constexpr std::size_t kMaxDigits = 18;
  const auto point = std::min(text.find('.'), text.size());
  const auto whole = text.substr(0, point);
  auto fraction = point < text.size() ? text.substr(point + 1) : std::string();
  if (!is_number(text) || whole.size() > kMaxDigits + 1) {
    throw BagError("'" + text +
                   "' is not a valid bag time: use seconds from its start, or a stamp in seconds or nanoseconds");
  }
  // Integers, since a double cannot hold the nanoseconds of a stamp.
  const auto number = whole.empty() ? 0 : std::stoull(whole);
  if (number > static_cast<unsigned long long>(kLatestStampS)) {
    return static_cast<std::int64_t>(std::min<unsigned long long>(number, std::numeric_limits<std::int64_t>::max()));
  }
  fraction.resize(9, '0');
  const auto ns = static_cast<std::int64_t>(number) * kNsPerS + std::stoll(fraction);
  return static_cast<std::int64_t>(number) < kMaxBagS ? start_ns + ns : ns;
}

}  // namespace panvo::recorder
