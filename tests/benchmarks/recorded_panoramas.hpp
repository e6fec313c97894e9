// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "panvo/test/recorded_data.hpp"

/// The first half minute of the recording campus_journey, including a corner; empty if the recording is missing. Sets
/// OpenCV to one thread.
inline const std::vector<cv::Mat>& recorded_panoramas() {
  static const std::vector<cv::Mat> all = [] {
    constexpr std::size_t kMax = 150;
    std::vector<cv::Mat> images;
    const auto folder = panvo::test::recorded_data("campus_journey/mav0/cam2/data");
    std::vector<std::filesystem::path> files;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    files.resize(std::min(files.size(), kMax));
    for (const auto& file : files) images.push_back(cv::imread(file.string()));
    cv::setNumThreads(1);
    return images;
  }();
  return all;
}

/// If there are no panoramas, marks the benchmark as skipped and returns true.
inline bool lack_panoramas(benchmark::State& state) {
  if (!recorded_panoramas().empty()) return false;
  state.SkipWithError(panvo::test::missing_recording(panvo::test::recorded_data("campus_journey")).c_str());
  return true;
}
