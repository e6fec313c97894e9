// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace panvo::web_view {

/// Whether this is an ASCII letter, a digit or an underscore, whatever the locale.
bool is_word_character(char letter);

/// The file that a URL path names below a folder; a path that ends with a slash names index.html. nullopt: none.
/// Names begin with a letter, digit or underscore and have only these, dots and hyphens, so no path leads out.
std::optional<std::filesystem::path> file_below(const std::filesystem::path& folder, std::string_view url_path);

/// nullopt if the file is larger than 64 MB or cannot be read.
std::optional<std::string> read_file(const std::filesystem::path& file);

}  // namespace panvo::web_view
