// SPDX-License-Identifier: Apache-2.0
#include "head_watch.hpp"

#include <algorithm>
#include <optional>

#include "panvo/vision/image_check.hpp"

namespace panvo::panorama_stitcher {
namespace {

constexpr int kSamples = 256;  // samples along the shorter side; find_fault() samples even more sparsely

/// Describes why an image is dark; nullopt if it is not. Uses the green channel of colour images.
std::optional<std::string> find_darkness(const cv::Mat& picture) {
  const int step = std::max(1, std::min(picture.rows, picture.cols) / kSamples);
  cv::Mat sample(picture.rows / step, picture.cols / step, CV_8UC1);
  const int channels = picture.channels();
  for (int row = 0; row < sample.rows; ++row) {
    const uchar* from = picture.ptr(row * step) + channels / 2;
    for (int column = 0; column < sample.cols; ++column) sample.at<uchar>(row, column) = from[column * step * channels];
  }
  auto fault = vision::find_fault(sample);
  return fault && fault->starts_with("is black") ? fault : std::nullopt;
}

}  // namespace

bool HeadWatch::look(const std::vector<cv::Mat>& images) {
  bool has_changed = false;
  for (std::size_t i = 0; i < heads_.size(); ++i) {
    State& head = heads_[i];
    const cv::Mat& image = images.at(rig_.heads[i].image);
    std::string state = "seen";
    bool is_usable = true;
    if (image.empty()) {
      state = "missing";
      is_usable = false;
      head.dark = 0;
    } else if (const auto darkness = find_darkness(image(rig_.heads[i].region_px))) {
      head.dark = std::min(head.dark + 1, dark_after_);
      is_usable = head.dark < dark_after_;
      if (!is_usable) state = "dark, " + *darkness;
    } else {
      head.dark = 0;
    }
    has_changed = has_changed || is_usable != head.is_usable;
    head.state = state;
    head.is_usable = is_usable;
  }
  return has_changed;
}

std::vector<bool> HeadWatch::usable() const {
  std::vector<bool> usable;
  for (const auto& head : heads_) usable.push_back(head.is_usable);
  return usable;
}

}  // namespace panvo::panorama_stitcher
