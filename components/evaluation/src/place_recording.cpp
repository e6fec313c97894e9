// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/place_recording.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "panvo/evaluation/input_error.hpp"
#include "panvo/evaluation/trajectory_files.hpp"
#include "panvo/landmarks/panorama_describer.hpp"

namespace panvo::evaluation {
namespace {

namespace fs = std::filesystem;

YAML::Node read_yaml(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) throw InputError(file, "cannot be read", "give a folder in the EuRoC/ASL layout with its sequence.yaml");
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (text.starts_with("%YAML:")) text.replace(0, std::min(text.find('\n'), text.size()), "#");  // OpenCV's spelling
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw InputError(file, static_cast<std::size_t>(error.mark.line + 1), error.msg, "correct it");
  }
}

Eigen::Isometry3d read_extrinsics(const fs::path& file) {
  const auto values = read_yaml(file)["T_BS"]["data"];
  if (!values || !values.IsSequence() || values.size() != 16) {
    throw InputError(file, "has no T_BS with 16 numbers", "say there where the panorama sits on the vehicle");
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < 12; ++i) {
    pose.matrix()(static_cast<int>(i / 4), static_cast<int>(i % 4)) = values[i].as<double>();
  }
  return pose;
}

std::vector<RecordedPanorama> list_panoramas(const fs::path& folder) {
  std::vector<RecordedPanorama> panoramas;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    RecordedPanorama panorama;
    panorama.file = entry.path();
    const auto stem = panorama.file.stem().string();
    const auto read = std::from_chars(stem.data(), stem.data() + stem.size(), panorama.stamp_ns);
    if (read.ptr == stem.data() + stem.size() && !stem.empty()) panoramas.push_back(panorama);
  }
  if (panoramas.empty()) {
    throw InputError(folder, "holds no image named by its stamp", "give a recording with panoramas");
  }
  std::sort(panoramas.begin(), panoramas.end(), [](const auto& a, const auto& b) { return a.stamp_ns < b.stamp_ns; });
  return panoramas;
}

Eigen::Isometry3d pose_at(const Trajectory& truth, std::int64_t stamp_ns) {
  const auto after = std::lower_bound(truth.poses.begin(), truth.poses.end(), stamp_ns,
                                      [](const StampedPose& pose, std::int64_t at) { return pose.stamp_ns < at; });
  if (after == truth.poses.end()) return truth.poses.back().world_from_base;
  if (after == truth.poses.begin() || after->stamp_ns == stamp_ns) return after->world_from_base;
  return interpolate(*std::prev(after), *after, stamp_ns);
}

std::vector<RecordedVisit> read_visits(const fs::path& file, const std::vector<RecordedPanorama>& panoramas) {
  std::vector<RecordedVisit> visits;
  const auto listed = read_yaml(file)["visits"];
  if (!listed || !listed.IsSequence() || listed.size() == 0) {
    throw InputError(file, "lists no visits", "places can only be scored where somebody says which they are");
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
  recording.panoramas = list_panoramas(folder / "mav0/cam2/data");
  const auto truth = read_euroc(folder / "mav0/state_groundtruth_estimate0/data.csv");
  double travelled_m = 0.0;
  for (std::size_t i = 0; i < recording.panoramas.size(); ++i) {
    auto& panorama = recording.panoramas[i];
    panorama.world_from_base = pose_at(truth, panorama.stamp_ns);
    if (i > 0) {
      travelled_m +=
          (panorama.world_from_base.translation() - recording.panoramas[i - 1].world_from_base.translation()).norm();
    }
    panorama.travelled_m = travelled_m;
  }
  recording.visits = read_visits(folder / "sequence.yaml", recording.panoramas);
  return recording;
}

cv::Mat read_panorama(const RecordedPanorama& panorama) {
  const cv::Mat image = cv::imread(panorama.file.string(), cv::IMREAD_GRAYSCALE);
  if (image.empty()) throw InputError(panorama.file, "is no image that can be decoded", "record it again or remove it");
  if (image.cols != 2 * image.rows) {
    throw InputError(panorama.file, "is not twice as wide as high", "give equirectangular panoramas");
  }
  return landmarks::to_described_size(image);
}

}  // namespace panvo::evaluation
