// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::landmarks {

/// Where the landmarks of the map are, as far as a component has heard. The localizer owns the map: each of its messages
/// has all the poses that it decides on, so that the next one makes good a lost one. A landmark's own message has the pose
/// with which it was built or stored. The two come in any order, on topics of their own; the owner's pose prevails.
class MapReplica {
 public:
  struct Place {
    LandmarkPose pose;
    std::optional<std::int64_t> stamp_ns;  ///< nullopt: only the pose has arrived
  };

  /// Whether a landmark has the id of another one, built from another panorama: who numbers them may have been restarted
  /// and not know all ids.
  bool is_other(const PanoramicLandmark& landmark) const;
  /// A landmark arrives, perhaps again; it gets the owner's pose if there is one. Returns whether its pose is new here.
  bool add(PanoramicLandmark& landmark);
  /// All poses of the owner arrive. Returns those that are new here.
  std::vector<LandmarkPose> move(const std::vector<LandmarkPose>& poses);

  const std::map<std::uint32_t, Place>& places() const noexcept { return places_; }
  /// Throws std::out_of_range for an unknown id.
  const LandmarkPose& pose(std::uint32_t id) const { return places_.at(id).pose; }
  /// The largest id of all places plus 1, whichever node or journey they come from; never 0, as ids have a limit.
  std::uint32_t next_id() const { return places_.empty() ? 1 : places_.rbegin()->first + 1; }

 private:
  bool set(const LandmarkPose& pose);

  std::map<std::uint32_t, Place> places_;
  std::set<std::uint32_t> owned_;  // places in the owner's last message
};

}  // namespace panvo::landmarks
