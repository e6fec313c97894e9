// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/place_recording.hpp"

#include <algorithm>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>

#include "panvo/dataset_player/image_file.hpp"
#include "panvo/evaluation/input_error.hpp"
#include "panvo/landmarks/panorama_check.hpp"
#include "panvo/landmarks/panorama_describer.hpp"

namespace panvo::evaluation {
namespace {

void assign_panoramas(PlaceRecording& recording) {
  const auto& panoramas = recording.panoramas;
  for (auto& visit : recording.visits) {
    const auto distance = [&](const RecordedPanorama& panorama) {
      return std::abs(panorama.stamp_ns - visit.stamp_ns);
    };
    const auto nearest = std::min_element(panoramas.begin(), panoramas.end(),
                                          [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    visit.panorama = static_cast<std::size_t>(nearest - panoramas.begin());
  }
}

}  // namespace

PlaceRecording read_place_recording(const std::filesystem::path& folder) {
  const auto journey = read_journey_recording(folder);
  if (journey.panoramas.empty()) {
    throw InputError(folder, "holds no panoramas",
                     "use a recording in EuRoC/ASL layout with equirectangular images in cam2");
  }
  if (journey.visits.empty()) {
    throw InputError(folder / "sequence.yaml", "lists no visits",
                     "add the visits; place recognition is scored against them");
  }
  PlaceRecording recording{folder, journey.base_from_panorama, journey.panoramas, {}};
  for (const auto& visit : journey.visits) recording.visits.push_back({visit.place, visit.stamp_ns, 0});
  assign_panoramas(recording);
  return recording;
}

void drop_unreadable(PlaceRecording& recording, const std::function<void(const std::string&)>& report) {
  dataset_player::ImageDecoder decoder;
  std::erase_if(recording.panoramas, [&](const RecordedPanorama& panorama) {
    cv::Mat image;
    auto fault = decoder.decode(panorama.file, dataset_player::Colour::kGrey, image);
    if (!fault && image.cols != 2 * image.rows) fault = panorama.file.string() + ": is not twice as wide as high";
    if (!fault) {
      if (const auto blind = landmarks::find_fault(image)) fault = panorama.file.string() + ": " + *blind;
    }
    if (fault) report(*fault);
    return fault.has_value();
  });
  if (recording.panoramas.empty()) throw InputError(recording.folder, "holds no readable panorama", "record it again");
  assign_panoramas(recording);
}

cv::Mat read_panorama(const RecordedPanorama& panorama) {
  const cv::Mat image = cv::imread(panorama.file.string(), cv::IMREAD_GRAYSCALE);
  if (image.empty()) throw InputError(panorama.file, "cannot be decoded as an image", "record it again or remove it");
  if (image.cols != 2 * image.rows) {
    throw InputError(panorama.file, "is not twice as wide as high", "use equirectangular panoramas");
  }
  return landmarks::to_described_size(image);
}

}  // namespace panvo::evaluation
