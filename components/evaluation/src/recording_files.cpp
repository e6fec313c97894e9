// SPDX-License-Identifier: Apache-2.0
#include "recording_files.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <string>

#include "panvo/evaluation/input_error.hpp"

namespace panvo::evaluation {
namespace {

namespace fs = std::filesystem;

Eigen::Isometry3d nearest_pose(const Trajectory& truth, std::int64_t stamp_ns) {
  const auto after = std::lower_bound(truth.poses.begin(), truth.poses.end(), stamp_ns,
                                      [](const StampedPose& pose, std::int64_t at) { return pose.stamp_ns < at; });
  if (after == truth.poses.end()) return truth.poses.back().world_from_base;
  if (after == truth.poses.begin() || after->stamp_ns == stamp_ns) return after->world_from_base;
  return interpolate(*std::prev(after), *after, stamp_ns);
}

}  // namespace

YAML::Node read_yaml(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) throw InputError(file, "cannot be read", "use a folder in EuRoC/ASL layout with a sequence.yaml");
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (text.starts_with("%YAML:")) text.replace(0, std::min(text.find('\n'), text.size()), "#");  // as OpenCV writes it
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw InputError(file, static_cast<std::size_t>(error.mark.line + 1), error.msg, "correct the file");
  }
}

Eigen::Isometry3d read_extrinsics(const fs::path& file) {
  const auto values = read_yaml(file)["T_BS"]["data"];
  if (!values || !values.IsSequence() || values.size() != 16) {
    throw InputError(file, "has no T_BS with 16 numbers", "add the pose of the panoramic camera on the vehicle");
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < 12; ++i) {
    pose.matrix()(static_cast<int>(i / 4), static_cast<int>(i % 4)) = values[i].as<double>();
  }
  return pose;
}

std::int64_t panorama_clock_offset_ns(const fs::path& file, const YAML::Node& sequence) {
  const auto offset = sequence["panorama_clock_offset_ns"];
  if (!offset) return 0;
  try {
    return offset.as<std::int64_t>();
  } catch (const YAML::Exception& error) {
    throw InputError(file, static_cast<std::size_t>(error.mark.line + 1), error.msg,
                     "panorama_clock_offset_ns must be a whole number of nanoseconds");
  }
}

std::vector<RecordedPanorama> list_panoramas(const fs::path& folder, std::int64_t clock_offset_ns) {
  std::vector<RecordedPanorama> panoramas;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    RecordedPanorama panorama;
    panorama.file = entry.path();
    const auto stem = panorama.file.stem().string();
    const auto read = std::from_chars(stem.data(), stem.data() + stem.size(), panorama.stamp_ns);
    if (read.ptr != stem.data() + stem.size() || stem.empty()) continue;
    panorama.stamp_ns -= clock_offset_ns;
    panoramas.push_back(panorama);
  }
  if (panoramas.empty()) {
    throw InputError(folder, "holds no image named by its stamp", "use a recording with panoramas");
  }
  std::sort(panoramas.begin(), panoramas.end(), [](const auto& a, const auto& b) { return a.stamp_ns < b.stamp_ns; });
  return panoramas;
}

void locate(std::vector<RecordedPanorama>& panoramas, const Trajectory& truth) {
  double travelled_m = 0.0;
  for (std::size_t i = 0; i < panoramas.size(); ++i) {
    panoramas[i].world_from_base = nearest_pose(truth, panoramas[i].stamp_ns);
    if (i > 0) {
      travelled_m +=
          (panoramas[i].world_from_base.translation() - panoramas[i - 1].world_from_base.translation()).norm();
    }
    panoramas[i].travelled_m = travelled_m;
  }
}

}  // namespace panvo::evaluation
