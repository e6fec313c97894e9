// SPDX-License-Identifier: Apache-2.0
#include "assets.hpp"

#include "files_below.hpp"
#include "protocol_error.hpp"

namespace panvo::web_view {

std::string read_asset(const std::filesystem::path& folder, std::string_view uri) {
  constexpr std::string_view kScheme = "package:/";  // the second slash begins the path
  if (folder.empty()) throw ProtocolError("no assets are offered: the parameter assets of the web view is empty");
  if (!uri.starts_with(kScheme)) throw ProtocolError("only assets of package:// are offered");
  const auto file = file_below(folder, uri.substr(kScheme.size()));
  auto content = file ? read_file(*file) : std::nullopt;
  if (!content) throw ProtocolError("there is no such file: " + std::string(uri));
  return std::move(*content);
}

}  // namespace panvo::web_view
