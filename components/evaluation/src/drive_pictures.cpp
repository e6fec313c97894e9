// SPDX-License-Identifier: Apache-2.0
#include "drive_pictures.hpp"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "drive_clock.hpp"
#include "html_text.hpp"
#include "left_images.hpp"
#include "panorama_pair.hpp"
#include "panvo/evaluation/input_error.hpp"

namespace panvo::evaluation {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMost = 100;  // of each camera: about 6 MB together
constexpr int kLeftColumns = 480, kPanoramaColumns = 900, kThumbnailColumns = 360;
constexpr int kSmallQuality = 70;

std::string small_jpeg(const std::filesystem::path& file, int most_columns) {
  cv::Mat image = cv::imread(file.string(), cv::IMREAD_COLOR);
  if (image.empty()) throw InputError(file, "cannot be decoded as an image", "record it again or remove it");
  if (image.cols > most_columns) {
    const double scale = static_cast<double>(most_columns) / image.cols;
    cv::resize(image, image, {}, scale, scale, cv::INTER_AREA);
  }
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, kSmallQuality});
  return {bytes.begin(), bytes.end()};
}

/// `taken`: in order of time. `file_of`: of one of them.
template <class Taken, class FileOf>
Json along(const std::vector<Taken>& taken, const DriveClock& clock, int most_columns, FileOf file_of) {
  Json pictures = Json::array();
  const std::size_t step = std::max<std::size_t>(1, (taken.size() + kMost - 1) / kMost);
  for (std::size_t i = 0; i < taken.size(); i += step)
    pictures.push_back({clock.seconds(taken[i].stamp_ns), base64(small_jpeg(file_of(taken[i]), most_columns))});
  return pictures;
}

}  // namespace

Json drive_pictures(const JourneyFrames& frames) {
  const DriveClock clock(frames.run);
  return {{"left", along(left_images(frames.recording), clock, kLeftColumns, [](const auto& one) { return one.left; })},
          {"panorama", along(frames.recording.panoramas, clock, kPanoramaColumns,
                             [](const RecordedPanorama& one) { return one.file; })}};
}

std::string thumbnail(const JourneyFrames& frames, std::int64_t stamp_ns) {
  const auto* panorama = panorama_near(frames.recording, stamp_ns);
  if (!panorama && frames.earlier != nullptr) panorama = panorama_near(*frames.earlier, stamp_ns);
  return panorama ? small_jpeg(panorama->file, kThumbnailColumns) : std::string();
}

}  // namespace panvo::evaluation
