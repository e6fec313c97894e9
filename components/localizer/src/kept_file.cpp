// SPDX-License-Identifier: Apache-2.0
#include "kept_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <system_error>

namespace panvo::localizer {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestKept = 64 * 1024;  // bytes: of a few lines of numbers, with a wide margin
constexpr const char* kLeftAsItIs =
    "it is of another kind or of a newer version and left as it is: name another file, or delete the file";

/// Neither a device nor a pipe, which reading may wait for.
bool is_small(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error) && fs::file_size(file, error) <= kLargestKept && !error;
}

std::string key_of(const std::string& line) { return line.substr(0, line.find(' ')); }

bool has_key(const FileKind& kind, const std::string& key) {
  return std::ranges::find(kind.keys, key) != kind.keys.end();
}

/// Also if it is damaged: empty, cut off in a line, or with wrong numbers.
bool is_of_kind(const fs::path& file, const FileKind& kind) {
  if (!is_small(file)) return false;
  std::ifstream stream(file);
  if (!stream) return false;
  bool has_any = false;
  for (std::string line; std::getline(stream, line); has_any = true) {
    const bool is_cut_off = has_any && stream.eof();
    if (!is_cut_off && !has_key(kind, key_of(line))) return false;
  }
  return !stream.bad();
}

/// A new file next to another, of this writer alone: others may write the same one, even from another container with
/// equal process identifiers.
fs::path make_part(const fs::path& file) {
  static std::atomic<unsigned> count = 0;
  while (true) {
    fs::path part = file;
    part += fmt::format(".{}-{}.part", ::getpid(), count++);
    const int descriptor = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno == EEXIST) continue;
    if (descriptor >= 0) ::close(descriptor);
    return part;
  }
}

}  // namespace

Lines read_lines(const fs::path& file, const FileKind& kind) {
  if (!is_small(file)) throw std::runtime_error("it is not a short text file");
  std::ifstream stream(file);
  Lines lines;
  for (std::string line; std::getline(stream, line);) {
    const std::string key = key_of(line);
    if (!has_key(kind, key)) throw std::runtime_error(fmt::format("'{}' is unknown", key));
    lines[key] = line.substr(std::min(key.size() + 1, line.size()));
  }
  return lines;
}

std::runtime_error unusable(const fs::path& file, const FileKind& kind, const std::string& problem) {
  return std::runtime_error(
      fmt::format("{} contains no valid {}: {}; {}", file.string(), kind.content, problem,
                  is_of_kind(file, kind) ? "delete the file, a new one will be written" : kLeftAsItIs));
}

void write_kept(const fs::path& file, const FileKind& kind, const std::string& text) {
  std::error_code error;
  if (fs::exists(file, error) && !is_of_kind(file, kind)) {
    throw std::runtime_error(fmt::format("{} is not replaced by a {}: {}", file.string(), kind.content, kLeftAsItIs));
  }
  const fs::path part = make_part(file);
  std::ofstream stream(part);
  stream << text;
  stream.close();
  if (stream) fs::rename(part, file, error);
  if (stream && !error) return;
  fs::remove(part, error);
  throw std::runtime_error(
      fmt::format("cannot write {}: name a file in an existing, writable folder with free space", file.string()));
}

}  // namespace panvo::localizer
