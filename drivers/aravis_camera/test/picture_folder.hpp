// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace panvo::aravis_camera::testing {

/// Pictures for simulated cameras, from the subfolders image_0, image_1, ...: all cameras show the same index at a
/// time, driven by the clock. The first picture is shown until all cameras have streamed for a while, the last one
/// until the end.
class PictureFolder {
 public:
  PictureFolder(const std::filesystem::path& folder, std::size_t cameras, double rate_hz)
      : period_ns_(static_cast<std::int64_t>(1e9 / rate_hz)), pictures_(cameras), shown_ns_(cameras) {
    for (std::size_t i = 0; i < cameras; ++i) {
      std::vector<std::filesystem::path> files;
      for (const auto& entry : std::filesystem::directory_iterator(folder / ("image_" + std::to_string(i))))
        files.push_back(entry.path());
      std::sort(files.begin(), files.end());
      for (const auto& file : files) pictures_[i].push_back(cv::imread(file.string(), cv::IMREAD_GRAYSCALE));
      if (pictures_[i].empty()) throw std::runtime_error("no pictures in " + folder.string());
    }
  }

  void draw(unsigned camera, std::int64_t now_ns, std::span<std::uint8_t> pixels) {
    const cv::Mat& picture = pictures_[camera].at(index(camera, now_ns));
    std::memcpy(pixels.data(), picture.data, std::min(pixels.size(), picture.total()));
  }

 private:
  /// The picture index, equal for all cameras within a period. Periods change half a period away from the exposures.
  /// The index advances only after a period in which all cameras took a frame at about the same time, so that pairs show
  /// every picture also if the host is busy.
  std::size_t index(unsigned camera, std::int64_t now_ns) {
    constexpr int kWhile = 20;  // periods of the first picture, until the driver under test streams
    const std::lock_guard lock(mutex_);
    const std::int64_t period = (now_ns + period_ns_ / 2) / period_ns_;
    if (period > period_) {
      if (is_shown_together()) ++periods_of_all_;
      shown_ns_.assign(shown_ns_.size(), std::nullopt);
      period_ = period;
    }
    shown_ns_[camera] = now_ns;
    return static_cast<std::size_t>(
        std::clamp<std::int64_t>(periods_of_all_ - kWhile, 0, std::ssize(pictures_[camera]) - 1));
  }

  /// A driver that pairs frames takes those for one pair that lie less than half a period apart.
  bool is_shown_together() const {
    constexpr double kTogether = 0.4;  // periods
    const auto [first, last] = std::minmax_element(shown_ns_.begin(), shown_ns_.end());
    return *first && static_cast<double>(**last - **first) < kTogether * static_cast<double>(period_ns_);
  }

  const std::int64_t period_ns_;
  std::mutex mutex_;
  std::vector<std::vector<cv::Mat>> pictures_;
  std::int64_t period_ = 0, periods_of_all_ = 0;
  std::vector<std::optional<std::int64_t>> shown_ns_;  // in this period, by camera
};

}  // namespace panvo::aravis_camera::testing
