// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "panvo/landmarks/keypoint_source.hpp"

namespace panvo::position_corrector {

/// The SIFT features of landmarks received as messages, in an unnamed file that is deleted with the process: 40 kB per
/// landmark, needed for one landmark at a time. The page cache of the system makes a cache here unnecessary. If the
/// file cannot be created or written, features stay in memory.
class SpilledKeypoints final : public landmarks::KeypointSource {
 public:
  /// `folder`: on a disk. Empty: keep all in memory.
  explicit SpilledKeypoints(const std::filesystem::path& folder);
  ~SpilledKeypoints() override;

  /// Stores the keypoints of a landmark, replacing earlier ones.
  void put(std::uint32_t id, std::span<const landmarks::Keypoint> keypoints);

  /// Returns the stored keypoints bit by bit. Throws std::system_error if the file can no longer be read.
  std::vector<landmarks::Keypoint> keypoints(std::uint32_t id) const override;

  /// Why keypoints stay in memory; empty if the file works or none was requested.
  const std::string& problem() const noexcept { return problem_; }
  std::uint64_t bytes_in_file() const noexcept { return end_; }

 private:
  struct Place {
    std::uint64_t offset = 0;
    std::size_t count = 0;
  };
  void give_up(const std::string& what);

  int file_ = -1;
  std::uint64_t end_ = 0;
  std::map<std::uint32_t, Place> places_;
  std::map<std::uint32_t, std::vector<landmarks::Keypoint>> in_memory_;
  std::string problem_;
};

}  // namespace panvo::position_corrector
