// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace panvo::postgres {

/// Whether a text names a database on a server, `postgresql://user@host/database`, and not a file.
bool is_location(std::string_view text) noexcept;

/// The location without passwords, for messages. If it is malformed, it hides everything that might be one.
std::string without_password(std::string_view location);

}  // namespace panvo::postgres
