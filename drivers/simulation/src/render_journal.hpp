// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "panvo/simulation/simulation.hpp"

namespace panvo::simulation {

/// How far a rendering has come, in a file beside its images: a line for each instant whose images are on disk, with the
/// exposure after it, so that one that was interrupted goes on to the same pixels. As long as one is open, nobody else
/// can open that file. Every failure throws std::runtime_error naming the file.
class RenderJournal {
 public:
  struct Entry {
    std::int64_t stamp_ns;
    Exposure exposure;
  };

  /// Begins the journal, or goes on with the one that is there.
  explicit RenderJournal(std::filesystem::path file);
  ~RenderJournal();
  RenderJournal(const RenderJournal&) = delete;
  RenderJournal& operator=(const RenderJournal&) = delete;

  /// What was there when it was opened, up to the first line that is not whole.
  const std::vector<Entry>& found() const { return found_; }

  /// Forgets what was found from entry `count` on.
  void keep(std::size_t count);

  void add(const Entry& entry);

 private:
  std::filesystem::path path_;
  int file_;
  std::vector<Entry> found_;
};

}  // namespace panvo::simulation
