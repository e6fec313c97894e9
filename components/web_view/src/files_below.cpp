// SPDX-License-Identifier: Apache-2.0
#include "files_below.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace panvo::web_view {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxFileBytes = 64'000'000;  // read into memory as a whole

bool is_file_name(std::string_view name) {
  return !name.empty() && is_word_character(name.front()) && std::ranges::all_of(name, [](char letter) {
    return letter == '.' || letter == '-' || is_word_character(letter);
  });
}

}  // namespace

bool is_word_character(char letter) {
  constexpr std::string_view kWord = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_";
  return kWord.find(letter) != std::string_view::npos;
}

std::optional<fs::path> file_below(const fs::path& folder, std::string_view url_path) {
  if (!url_path.starts_with('/')) return std::nullopt;
  fs::path file = folder;
  while (!url_path.empty()) {
    url_path.remove_prefix(1);
    const std::string_view name = url_path.substr(0, url_path.find('/'));
    url_path.remove_prefix(name.size());
    const bool is_end = url_path.empty();
    if (name.empty() && is_end) {
      file /= "index.html";
    } else if (is_file_name(name)) {
      file /= name;
    } else {
      return std::nullopt;
    }
  }
  std::error_code error;
  return fs::is_regular_file(file, error) ? std::optional(file) : std::nullopt;
}

std::optional<std::string> read_file(const fs::path& file) {
  std::error_code error;
  std::ifstream stream(file, std::ios::binary);
  if (!stream || fs::file_size(file, error) > kMaxFileBytes || error) return std::nullopt;
  return std::string(std::istreambuf_iterator(stream), {});
}

}  // namespace panvo::web_view
