// SPDX-License-Identifier: Apache-2.0
// panvo_image_statistics: compares image statistics of the left images of data sets, simulated and real.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include "image_statistics.hpp"
#include "panvo/dataset_player/dataset.hpp"
#include "panvo/dataset_player/image_file.hpp"

namespace panvo::testing {
namespace {

struct Range {
  double lowest, median, highest;
};

Range range_of(std::vector<double> values) {
  if (values.empty()) return {0, 0, 0};
  std::sort(values.begin(), values.end());
  return {values.front(), values[values.size() / 2], values.back()};
}

/// Statistics of one data set, for single frames and for pairs of frames.
class Measurement {
 public:
  explicit Measurement(const std::string& directory) {
    const auto dataset = dataset_player::open_dataset(directory);
    const auto& frames = dataset.stereo.value().frames;
    constexpr std::size_t kFrames = 24;
    const auto step = std::max<std::size_t>(1, frames.size() / kFrames);
    for (std::size_t i = 0; i < frames.size(); i += step) {
      const auto image = load(frames[i].left);
      single_.push_back(measure(image));
      for (std::size_t gap = 0; gap < kGaps.size(); ++gap) {
        if (i + kGaps[gap] < frames.size()) {
          survivals_[gap].push_back(survival(image, load(frames[i + kGaps[gap]].left)));
        }
      }
    }
  }

  Range of(const std::function<double(const ImageStatistics&)>& value) const {
    std::vector<double> values;
    for (const auto& statistics : single_) values.push_back(value(statistics));
    return range_of(values);
  }
  Range survival_after(std::size_t gap) const { return range_of(survivals_[gap]); }

  static constexpr std::array<std::size_t, 3> kGaps{1, 5, 25};  // frames

 private:
  cv::Mat load(const std::filesystem::path& file) {
    cv::Mat image;
    if (const auto problem = decoder_.decode(file, dataset_player::Colour::kGrey, image)) {
      throw std::runtime_error(*problem);
    }
    return image;
  }

  dataset_player::ImageDecoder decoder_;
  std::vector<ImageStatistics> single_;
  std::array<std::vector<double>, 3> survivals_;
};

void print(const std::vector<std::string>& directories) {
  std::vector<Measurement> measurements;
  fmt::print("{:32}", "lowest / median / highest");
  for (const auto& directory : directories) {
    measurements.emplace_back(directory);
    fmt::print("  {:>26}", std::filesystem::path(directory).filename().string().substr(0, 26));
  }
  fmt::print("\n");
  const auto row = [&](const std::string& name, int digits, const std::function<Range(const Measurement&)>& range) {
    fmt::print("{:32}", name);
    for (const auto& measurement : measurements) {
      const auto r = range(measurement);
      fmt::print("  {:>8.{}f}{:>9.{}f}{:>9.{}f}", r.lowest, digits, r.median, digits, r.highest, digits);
    }
    fmt::print("\n");
  };
  const auto single = [&](const std::string& name, int digits, double ImageStatistics::*value) {
    row(name, digits, [=](const Measurement& m) { return m.of([=](const ImageStatistics& s) { return s.*value; }); });
  };
  single("FAST corners per megapixel", 0, &ImageStatistics::fast_per_megapixel);
  single("SIFT keypoints per megapixel", 0, &ImageStatistics::sift_per_megapixel);
  single("gradient, median", 2, &ImageStatistics::gradient_median);
  single("gradient, 90 %", 2, &ImageStatistics::gradient_90);
  single("slope of the spectrum", 2, &ImageStatistics::spectrum_slope);
  for (std::size_t octave = 0; octave < 5; ++octave) {
    row(fmt::format("contrast of octave {}", octave), 2,
        [=](const Measurement& m) { return m.of([=](const ImageStatistics& s) { return s.octaves[octave]; }); });
  }
  for (std::size_t gap = 0; gap < Measurement::kGaps.size(); ++gap) {
    row(fmt::format("SIFT matched after {} frames", Measurement::kGaps[gap]), 3,
        [=](const Measurement& m) { return m.survival_after(gap); });
  }
}

}  // namespace
}  // namespace panvo::testing

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: panvo_image_statistics DATASET...\n";
    return 2;
  }
  try {
    panvo::testing::print({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "panvo_image_statistics: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
