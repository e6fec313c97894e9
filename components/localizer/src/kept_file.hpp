// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace panvo::localizer {

/// Lines of "key value value ...", as the localizer keeps what the next run needs.
using Lines = std::map<std::string, std::string>;

/// A kind of file with such lines. A file with other keys is of another kind or of a newer version: one that a user
/// named by mistake is not to be lost.
struct FileKind {
  std::string content;            ///< for messages: "pose"
  std::vector<std::string> keys;  ///< of this version
};

/// The lines of an existing file. Throws std::runtime_error if it is none of this kind.
Lines read_lines(const std::filesystem::path& file, const FileKind& kind);

/// What is wrong with a file, and what to do.
std::runtime_error unusable(const std::filesystem::path& file, const FileKind& kind, const std::string& problem);

/// `parse(lines)` of a file; nullopt if there is none. Throws std::runtime_error naming the file, the problem and the
/// remedy.
template <class Value>
std::optional<Value> read_kept(const std::filesystem::path& file, const FileKind& kind, Value (*parse)(const Lines&)) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  try {
    return parse(read_lines(file, kind));
  } catch (const std::runtime_error& error) {
    throw unusable(file, kind, error.what());
  }
}

/// Replaces a file of this kind, even a damaged one, or writes a new one. Atomically, so that a killed process leaves the
/// old one intact; with several writers the last one wins. Throws std::runtime_error naming the file and the remedy.
void write_kept(const std::filesystem::path& file, const FileKind& kind, const std::string& text);

}  // namespace panvo::localizer
