// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/place_recording.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "panvo/evaluation/input_error.hpp"
#include "panvo/evaluation/trajectory_files.hpp"
#include "panvo/landmarks/panorama_describer.hpp"
#include "recording_files.hpp"

namespace panvo::evaluation {
namespace {

namespace fs = std::filesystem;

std::vector<RecordedVisit> read_visits(const fs::path& file, const YAML::Node& listed,
                                       const std::vector<RecordedPanorama>& panoramas) {
  std::vector<RecordedVisit> visits;
  if (!listed || !listed.IsSequence() || listed.size() == 0) {
    throw InputError(file, "lists no visits", "add the visits; place recognition is scored against them");
  }
  for (const auto& entry : listed) {
    RecordedVisit visit;
    try {
      visit.place = entry["id"].as<int>();
      visit.stamp_ns = entry["t_ns"].as<std::int64_t>();
    } catch (const YAML::Exception& error) {
      throw InputError(file, static_cast<std::size_t>(entry.Mark().line + 1), error.msg,
                       "a visit needs an id and t_ns, the stamp of the closest approach");
    }
    const auto distance = [&](const RecordedPanorama& panorama) {
      return std::abs(panorama.stamp_ns - visit.stamp_ns);
    };
    const auto nearest = std::min_element(panoramas.begin(), panoramas.end(),
                                          [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    visit.panorama = static_cast<std::size_t>(nearest - panoramas.begin());
    visits.push_back(visit);
  }
  std::stable_sort(visits.begin(), visits.end(), [](const auto& a, const auto& b) { return a.stamp_ns < b.stamp_ns; });
  return visits;
}

}  // namespace

PlaceRecording read_place_recording(const fs::path& folder) {
  PlaceRecording recording;
  recording.folder = folder;
  recording.base_from_panorama = read_extrinsics(folder / "mav0/cam2/sensor.yaml");
  const auto sequence_file = folder / "sequence.yaml";
  const auto sequence = read_yaml(sequence_file);
  recording.panoramas = list_panoramas(folder / "mav0/cam2/data", panorama_clock_offset_ns(sequence_file, sequence));
  const auto truth = read_euroc(folder / "mav0/state_groundtruth_estimate0/data.csv");
  locate(recording.panoramas, truth);
  recording.visits = read_visits(sequence_file, sequence["visits"], recording.panoramas);
  return recording;
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
