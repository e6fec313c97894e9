// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "panvo/fleet/common_frame.hpp"
#include "panvo/fleet/fleet_pose.hpp"
#include "panvo/fleet/map_join.hpp"

namespace panvo::fleet {

/// The decisions on all pairs of maps, renewed where a map has changed.
class Evidence {
 public:
  explicit Evidence(const JoinParameters& parameters) : parameters_(parameters) {}

  /// Decides again on pairs with a changed map, at most `most` of them; the rest follow in later calls. Drops the
  /// decisions on maps that are not in `maps`.
  void update(const std::vector<const SharedMap*>& maps, int most);

  /// The decision on two maps in either order; nullptr if none was made. Its sightings are from the smaller id to the
  /// larger one.
  const MapJoin* find(MapId one, MapId other) const;

  /// Transforms of the joined pairs. Those of `own` fit near its place `near`; others near their latest sighting.
  std::vector<JoinedPair> joined(const std::vector<const SharedMap*>& maps, MapId own, std::uint32_t near) const;

  /// The joined pairs with their agreeing sightings, without those in `left_out`.
  std::vector<JoinedMaps> joined_maps(const std::vector<const SharedMap*>& maps,
                                      const std::vector<std::pair<MapId, MapId>>& left_out) const;

  /// Joins made and undone since the last call, with the reason.
  std::vector<std::string> take_news();
  int made() const noexcept { return made_; }
  int undone() const noexcept { return undone_; }

 private:
  struct Decision {
    std::array<std::uint64_t, 4> versions{};  ///< session and version of each map
    std::uint64_t decided = 0;                ///< number of this decision
    MapJoin join;
  };
  using Pair = std::pair<MapId, MapId>;  // the smaller id first

  void report(const Pair& pair, const MapJoin& before, const MapJoin& now);

  const JoinParameters parameters_;
  std::map<Pair, Decision> decisions_;
  std::vector<std::string> news_;
  std::uint64_t count_ = 0;
  int made_ = 0, undone_ = 0;
};

}  // namespace panvo::fleet
