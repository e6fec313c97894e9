// SPDX-License-Identifier: Apache-2.0
#include "compass_recording.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace panvo::panoramic_compass {
namespace {

namespace fs = std::filesystem;

struct TruePose {
  std::int64_t stamp_ns;
  Eigen::Quaterniond map_from_base;
};

std::ifstream open(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(file.string() + " cannot be read");
  return stream;
}

/// Rotation of T_BS in a sensor.yaml.
Eigen::Matrix3d read_rotation(const fs::path& file) {
  std::stringstream text;
  text << open(file).rdbuf();
  std::string all = text.str();
  const auto begin = all.find('[', all.find("T_BS"));
  if (begin == std::string::npos) throw std::runtime_error(file.string() + " has no T_BS");
  std::replace(all.begin(), all.end(), ',', ' ');
  std::istringstream numbers(all.substr(begin + 1));
  Eigen::Matrix4d body_from_sensor;
  for (int i = 0; i < 16; ++i) numbers >> body_from_sensor(i / 4, i % 4);
  if (!numbers) throw std::runtime_error(file.string() + ": T_BS must have 16 numbers");
  return Eigen::Quaterniond(body_from_sensor.topLeftCorner<3, 3>()).normalized().toRotationMatrix();
}

std::vector<TruePose> read_truth(const fs::path& file) {
  auto stream = open(file);
  std::vector<TruePose> poses;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line.starts_with('#')) continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream numbers(line);
    std::int64_t stamp_ns = 0;
    double x = 0, y = 0, z = 0, qw = 1, qx = 0, qy = 0, qz = 0;
    if (!(numbers >> stamp_ns >> x >> y >> z >> qw >> qx >> qy >> qz)) {
      throw std::runtime_error(file.string() + ": a line is not a pose");
    }
    poses.push_back({stamp_ns, Eigen::Quaterniond(qw, qx, qy, qz).normalized()});
  }
  return poses;
}

}  // namespace

CompassRecording read_compass_recording(const fs::path& directory, std::int64_t late_ns) {
  const fs::path folder = directory / "mav0" / "cam2";
  CompassRecording recording;
  recording.base_from_panorama = read_rotation(folder / "sensor.yaml");
  const auto truth = read_truth(directory / "mav0" / "state_groundtruth_estimate0" / "data.csv");
  auto list = open(folder / "data.csv");
  for (std::string line; std::getline(list, line);) {
    if (line.empty() || line.starts_with('#')) continue;
    const auto comma = line.find(',');
    std::string name = line.substr(comma + 1);
    if (name.ends_with('\r')) name.pop_back();
    const std::int64_t stamp_ns = std::stoll(line), taken_ns = stamp_ns + late_ns;
    const auto after = std::lower_bound(truth.begin(), truth.end(), taken_ns,
                                        [](const TruePose& pose, std::int64_t at) { return pose.stamp_ns < at; });
    if (after == truth.end() || (after == truth.begin() && after->stamp_ns != taken_ns)) continue;
    const auto before = after->stamp_ns == taken_ns ? after : std::prev(after);
    const double share = after == before ? 0.0
                                         : static_cast<double>(taken_ns - before->stamp_ns) /
                                               static_cast<double>(after->stamp_ns - before->stamp_ns);
    recording.panoramas.push_back(
        {stamp_ns, folder / "data" / name, before->map_from_base.slerp(share, after->map_from_base)});
  }
  if (recording.panoramas.empty())
    throw std::runtime_error(folder.string() + " contains no panorama covered by the ground truth");
  return recording;
}

double true_change_rad(const RecordedPanorama& then, const RecordedPanorama& now) {
  const Eigen::Matrix3d then_from_now = (then.map_from_base.conjugate() * now.map_from_base).toRotationMatrix();
  return std::atan2(then_from_now(1, 0), then_from_now(0, 0));
}

}  // namespace panvo::panoramic_compass
