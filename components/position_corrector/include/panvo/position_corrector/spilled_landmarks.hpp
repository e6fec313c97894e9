// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "panvo/landmarks/landmark_source.hpp"

namespace panvo::position_corrector {

/// Descriptions and SIFT features of landmarks received as messages, in an unnamed file that is deleted with the
/// process: 48 kB per landmark. The page cache of the system makes a cache here unnecessary. If the file cannot be
/// created or written, they stay in memory.
class SpilledLandmarks final : public landmarks::LandmarkSource {
 public:
  /// `folder`: on a disk. Empty: keep all in memory.
  explicit SpilledLandmarks(const std::filesystem::path& folder);
  ~SpilledLandmarks() override;

  /// Stores keypoints and description of a landmark, replacing earlier ones.
  void put(std::uint32_t id, std::span<const landmarks::Keypoint> keypoints,
           const landmarks::PanoramaDescription& description = {});

  /// What was stored, bit by bit. Throws std::system_error if the file can no longer be read.
  std::vector<landmarks::Keypoint> keypoints(std::uint32_t id) const override;
  landmarks::PanoramaDescription description(std::uint32_t id) const override;

  /// Why landmarks stay in memory; empty if the file works or none was requested.
  const std::string& problem() const noexcept { return problem_; }
  std::uint64_t bytes_in_file() const noexcept { return end_; }

 private:
  struct Place {  // in the file: keypoints, bins of the histogram, large, small features
    std::uint64_t offset = 0;
    std::uint32_t keypoints = 0, bins = 0, large = 0, small = 0;
  };
  struct Kept {
    std::vector<landmarks::Keypoint> keypoints;
    landmarks::PanoramaDescription description;
  };
  template <class Record>
  std::vector<Record> read(std::uint64_t offset, std::size_t count) const;
  void give_up(const std::string& what);

  int file_ = -1;
  std::uint64_t end_ = 0;
  std::map<std::uint32_t, Place> places_;
  std::map<std::uint32_t, Kept> in_memory_;
  std::string problem_;
};

}  // namespace panvo::position_corrector
