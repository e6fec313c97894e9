// SPDX-License-Identifier: Apache-2.0
#include "recording.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace panvo::landmark_builder {
namespace {

namespace fs = std::filesystem;

std::ifstream open(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(file.string() + " cannot be read");
  return stream;
}

/// Skips OpenCV's first line, %YAML:1.0, which is not valid YAML.
YAML::Node read_yaml(const fs::path& file) {
  auto stream = open(file);
  std::string text, line;
  while (std::getline(stream, line)) {
    if (!line.starts_with("%YAML")) text += line + "\n";
  }
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

std::vector<std::vector<std::string>> read_csv(const fs::path& file) {
  auto stream = open(file);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line.starts_with('#')) continue;
    if (line.ends_with('\r')) line.pop_back();
    std::istringstream cells(line);
    auto& row = rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
  }
  return rows;
}

struct TruePose {
  std::int64_t stamp_ns;
  Eigen::Vector3d position;
  Eigen::Quaterniond rotation;
};

std::vector<TruePose> read_truth(const fs::path& file) {
  std::vector<TruePose> poses;
  for (const auto& row : read_csv(file)) {
    if (row.size() < 8) throw std::runtime_error(file.string() + ": a line has fewer than 8 columns");
    const auto number = [&](std::size_t i) { return std::stod(row[i]); };
    poses.push_back(
        {std::stoll(row[0]), {number(1), number(2), number(3)}, {number(4), number(5), number(6), number(7)}});
  }
  return poses;
}

}  // namespace

Recording read_recording(const fs::path& directory) {
  const fs::path folder = directory / "mav0" / "cam2";
  Recording recording;
  const YAML::Node sensor = read_yaml(folder / "sensor.yaml");
  const auto numbers = sensor["T_BS"]["data"].as<std::vector<double>>();
  if (numbers.size() != 16) throw std::runtime_error((folder / "sensor.yaml").string() + ": T_BS must have 16 numbers");
  for (int i = 0; i < 16; ++i)
    recording.base_from_panorama.matrix()(i / 4, i % 4) = numbers[static_cast<std::size_t>(i)];

  const auto truth = read_truth(directory / "mav0" / "state_groundtruth_estimate0" / "data.csv");
  for (const auto& row : read_csv(folder / "data.csv")) {
    if (row.size() < 2) throw std::runtime_error((folder / "data.csv").string() + ": a line has fewer than 2 columns");
    RecordedPanorama panorama{std::stoll(row[0]), folder / "data" / row[1], Eigen::Isometry3d::Identity()};
    const auto after = std::lower_bound(truth.begin(), truth.end(), panorama.stamp_ns,
                                        [](const TruePose& pose, std::int64_t stamp) { return pose.stamp_ns < stamp; });
    if (after == truth.end()) continue;
    if (after == truth.begin() && after->stamp_ns != panorama.stamp_ns) continue;
    const auto before = after == truth.begin() ? after : std::prev(after);
    const double share = after == before ? 0.0
                                         : static_cast<double>(panorama.stamp_ns - before->stamp_ns) /
                                               static_cast<double>(after->stamp_ns - before->stamp_ns);
    panorama.map_from_base.translation() = before->position + share * (after->position - before->position);
    panorama.map_from_base.linear() =
        before->rotation.normalized().slerp(share, after->rotation.normalized()).toRotationMatrix();
    recording.panoramas.push_back(std::move(panorama));
  }
  if (recording.panoramas.empty())
    throw std::runtime_error(folder.string() + " contains no panorama with ground truth");

  if (const fs::path list = directory / "sequence.yaml"; fs::exists(list)) {
    for (const auto& junction : read_yaml(list)["junctions"]) {
      recording.junctions.push_back({junction["id"].as<int>(),
                                     {junction["x"].as<double>(), junction["y"].as<double>()},
                                     junction["degree"].as<int>()});
    }
  }
  return recording;
}

}  // namespace panvo::landmark_builder
