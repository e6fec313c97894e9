// SPDX-License-Identifier: Apache-2.0
#include "panvo/postgres/location.hpp"

#include <algorithm>
#include <cctype>

namespace panvo::postgres {
namespace {

constexpr std::string_view kSchemes[] = {"postgresql://", "postgres://"};

int digit_of(char letter) {
  if (letter >= '0' && letter <= '9') return letter - '0';
  const int lower = std::tolower(static_cast<unsigned char>(letter));
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/// Without percent-encoding, in lower case.
std::string decoded(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() && digit_of(text[i + 1]) >= 0 && digit_of(text[i + 2]) >= 0) {
      plain += static_cast<char>(16 * digit_of(text[i + 1]) + digit_of(text[i + 2]));
      i += 2;
    } else {
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(text[i])));
    }
  }
  return plain;
}

/// Hosts with ports: "a:1,b:2", "[::1]:5432". Else the text after a colon may belong to a password.
bool has_only_ports(std::string_view hosts) {
  bool in_brackets = false, in_port = false;
  for (const char letter : hosts) {
    if (letter == '[') in_brackets = true;
    if (letter == ']') in_brackets = false;
    if (letter == ',') in_port = false;
    if (in_port && letter != ',' && !std::isdigit(static_cast<unsigned char>(letter))) return false;
    if (letter == ':' && !in_brackets) in_port = true;
  }
  return true;
}

std::string shown_authority(std::string_view authority) {
  const auto at = authority.rfind('@');
  const auto hosts = at == std::string_view::npos ? authority : authority.substr(at + 1);
  std::string shown;
  if (at != std::string_view::npos) shown = std::string(authority.substr(0, std::min(authority.find(':'), at))) + "@";
  return shown + std::string(has_only_ports(hosts) ? hosts : hosts.substr(0, hosts.find(':')));
}

std::string shown_options(std::string_view options) {
  std::string shown;
  while (!options.empty()) {
    const auto option = options.substr(0, options.find('&'));
    options.remove_prefix(std::min(options.size(), option.size() + 1));
    const auto name = decoded(option.substr(0, option.find('=')));
    if (name.find("password") == std::string::npos) shown += (shown.empty() ? "?" : "&") + std::string(option);
  }
  return shown;
}

}  // namespace

bool is_location(std::string_view text) noexcept {
  return std::ranges::any_of(kSchemes, [&](std::string_view scheme) { return text.starts_with(scheme); });
}

std::string without_password(std::string_view location) {
  if (!is_location(location)) return std::string(location);
  const auto start = location.find("//") + 2;
  const auto scheme = location.substr(0, start);
  auto rest = location.substr(start);
  // As in libpq: the user ends at the first '@' before any '/', so that a password may contain '?'.
  const auto slash = rest.find('/');
  const auto at = rest.find('@');
  const bool has_user = at < slash;
  const auto authority_end = std::min(slash, rest.find('?', has_user ? at : 0));
  const auto authority = rest.substr(0, authority_end);
  if (!has_user && !has_only_ports(authority)) {  // a password with '/'
    return std::string(scheme) + std::string(authority.substr(0, authority.find(':'))) + ":...";
  }
  rest = authority_end == std::string_view::npos ? std::string_view() : rest.substr(authority_end);
  const auto question = rest.find('?');
  const auto options = question == std::string_view::npos ? std::string_view() : rest.substr(question + 1);
  return std::string(scheme) + shown_authority(authority) + std::string(rest.substr(0, question)) +
         shown_options(options);
}

}  // namespace panvo::postgres
