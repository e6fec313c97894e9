// SPDX-License-Identifier: Apache-2.0
#include "access.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace panvo::web_view {

bool is_local(std::string_view host) {
  if (host == "localhost" || host == "::1" || host == "[::1]") return true;
  // Digits and dots only, so that a host name such as 127.example.org does not count.
  return host.starts_with("127.") && host.find_first_not_of("0123456789.") == std::string_view::npos;
}

bool is_equal_secret(std::string_view expected, std::string_view given) {
  // volatile: the compiler must not end the loop at the first difference.
  volatile unsigned difference = expected.size() == given.size() ? 0 : 1;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const char other = expected.empty() ? '\0' : expected[i % expected.size()];
    difference = difference | static_cast<unsigned>(static_cast<unsigned char>(given[i] ^ other));
  }
  return difference == 0;
}

bool is_trusted_origin(std::string_view origin, std::span<const std::string> allowed) {
  // file: the desktop apps of Foxglove and Lichtblick. Not "null", which any page can make its frames send.
  constexpr std::array<std::string_view, 3> kViewers{"https://app.foxglove.dev", "https://studio.foxglove.dev",
                                                     "file://"};
  if (origin.empty() || std::ranges::find(kViewers, origin) != kViewers.end()) return true;
  if (std::ranges::any_of(allowed, [&](const auto& one) { return one == origin || one == "*"; })) return true;
  constexpr std::string_view kSeparator = "://";
  const auto separator = origin.find(kSeparator);
  const auto scheme = origin.substr(0, separator);
  if (separator == std::string_view::npos || (scheme != "http" && scheme != "https")) return false;
  const auto authority = origin.substr(separator + kSeparator.size());
  // An address in brackets contains colons; elsewhere the first one begins the port.
  const auto end = authority.starts_with('[') ? authority.find(']') + 1 : authority.find(':');
  return is_local(authority.substr(0, end));
}

std::string_view bearer_token(std::string_view header) {
  constexpr std::string_view kScheme = "Bearer ";
  return header.starts_with(kScheme) ? header.substr(kScheme.size()) : std::string_view();
}

}  // namespace panvo::web_view
