// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace panvo::web_view {

/// Whether only programs of this machine reach an address: 127.0.0.0/8, ::1, localhost.
bool is_local(std::string_view host);

/// Whether two secrets are equal. The time depends on the length of `given` only.
bool is_equal_secret(std::string_view expected, std::string_view given);

/// The token of an HTTP header "Authorization: Bearer TOKEN"; empty: none.
std::string_view bearer_token(std::string_view header);

}  // namespace panvo::web_view
