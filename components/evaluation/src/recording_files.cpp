// SPDX-License-Identifier: Apache-2.0
#include "recording_files.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "panvo/evaluation/input_error.hpp"

namespace panvo::evaluation {
namespace {

namespace fs = std::filesystem;

Eigen::Isometry3d nearest_pose(const Trajectory& truth, std::int64_t stamp_ns) {
  if (const auto pose = pose_at(truth.poses, stamp_ns)) return *pose;
  return (stamp_ns < truth.poses.front().stamp_ns ? truth.poses.front() : truth.poses.back()).world_from_base;
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

std::vector<RecordedPanorama> list_panoramas(const dataset_player::PanoramaRecording& recorded,
                                             std::int64_t clock_offset_ns) {
  std::vector<RecordedPanorama> panoramas;
  for (const auto& [stamp_ns, image] : recorded.frames) panoramas.push_back({stamp_ns - clock_offset_ns, image});
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
