// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "panvo/simulation/simulation.hpp"

namespace panvo::simulation {

/// The progress of a rendering, in a file beside its images: one line per instant whose images are on disk, with the
/// exposure after it, so that an interrupted rendering resumes with identical pixels. An open journal locks its file
/// against other processes. Every failure throws std::runtime_error with the file name.
class RenderJournal {
 public:
  struct Entry {
    std::int64_t stamp_ns;
    Exposure exposure;
  };

  /// Creates the journal, or opens an existing one.
  explicit RenderJournal(std::filesystem::path file);
  ~RenderJournal();
  RenderJournal(const RenderJournal&) = delete;
  RenderJournal& operator=(const RenderJournal&) = delete;

  /// The entries that existed on opening, up to the first incomplete line.
  const std::vector<Entry>& found() const { return found_; }

  /// Discards the found entries from index `count` on.
  void keep(std::size_t count);

  void add(const Entry& entry);

 private:
  std::filesystem::path path_;
  int file_;
  std::vector<Entry> found_;
};

}  // namespace panvo::simulation
