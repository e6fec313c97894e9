// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>

namespace panvo::localizer {

/// Direction of motion by panoramas minus that by odometry, both in the vehicle's axes: that of the two mounts.
struct MountDirection {
  double rad = 0.0;
  double variance_rad2 = 0.0;
};

/// How the cameras sat when each landmark was built. A panoramic camera that was rotated since then sees the landmark at
/// a wrong heading, in all panoramas alike, so that its sightings confirm each other.
class MountingHistory {
 public:
  /// The direction at a panorama; nullopt, without effect, while it is not measured.
  void add(std::int64_t panorama_ns, const std::optional<MountDirection>& direction);
  /// The direction at the end of the journey before.
  void remember(const MountDirection& direction) { first_ = direction; }
  /// A landmark was built from a panorama; that may become known later.
  void add_built(std::uint32_t landmark_id, std::int64_t panorama_ns);
  /// The clock was set back: stamps of before are of another time.
  void forget_stamps();

  /// How far the mounts have turned since the landmark was built, as far as it exceeds the errors of both directions.
  /// For landmarks of earlier journeys, or built before the direction was known: since it is known or remembered.
  double turned_rad(std::uint32_t landmark_id) const;

 private:
  struct At {
    std::int64_t panorama_ns;
    MountDirection direction;
  };

  std::optional<MountDirection> first_, now_;
  std::deque<At> recent_;
  std::map<std::uint32_t, MountDirection> built_;
};

}  // namespace panvo::localizer
