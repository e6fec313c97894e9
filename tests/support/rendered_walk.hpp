// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>

namespace panvo::test {

/// A small rendered recording in KITTI layout: a rectified stereo pair, 320x240, f 240 px, baseline 0.2 m, moving
/// forward by 0.1 m per frame on a textured floor between textured walls. The true path is known exactly.
struct RenderedWalk {
  int frames = 20;
  /// Changes a pair before it is written: frame number, left, right.
  std::function<void(int, cv::Mat&, cv::Mat&)> spoil = [](int, cv::Mat&, cv::Mat&) {};

  /// Writes calib.txt, times.txt, poses.txt, image_0 and image_1 into `folder`.
  void write(const std::filesystem::path& folder) const;
};

}  // namespace panvo::test
