// SPDX-License-Identifier: Apache-2.0
#include "render_journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

namespace panvo::simulation {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file) {
  throw std::runtime_error(fmt::format("{}: cannot be written ({}); free space there or name another folder",
                                       file.string(), std::strerror(errno)));
}

/// Gains in hexadecimal: to the last bit, or the pixels would not be the same.
std::string line_of(const RenderJournal::Entry& entry) {
  return fmt::format("{},{:a},{:a}\n", entry.stamp_ns, entry.exposure.stereo_gain, entry.exposure.panorama_gain);
}

std::vector<RenderJournal::Entry> read_entries(const std::filesystem::path& file) {
  std::vector<RenderJournal::Entry> entries;
  std::ifstream stream(file, std::ios::binary);
  for (std::string line; std::getline(stream, line);) {
    long long stamp_ns = 0;
    Exposure exposure;
    if (std::sscanf(line.c_str(), "%lld,%la,%la", &stamp_ns, &exposure.stereo_gain, &exposure.panorama_gain) != 3)
      break;
    const RenderJournal::Entry entry{stamp_ns, exposure};
    if (stream.eof() || line + '\n' != line_of(entry)) break;  // written in part, or not by us
    entries.push_back(entry);
  }
  return entries;
}

}  // namespace

RenderJournal::RenderJournal(std::filesystem::path file)
    : path_(std::move(file)), file_(open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
  if (file_ < 0) fail(path_);
  if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
    close(file_);
    throw std::runtime_error(path_.string() + ": another process renders there; wait for it, or name another folder");
  }
  found_ = read_entries(path_);
}

RenderJournal::~RenderJournal() { close(file_); }

void RenderJournal::keep(std::size_t count) {
  if (count < found_.size()) found_.resize(count);
  std::string text;
  for (const auto& entry : found_) text += line_of(entry);
  if (ftruncate(file_, 0) != 0) fail(path_);
  append(text);
}

void RenderJournal::add(const Entry& entry) { append(line_of(entry)); }

void RenderJournal::append(const std::string& text) {
  if (write(file_, text.data(), text.size()) != static_cast<ssize_t>(text.size())) fail(path_);
}

}  // namespace panvo::simulation
