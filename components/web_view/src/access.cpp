// SPDX-License-Identifier: Apache-2.0
#include "access.hpp"

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

std::string_view bearer_token(std::string_view header) {
  constexpr std::string_view kScheme = "Bearer ";
  return header.starts_with(kScheme) ? header.substr(kScheme.size()) : std::string_view();
}

}  // namespace panvo::web_view
