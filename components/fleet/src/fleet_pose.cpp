// SPDX-License-Identifier: Apache-2.0
#include "panvo/fleet/fleet_pose.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace panvo::fleet {
namespace {

constexpr double kBridgeExtent_m = 25.0;  // sightings this near have places and errors in common
constexpr std::size_t kMaxBridges = 100;  // the work grows with the square

/// A place at the end of a bridge, and the most certain way to it.
struct Stop {
  const landmarks::PanoramicLandmark* place = nullptr;
  bool is_reached = false, is_done = false;
  bool is_over_bridge = false;  ///< reached over a bridge, so the way may continue through the stop's own map
  FleetPose pose;               ///< common_from_base at the place
  double variance_m2() const { return pose.covariance.topLeftCorner<3, 3>().trace(); }
};

class WaySearch {
 public:
  WaySearch(const SharedMap& common, const JoinParameters& parameters) : common_(common), parameters_(parameters) {}

  void add(const Bridge& bridge, const SharedMap& a, const SharedMap& b) {
    bridges_.push_back(bridge);
    begin(bridge.a, a);
    begin(bridge.b, b);
  }

  void run() {
    for (auto* stop = nearest(); stop; stop = nearest()) {
      stop->is_done = true;
      cross_bridges(*stop);
      if (stop->is_over_bridge) go_through_map(*stop);
    }
  }

  /// The pose from the most certain place of the own map that was reached over a bridge.
  std::optional<FleetPose> pose_in(MapId own, const PoseSample& in_own) const {
    std::optional<FleetPose> best;
    for (const auto& [key, stop] : stops_) {
      if (key.map != own || !stop.is_reached || !stop.is_over_bridge) continue;
      const auto& from = stop.place->map_from_base;
      auto pose = extended(
          stop.pose, from.inverse() * in_own.map_from_base,
          relative_covariance(from, stop.place->covariance, in_own.map_from_base, in_own.covariance, parameters_));
      if (!best || variance(pose) < variance(*best)) best = pose;
    }
    return best;
  }

  static double variance(const FleetPose& pose) { return pose.covariance.topLeftCorner<3, 3>().trace(); }

 private:
  void begin(const PlaceKey& key, const SharedMap& map) {
    auto& stop = stops_[key];
    stop.place = map.find(key.place);
    if (key.map != common_.id()) return;
    stop.is_reached = true;
    stop.pose = {stop.place->map_from_base, stop.place->covariance, 0};
  }

  Stop* nearest() {
    Stop* found = nullptr;
    for (auto& [key, stop] : stops_) {
      if (stop.is_done || !stop.is_reached) continue;
      if (!found || stop.variance_m2() < found->variance_m2()) {
        found = &stop;
        found_ = key;
      }
    }
    return found;
  }

  static FleetPose extended(const FleetPose& pose, const Eigen::Isometry3d& step, const vision::Matrix6d& covariance) {
    return {pose.common_from_base * step,
            vision::compose_covariance(pose.common_from_base, pose.covariance, step, covariance), pose.bridges};
  }

  void reach(Stop& stop, FleetPose pose, bool is_over_bridge) {
    if (stop.is_done || (stop.is_reached && stop.variance_m2() <= variance(pose))) return;
    stop.pose = std::move(pose);
    stop.is_reached = true;
    stop.is_over_bridge = is_over_bridge;
  }

  void cross_bridges(const Stop& from) {
    for (const auto& bridge : bridges_) {
      const bool is_a = bridge.a == found_;
      if (!is_a && bridge.b != found_) continue;
      auto pose = is_a ? extended(from.pose, bridge.a_from_b, bridge.covariance)
                       : extended(from.pose, bridge.a_from_b.inverse(),
                                  vision::invert_covariance(bridge.a_from_b, bridge.covariance));
      ++pose.bridges;
      reach(stops_.at(is_a ? bridge.b : bridge.a), std::move(pose), true);
    }
  }

  void go_through_map(const Stop& from) {
    const auto map = found_.map;
    for (auto stop = stops_.lower_bound({map, 0}); stop != stops_.end() && stop->first.map == map; ++stop) {
      if (stop->second.is_done) continue;
      const auto& i = *from.place;
      const auto& j = *stop->second.place;
      reach(stop->second,
            extended(from.pose, i.map_from_base.inverse() * j.map_from_base,
                     relative_covariance(i.map_from_base, i.covariance, j.map_from_base, j.covariance, parameters_)),
            false);
    }
  }

  const SharedMap& common_;
  const JoinParameters& parameters_;
  std::vector<Bridge> bridges_;
  std::map<PlaceKey, Stop> stops_;
  PlaceKey found_;
};

}  // namespace

std::vector<Bridge> bridges(const JoinedMaps& joined, double extent_m, const JoinParameters& parameters) {
  const auto at = [&](const CrossSighting& sighting) {
    return joined.a->find(sighting.place_a)->map_from_base.translation();
  };
  std::vector<std::vector<CrossSighting>> groups;
  for (const auto& sighting : joined.agreed) {
    if (!joined.a->find(sighting.place_a) || !joined.b->find(sighting.place_b)) continue;
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& known) {
      return (at(known.front()) - at(sighting)).norm() <= extent_m;
    });
    if (group == groups.end()) {
      groups.push_back({sighting});
    } else {
      group->push_back(sighting);
    }
  }
  std::vector<Bridge> found;
  for (const auto& group : groups) {
    const auto& first = group.front();
    const auto transform = fit(*joined.a, *joined.b, group, first.place_a, parameters);
    if (!transform) continue;
    const auto& a = joined.a->find(first.place_a)->map_from_base;
    const auto& b = joined.b->find(first.place_b)->map_from_base;
    const auto covariance =
        vision::compose_covariance(transform->a_from_b, transform->covariance, b, vision::Matrix6d::Zero());
    found.push_back({{joined.a->id(), first.place_a},
                     {joined.b->id(), first.place_b},
                     a.inverse() * transform->a_from_b * b,
                     vision::rotate_covariance(a.linear().transpose(), covariance)});
  }
  return found;
}

std::optional<FleetPose> most_certain_pose(const SharedMap& common, const SharedMap& own, const PoseSample& in_own,
                                           const std::vector<JoinedMaps>& joined, const JoinParameters& parameters) {
  WaySearch search(common, parameters);
  std::size_t count = 0;
  for (const auto& maps : joined) {
    for (const auto& bridge : bridges(maps, kBridgeExtent_m, parameters)) {
      if (count++ < kMaxBridges) search.add(bridge, *maps.a, *maps.b);
    }
  }
  search.run();
  auto best = search.pose_in(own.id(), in_own);
  if (common.id() == own.id()) {
    const FleetPose direct{in_own.map_from_base, in_own.covariance, 0};
    if (!best || WaySearch::variance(direct) <= WaySearch::variance(*best)) best = direct;
  }
  return best;
}

}  // namespace panvo::fleet
