// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace panvo::web_view {

/// Content of "package://PACKAGE/FILE": the file PACKAGE/FILE below `folder`. Throws ProtocolError if there is none.
std::string read_asset(const std::filesystem::path& folder, std::string_view uri);

}  // namespace panvo::web_view
