// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace panvo::web_view {

/// Whether only programs of this machine reach an address: 127.0.0.0/8, ::1, localhost.
bool is_local(std::string_view host);

/// Whether two secrets are equal. The time depends on the length of `given` only.
bool is_equal_secret(std::string_view expected, std::string_view given);

/// Whether a page of this origin may read without a token: none is given (not a browser), a server of this machine, the
/// Foxglove app, or one of `allowed` ("https://viewer.example.org"; "*": any).
bool is_trusted_origin(std::string_view origin, std::span<const std::string> allowed);

/// The token of an HTTP header "Authorization: Bearer TOKEN"; empty: none.
std::string_view bearer_token(std::string_view header);

}  // namespace panvo::web_view
