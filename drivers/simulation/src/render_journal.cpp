// SPDX-License-Identifier: Apache-2.0
#include "render_journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

#include "write_failure.hpp"

namespace panvo::simulation {
namespace {

/// Gains in hexadecimal, which is exact: otherwise pixels would differ.
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
    if (stream.eof() || line + '\n' != line_of(entry)) break;  // incomplete, or of another origin
    entries.push_back(entry);
  }
  return entries;
}

}  // namespace

RenderJournal::RenderJournal(std::filesystem::path file)
    : path_(std::move(file)), file_(open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
  if (file_ < 0) fail_to_write(path_);
  if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
    close(file_);
    throw std::runtime_error(path_.string() + ": another process renders there; wait for it, or choose another folder");
  }
  found_ = read_entries(path_);
}

RenderJournal::~RenderJournal() { close(file_); }

void RenderJournal::keep(std::size_t count) {
  if (count < found_.size()) found_.resize(count);
  std::size_t bytes = 0;
  for (const auto& entry : found_) bytes += line_of(entry).size();
  if (ftruncate(file_, static_cast<off_t>(bytes)) != 0) fail_to_write(path_);
}

void RenderJournal::add(const Entry& entry) {
  const auto line = line_of(entry);
  if (write(file_, line.data(), line.size()) != static_cast<ssize_t>(line.size())) fail_to_write(path_);
}

}  // namespace panvo::simulation
