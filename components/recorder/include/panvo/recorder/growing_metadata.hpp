// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "panvo/recorder/bag_metadata.hpp"

namespace panvo::recorder {

/// Messages written since the last commit.
struct Batch {
  std::uint64_t messages = 0;
  std::size_t bytes = 0;
  std::int64_t first_ns = 0, last_ns = 0;  ///< smallest and largest stamp; of no meaning without messages
  std::vector<std::uint64_t> by_topic;     ///< may be shorter than the number of topics

  void add(std::size_t topic, std::int64_t timestamp_ns, std::size_t size);
};

/// Metadata of a bag that is being written, with the counts by which a file can be taken out again.
class GrowingMetadata {
 public:
  BagMetadata& operator*() noexcept { return metadata_; }
  const BagMetadata& operator*() const noexcept { return metadata_; }
  BagMetadata* operator->() noexcept { return &metadata_; }
  const BagMetadata* operator->() const noexcept { return &metadata_; }

  /// Number of files begun, including those removed.
  std::size_t files_begun() const noexcept { return files_begun_; }
  void begin_file(const std::string& path);
  /// Adds a batch to the last file.
  void commit(const Batch& batch);
  /// Takes out the oldest files, so that at most `max_files` are left; returns their paths.
  std::vector<std::string> remove_oldest(std::size_t max_files);

 private:
  BagMetadata metadata_;
  std::size_t files_begun_ = 0;
  std::deque<std::vector<std::uint64_t>> by_topic_;  ///< messages of each file in metadata_
};

}  // namespace panvo::recorder
