// SPDX-License-Identifier: Apache-2.0
#include "panvo/panorama_stitcher/panorama_stitcher.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "panvo/vision/packed_lookup.hpp"

namespace panvo::panorama_stitcher {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr std::size_t kRunsAhead = 1;
constexpr int kDarkest = 8, kBrightest = 247;  // grey levels outside this range are not used for the gains

void check(const PanoramaRig& rig, const StitchSettings& settings) {
  if (rig.heads.empty() || rig.heads.size() >= kNoHead)
    throw std::invalid_argument("a rig of " + std::to_string(rig.heads.size()) + " heads cannot be stitched");
  if (settings.columns < 2 || settings.columns % 2 != 0)
    throw std::invalid_argument("a panorama of " + std::to_string(settings.columns) +
                                " columns is not possible; the number must be even and positive");
}

void check(const StitchTable& table) {
  if (!table.gap) return;
  std::ostringstream text;
  text.precision(3);
  text << "no head sees " << 100.0 * table.gap->share << " % of the required elevation range, for instance azimuth "
       << table.gap->azimuth_rad * kDegrees << " degrees (clockwise from ahead), elevation "
       << -table.gap->elevation_rad * kDegrees << " degrees (upwards)";
  throw std::invalid_argument(text.str());
}

int grey(const cv::Mat& image, std::uint32_t offset_px) {
  const int channels = image.channels();
  const uchar* pixel = image.data + std::size_t{offset_px} * static_cast<std::size_t>(channels);
  return channels == 1 ? pixel[0] : (pixel[0] + pixel[1] + pixel[2]) / 3;
}

}  // namespace

PanoramaStitcher::PanoramaStitcher(PanoramaRig rig, const StitchSettings& settings)
    : rig_(std::move(rig)),
      settings_(settings),
      is_used_(rig_.heads.size(), true),
      gains_(rig_.heads.size(), settings.gains),
      factors_(rig_.heads.size(), vision::kUnitFactor) {
  panorama_stitcher::check(rig_, settings_);
  table_ = make_stitch_table(rig_, settings_.columns, is_used_);
  panorama_stitcher::check(table_);
}

void PanoramaStitcher::use(const std::vector<bool>& heads) {
  if (heads.size() != rig_.heads.size()) throw std::invalid_argument("use() needs one flag for each head");
  if (heads == is_used_) return;
  is_used_ = heads;
  table_ = make_stitch_table(rig_, settings_.columns, is_used_);
}

std::optional<std::string> PanoramaStitcher::find_fault(std::size_t image, const cv::Mat& pixels) const {
  std::ostringstream text;
  for (const auto& head : rig_.heads) {
    if (head.image != image) continue;
    if (pixels.size() != head.image_size_px) {
      text << "is " << pixels.cols << " x " << pixels.rows << " px, but head '" << head.name
           << "' is calibrated for images of " << head.image_size_px.width << " x " << head.image_size_px.height
           << " px; set the camera to that size, or calibrate it at its present size";
    } else if (pixels.type() != CV_8UC1 && pixels.type() != CV_8UC3) {
      text << "has type " << cv::typeToString(pixels.type()) << "; set the camera to mono8, rgb8 or bgr8";
    } else {
      continue;
    }
    return text.str();
  }
  return std::nullopt;
}

/// Validates the images. Returns the common type of those that are used.
int PanoramaStitcher::check(std::span<const cv::Mat> images) const {
  if (images.size() != rig_.images()) {
    throw std::invalid_argument(std::to_string(images.size()) + " images given to a rig with " +
                                std::to_string(rig_.images()));
  }
  int type = CV_8UC1;
  bool is_first = true;
  for (std::size_t i = 0; i < rig_.heads.size(); ++i) {
    if (!is_used_[i]) continue;
    const std::size_t image = rig_.heads[i].image;
    if (const auto fault = find_fault(image, images[image]))
      throw std::invalid_argument("image " + std::to_string(image) + " " + *fault);
    if (!is_first && images[image].type() != type)
      throw std::invalid_argument(
          "the heads' images are partly grey, partly colour; set all cameras to the same encoding");
    type = images[image].type();
    is_first = false;
  }
  return type;
}

void PanoramaStitcher::stitch(std::span<const cv::Mat> given, cv::Mat& panorama) {
  const int type = check(given);
  std::vector<cv::Mat> images;  // continuous, as the look-ups require
  for (const auto& image : given) images.push_back(image.isContinuous() ? image : image.clone());
  if (settings_.compensates_gains) compensate(images);
  panorama.create(table_.rows, table_.columns, type);
  if (!panorama.isContinuous()) panorama = cv::Mat(table_.rows, table_.columns, type);

  const int channels = panorama.channels();
  const auto bytes = static_cast<std::size_t>(channels);
  const auto source = [&](std::uint8_t head, std::uint32_t base_px) {
    const cv::Mat& image = images[rig_.heads[head].image];
    return vision::LookupSource{image.data + base_px * bytes, image.cols, factors_[head]};
  };
  for (std::size_t i = 0; i < table_.runs.size(); ++i) {
    const auto& run = table_.runs[i];
    if (i + kRunsAhead < table_.runs.size()) {
      const auto& later = table_.runs[i + kRunsAhead];
      const std::uint32_t* lookups = table_.lookups.data() + later.lookups;
      const auto count = static_cast<int>(later.count);
      if (later.first != kNoHead)
        vision::prefetch_lookups(source(later.first, later.first_base_px), lookups, count, channels);
      if (later.second != kNoHead)
        vision::prefetch_lookups(source(later.second, later.second_base_px), lookups + count, count, channels);
    }
    uchar* destination = panorama.data + run.destination_px * bytes;
    const auto count = static_cast<int>(run.count);
    const std::uint32_t* lookups = table_.lookups.data() + run.lookups;
    if (run.first == kNoHead) {
      std::memset(destination, 0, run.count * bytes);
    } else if (run.second == kNoHead) {
      vision::look_up(source(run.first, run.first_base_px), lookups, count, channels, destination);
    } else {
      vision::look_up_blended(source(run.first, run.first_base_px), lookups, source(run.second, run.second_base_px),
                              lookups + count, table_.weights.data() + run.weights, count, channels, destination);
    }
  }
  patch(images, panorama);
}

void PanoramaStitcher::patch(std::span<const cv::Mat> images, cv::Mat& panorama) const {
  constexpr int kUnity = vision::kLookupFraction;
  const int channels = panorama.channels();
  for (const auto& patch : table_.patches) {
    const cv::Mat& image = images[rig_.heads[patch.head].image];
    uchar* destination = panorama.data + std::size_t{patch.destination_px} * static_cast<std::size_t>(channels);
    for (int channel = 0; channel < channels; ++channel) {
      const auto value = [&](std::size_t neighbour) {
        return int{image.data[std::size_t{patch.neighbours_px.at(neighbour)} * static_cast<std::size_t>(channels) +
                              static_cast<std::size_t>(channel)]};
      };
      const int upper = value(0) * (kUnity - patch.across) + value(1) * patch.across;
      const int lower = value(2) * (kUnity - patch.across) + value(3) * patch.across;
      const std::int64_t sum = std::int64_t{upper * (kUnity - patch.down) + lower * patch.down} * factors_[patch.head];
      destination[channel] = static_cast<uchar>(std::min<std::int64_t>(255, (sum + (1 << 17)) >> 18));
    }
  }
}

void PanoramaStitcher::compensate(std::span<const cv::Mat> images) {
  const std::size_t heads = rig_.heads.size();
  std::vector<GainCompensator::Overlap> overlaps(heads * heads);
  for (const auto& sample : table_.samples) {
    const int first = grey(images[rig_.heads[sample.first].image], sample.first_px);
    const int second = grey(images[rig_.heads[sample.second].image], sample.second_px);
    if (std::min(first, second) < kDarkest || std::max(first, second) > kBrightest) continue;
    auto& overlap = overlaps[sample.first * heads + sample.second];
    overlap.first = sample.first;
    overlap.second = sample.second;
    overlap.first_sum += first;
    overlap.second_sum += second;
    ++overlap.samples;
  }
  gains_.update(overlaps);
  for (std::size_t head = 0; head < heads; ++head) {
    factors_[head] =
        std::clamp(static_cast<int>(std::lround(vision::kUnitFactor * gains_.gain(head))), 0, vision::kMaxFactor);
  }
}

}  // namespace panvo::panorama_stitcher
