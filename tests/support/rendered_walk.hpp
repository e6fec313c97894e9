// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>

namespace panvo::test {

/// A small KITTI-like recording made on the spot: a rectified stereo pair, 320x240, f 240 px, baseline 0.2 m, that moves forward 0.1 m a frame
/// along a textured floor between textured walls. Its answer is known exactly.
struct RenderedWalk {
  int frames = 20;
  /// Changes a pair before it is written: frame number, left, right.
  std::function<void(int, cv::Mat&, cv::Mat&)> spoil = [](int, cv::Mat&, cv::Mat&) {};

  /// Writes calib.txt, times.txt, poses.txt, image_0 and image_1 into `folder`.
  void write(const std::filesystem::path& folder) const;
};

}  // namespace panvo::test
