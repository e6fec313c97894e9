// SPDX-License-Identifier: Apache-2.0
#include "drive_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "drive_clock.hpp"
#include "drive_pictures.hpp"
#include "html_text.hpp"

namespace panvo::evaluation {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostRows = 20'000;  // of poses of one path: more than a screen shows

/// Of a long drive every second, third ... entry, and those at which `state_of` an entry changes: what lasts for a moment
/// is shown, too.
template <class Entry, class StateOf>
std::vector<const Entry*> thinned(const std::vector<Entry>& entries, StateOf state_of) {
  const std::size_t step = (entries.size() + kMostRows - 1) / kMostRows;
  std::vector<const Entry*> kept;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i % step == 0 || state_of(entries[i]) != state_of(entries[i - 1])) kept.push_back(&entries[i]);
  }
  return kept;
}

std::vector<const StampedPose*> thinned(const std::vector<StampedPose>& poses) {
  return thinned(poses, [](const StampedPose&) { return 0; });
}

/// Of variances, 1e-4 would be that of a centimetre.
double fine(double value) { return std::round(value * 1e9) * 1e-9; }

/// 0.1 mm, 0.1 ms, 0.006 degrees: printed in few digits.
double rounded(double value) { return std::round(value * 1e4) / 1e4; }

Json pose_row(const Eigen::Isometry3d& pose) {
  return {rounded(pose.translation().x()), rounded(pose.translation().y()), rounded(yaw_of(pose))};
}

Json number_or_null(const std::optional<double>& value) { return value ? Json(rounded(*value)) : Json(); }

class Rows {
 public:
  explicit Rows(const JourneyFrames& frames) : frames_(frames), clock_(frames.run) {}

  Json all() const {
    const auto& run = frames_.run;
    Json drive;
    drive["enhanced"] = enhanced();
    drive["binocular"] =
        rows(thinned(run.binocular.poses), [](const StampedPose& pose) { return pose_row(pose.world_from_base); });
    drive["truth"] = truth();
    drive["places"] = places();
    const Eigen::Vector3d middle = frames_.recording.base_from_panorama.linear().col(2);  // the z axis points there
    drive["panoramaYaw"] = rounded(std::atan2(middle.y(), middle.x()));
    const auto qualities = thinned(run.qualities, [](const RunQuality& one) { return one.reliable; });
    drive["quality"] = rows(qualities, [](const RunQuality& one) {
      return Json{one.reliable, one.tracked, one.inliers};
    });
    const auto integrity = thinned(run.integrity, [](const RunIntegrity& one) { return one.usable; });
    drive["integrity"] = rows(integrity, [](const RunIntegrity& one) {
      return Json{one.usable, one.reason, one.risk ? Json(*one.risk) : Json(), number_or_null(one.protection_level_m),
                  number_or_null(one.alert_limit_m)};
    });
    drive["azimuth"] = azimuths();
    drive["matches"] = matches();
    drive["outcomes"] = outcomes();
    drive["states"] = states();
    return drive;
  }

 private:
  double time(std::int64_t stamp_ns) const { return rounded(clock_.seconds(stamp_ns)); }

  /// A row for each entry: its time, then `values_of` it.
  template <class Entry, class Values>
  Json rows(const std::vector<const Entry*>& entries, Values values_of) const {
    Json rows = Json::array();
    for (const auto* entry : entries) {
      Json row = {time(entry->stamp_ns)};
      for (auto& value : values_of(*entry)) row.push_back(value);
      rows.push_back(std::move(row));
    }
    return rows;
  }

  Json enhanced() const {
    const auto& covariances = frames_.run.enhanced_covariances;
    return rows(thinned(frames_.run.enhanced.poses), [&](const StampedPose& pose) {
      Json row = pose_row(pose.world_from_base);
      Matrix6d covariance = Matrix6d::Constant(std::numeric_limits<double>::quiet_NaN());  // null: unknown
      if (covariances) {
        if (const auto found = covariances->find(pose.stamp_ns); found != covariances->end())
          covariance = found->second.pose;
      }
      for (const double value : {covariance(0, 0), covariance(0, 1), covariance(1, 1)}) row.push_back(fine(value));
      row.push_back(rounded(speed_m_s(pose.stamp_ns)));
      return row;
    });
  }

  /// At the stamps of the enhanced poses that are shown, which the page compares with it; it may have others of its own.
  Json truth() const {
    const Eigen::Isometry3d map_from_world = frames_.world_from_map.inverse();
    std::vector<StampedPose> poses;
    for (const auto* shown : thinned(frames_.run.enhanced.poses)) {
      const auto pose = pose_at(frames_.recording.truth.poses, shown->stamp_ns);
      if (pose) poses.push_back({shown->stamp_ns, map_from_world * *pose});
    }
    return rows(thinned(poses), [](const StampedPose& pose) { return pose_row(pose.world_from_base); });
  }

  /// Of the odometry, which does not jump; 0 before its first step.
  double speed_m_s(std::int64_t stamp_ns) const {
    const auto& poses = frames_.run.binocular.poses;
    const auto after = std::ranges::upper_bound(poses, stamp_ns, {}, &StampedPose::stamp_ns);
    if (after - poses.begin() < 2) return 0.0;
    const StampedPose &now = *std::prev(after), &before = *std::prev(after, 2);
    return (now.world_from_base.translation() - before.world_from_base.translation()).norm() /
           (1e-9 * static_cast<double>(now.stamp_ns - before.stamp_ns));
  }

  Json azimuths() const {
    Json azimuths = Json::array();
    for (const auto& one : frames_.run.azimuths) {
      if (one.change_rad) azimuths.push_back({time(one.stamp_ns), time(one.from_ns), fine(*one.change_rad)});
    }
    return azimuths;
  }

  Json matches() const {
    Json matches = Json::array();
    for (const auto& one : frames_.run.matches) {
      if (one.heading_rad) matches.push_back({time(one.stamp_ns), one.state, one.landmark, rounded(*one.heading_rad)});
    }
    return matches;
  }

  Json outcomes() const {
    Json outcomes = Json::array();
    for (const auto& one : frames_.run.outcomes) {
      outcomes.push_back({time(one.stamp_ns), one.landmark, one.outcome, one.reason, pose_row(one.map_from_base_before),
                          pose_row(one.map_from_base_after)});
    }
    return outcomes;
  }

  Json states() const {
    Json states = Json::array();
    for (const auto& one : frames_.run.states) {
      states.push_back({time(one.stamp_ns), one.state, one.reason, number_or_null(one.position_sigma_m),
                        number_or_null(one.heading_sigma_rad)});
    }
    return states;
  }

  /// As last published.
  Json places() const {
    std::map<std::int64_t, const RunLandmark*> last;
    for (const auto& landmark : frames_.run.landmarks) last[landmark.id] = &landmark;
    Json places = Json::array();
    for (const auto& [id, landmark] : last) {
      places.push_back({{"time", time(landmark->stamp_ns)},
                        {"id", id},
                        {"junction", landmark->is_junction},
                        {"pose", pose_row(landmark->map_from_base)},
                        {"thumbnail", base64(thumbnail(frames_, landmark->stamp_ns))}});
    }
    return places;
  }

  const JourneyFrames& frames_;
  DriveClock clock_;
};

}  // namespace

Json drive_rows(const JourneyFrames& frames) { return Rows(frames).all(); }

}  // namespace panvo::evaluation
