// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/journey_recording.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "angle_units.hpp"
#include "of_data_set.hpp"
#include "panvo/dataset_player/ground_truth.hpp"
#include "panvo/evaluation/input_error.hpp"
#include "panvo/evaluation/trajectory_files.hpp"
#include "recording_files.hpp"

namespace panvo::evaluation {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const YAML::Node& entry, const YAML::Exception& error,
                       const char* remedy) {
  throw InputError(file, static_cast<std::size_t>(entry.Mark().line + 1), error.msg, remedy);
}

void read_places(JourneyRecording& recording, const fs::path& file, const YAML::Node& listed) {
  for (const auto& entry : listed) {
    try {
      recording.places[entry["id"].as<int>()] = {entry["name"].as<std::string>(""),
                                                 {entry["x"].as<double>(), entry["y"].as<double>()},
                                                 entry["degree"].as<int>(0)};
    } catch (const YAML::Exception& error) {
      fail(file, entry, error, "a junction needs an id, x and y");
    }
  }
}

void read_visits(JourneyRecording& recording, const fs::path& file, const YAML::Node& listed) {
  const TruePath path(recording.truth);
  for (const auto& entry : listed) {
    JourneyVisit visit;
    try {
      visit.place = entry["id"].as<int>();
      visit.stamp_ns = entry["t_ns"].as<std::int64_t>();
      visit.in_ns = entry["t_in_ns"].as<std::int64_t>(visit.stamp_ns);
      visit.out_ns = entry["t_out_ns"].as<std::int64_t>(visit.stamp_ns);
    } catch (const YAML::Exception& error) {
      fail(file, entry, error, "a visit needs an id and t_ns, the stamp of the closest approach");
    }
    const auto pose = path.pose(visit.stamp_ns);
    if (!pose) {
      throw InputError(file, static_cast<std::size_t>(entry.Mark().line + 1),
                       "a visit is outside the time span of the ground truth",
                       "use sequence.yaml and state_groundtruth_estimate0 of the same recording");
    }
    const auto at_entry = path.pose(visit.in_ns);
    visit.heading_in_rad =
        entry["heading_in"] ? entry["heading_in"].as<double>() * kRadians : yaw_of(at_entry ? *at_entry : *pose);
    recording.visits.push_back(visit);
  }
  std::stable_sort(recording.visits.begin(), recording.visits.end(),
                   [](const auto& a, const auto& b) { return a.stamp_ns < b.stamp_ns; });
}

void read_stretches(std::vector<Disturbance>& found, const fs::path& file, const YAML::Node& listed,
                    const std::string& kind) {
  for (const auto& entry : listed) {
    try {
      found.push_back({entry["from_ns"].as<std::int64_t>(), entry["to_ns"].as<std::int64_t>(), kind});
    } catch (const YAML::Exception& error) {
      fail(file, entry, error, "an interval needs from_ns and to_ns");
    }
  }
}

/// Adds each pass by a junction whose ground has little texture.
void add_weak_texture(std::vector<Disturbance>& found, const JourneyRecording& recording, const YAML::Node& zones) {
  for (const auto& zone : zones) {
    const int place = zone["id"].as<int>(-1);
    for (const auto& visit : recording.visits) {
      if (visit.place == place) found.push_back({visit.in_ns, visit.out_ns, "weak texture"});
    }
  }
}

std::vector<Disturbance> merged(std::vector<Disturbance> stretches) {
  std::sort(stretches.begin(), stretches.end(),
            [](const auto& a, const auto& b) { return a.kind != b.kind ? a.kind < b.kind : a.from_ns < b.from_ns; });
  std::vector<Disturbance> result;
  for (const auto& stretch : stretches) {
    if (!result.empty() && result.back().kind == stretch.kind && stretch.from_ns <= result.back().to_ns) {
      result.back().to_ns = std::max(result.back().to_ns, stretch.to_ns);
    } else {
      result.push_back(stretch);
    }
  }
  return result;
}

void read_sequence(JourneyRecording& recording, const fs::path& file) {
  const auto sequence = read_yaml(file);
  recording.panorama_clock_offset_ns = panorama_clock_offset_ns(file, sequence);
  recording.route = sequence["route"].as<std::string>("");
  recording.seed = sequence["seed"].as<std::string>("");
  for (const auto& effect : sequence["effects"]) recording.effects.push_back(effect.as<std::string>(""));
  read_places(recording, file, sequence["junctions"]);
  read_visits(recording, file, sequence["visits"]);
  std::vector<Disturbance> stretches;
  read_stretches(stretches, file, sequence["illumination_events"], "illumination");
  read_stretches(stretches, file, sequence["movers"], "movers");
  add_weak_texture(stretches, recording, sequence["weak_texture_zones"]);
  recording.disturbances = merged(std::move(stretches));
}

Trajectory read_truth(const fs::path& folder) {
  if (fs::exists(folder / "ground_truth.tum")) return read_tum(folder / "ground_truth.tum");
  const bool is_without = fs::exists(folder / "mav0") && !dataset_player::find_ground_truth(folder);
  if (is_without || fs::exists(folder / "odometry_enhanced.tum")) {
    throw InputError(folder, "holds no ground truth", "name the recording that was played with --recording");
  }
  return read_trajectory(folder);
}

}  // namespace

JourneyRecording read_journey_recording(const fs::path& folder) {
  JourneyRecording recording;
  recording.folder = folder;
  recording.truth = read_truth(folder);
  if (fs::exists(folder / "sequence.yaml")) read_sequence(recording, folder / "sequence.yaml");
  std::vector<std::string> notes;  // the player prints them
  if (const auto panorama = of_data_set([&] { return dataset_player::open_panorama(folder, notes); })) {
    recording.base_from_panorama = panorama->base_from_panorama;
    recording.panoramas = list_panoramas(*panorama, recording.panorama_clock_offset_ns);
    locate(recording.panoramas, recording.truth);
  }
  return recording;
}

std::vector<RecordedPanorama> panoramas_as_stamped(const JourneyRecording& recording, std::int64_t late_ns) {
  std::vector<RecordedPanorama> panoramas;
  for (RecordedPanorama panorama : recording.panoramas) {
    panorama.stamp_ns += recording.panorama_clock_offset_ns;
    const auto pose = pose_at(recording.truth.poses, panorama.stamp_ns + late_ns);
    if (!pose) continue;
    panorama.world_from_base = *pose;
    panoramas.push_back(panorama);
  }
  if (panoramas.empty()) {
    throw InputError(recording.folder, "contains no panorama covered by the ground truth",
                     "use a data set with equirectangular images in cam2");
  }
  return panoramas;
}

TruePath::TruePath(const Trajectory& truth) : truth_(truth) {
  for (std::size_t i = 0; i < truth.poses.size(); ++i) {
    way_m_.push_back(i == 0 ? 0.0
                            : way_m_.back() + (truth.poses[i].world_from_base.translation() -
                                               truth.poses[i - 1].world_from_base.translation())
                                                  .norm());
  }
}

std::optional<Eigen::Isometry3d> TruePath::pose(std::int64_t stamp_ns) const { return pose_at(truth_.poses, stamp_ns); }

double TruePath::travelled_m(std::int64_t stamp_ns) const {
  const auto& poses = truth_.poses;
  const auto after = std::lower_bound(poses.begin(), poses.end(), stamp_ns,
                                      [](const StampedPose& pose, std::int64_t at) { return pose.stamp_ns < at; });
  if (after == poses.end()) return way_m_.back();
  const auto i = static_cast<std::size_t>(after - poses.begin());
  if (i == 0) return 0.0;
  const double share = static_cast<double>(stamp_ns - poses[i - 1].stamp_ns) /
                       static_cast<double>(poses[i].stamp_ns - poses[i - 1].stamp_ns);
  return way_m_[i - 1] + share * (way_m_[i] - way_m_[i - 1]);
}

double yaw_of(const Eigen::Isometry3d& world_from_base) {
  return std::atan2(world_from_base.linear()(1, 0), world_from_base.linear()(0, 0));
}

}  // namespace panvo::evaluation
