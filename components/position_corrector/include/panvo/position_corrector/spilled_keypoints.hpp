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

/// The SIFT features of landmarks that came as messages, in a file without a name that is gone with the process: 40 kB a
/// landmark that are needed for one at a time. What was read or written lately the system keeps in memory of its own, as
/// long as it has any to spare, so there is no cache here. Where the file cannot be made or takes no more, they stay in memory.
class SpilledKeypoints final : public landmarks::KeypointSource {
 public:
  /// `folder`: on a disk. Empty: everything stays in memory.
  explicit SpilledKeypoints(const std::filesystem::path& folder);
  ~SpilledKeypoints() override;

  /// Those of a landmark; put again, they replace the ones before.
  void put(std::uint32_t id, std::span<const landmarks::Keypoint> keypoints);

  /// Bit for bit what was put. Throws std::system_error where the file can no longer be read.
  std::vector<landmarks::Keypoint> keypoints(std::uint32_t id) const override;

  /// Why keypoints stay in memory; empty as long as the file takes them, or none was asked for.
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
