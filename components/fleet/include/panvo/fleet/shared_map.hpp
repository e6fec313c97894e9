// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::fleet {

/// Unique among all robots and days: a hash of the robot's name and of the map's first place. 0: none.
using MapId = std::uint64_t;

/// Slots of sightings in a map: 64 other maps, 32 sightings each.
inline constexpr std::uint32_t kSlotsPerMap = 32;
inline constexpr std::uint32_t kMaxSlots = 64 * kSlotsPerMap;

/// Sixteen hexadecimal digits.
std::string to_text(MapId id);

/// Identity of a place among all maps.
struct PlaceKey {
  MapId map = 0;
  std::uint32_t place = 0;  ///< id in its map

  auto operator<=>(const PlaceKey&) const = default;
};

/// A place of another map, recognised in a panorama, relative to a place of the own map.
struct Sighting {
  std::uint32_t slot = 0;  ///< a later sighting in the same slot replaces this one
  std::uint32_t own_place = 0;
  PlaceKey seen;
  Eigen::Isometry3d own_from_seen = Eigen::Isometry3d::Identity();  ///< base at the own place from base at the seen one
  vision::Matrix6d covariance = vision::Matrix6d::Identity();       ///< as vision::pose_error
  std::uint32_t inliers = 0;
  double travelled_m = 0.0;  ///< path of the observer when it saw the place
};

/// What changed in a map from one version to a later one.
struct MapChanges {
  MapId map = 0;
  std::uint64_t session = 0;
  std::uint64_t previous = 0, version = 0;
  std::vector<landmarks::PanoramicLandmark> places;  ///< new, without keypoints and thumbnail
  std::vector<landmarks::LandmarkPose> moved;
  std::vector<Sighting> sightings;
};

/// Places of a map and its robot's sightings of other maps, with a version that grows with each change. The owner adds
/// and moves; a replica applies the owner's changes in order and equals the owner's map at each version. A change also
/// fits a replica that already has a part of it, so that one transmission serves receivers that miss different parts.
///
/// Independent of messages, clocks and threads: a replica may follow in the same process or on another computer.
class SharedMap {
 public:
  /// A place with its version: of its last change, and of its description.
  struct Place {
    landmarks::PanoramicLandmark landmark;
    std::uint64_t changed = 0, described = 0;
  };
  struct Seen {
    Sighting sighting;
    std::uint64_t changed = 0;
  };
  enum class Applied {
    kApplied,
    kOld,   ///< known already
    kGap,   ///< earlier changes are missing: nothing was changed
    kFull,  ///< more places than allowed: nothing was changed
  };

  /// `session`: versions of different sessions of one map are not comparable. `max_places`: larger maps are refused.
  SharedMap(MapId id, std::uint64_t session, std::size_t max_places) : id_(id), session_(session), max_(max_places) {}

  /// Of the owner: each returns whether anything changed. A place that exists is moved.
  bool add(landmarks::PanoramicLandmark place);
  bool add(const Sighting& sighting);
  /// Moves the places whose poses differ from the shared ones by more than the tolerance: the map's corrections move all
  /// its places a little, again and again. Returns their number.
  std::size_t move(const std::vector<landmarks::LandmarkPose>& poses, double tolerance_m, double tolerance_rad);

  /// Changes after a version, at most `max_places` new places and `max_moves` moved ones; nullopt if there are none.
  std::optional<MapChanges> since(std::uint64_t version, std::size_t max_places, std::size_t max_moves) const;

  /// Of a replica.
  Applied apply(const MapChanges& changes);

  MapId id() const noexcept { return id_; }
  std::uint64_t session() const noexcept { return session_; }
  std::uint64_t version() const noexcept { return version_; }
  /// Of all contents, independent of the order in which they came: equal maps have equal digests.
  std::uint64_t digest() const noexcept { return digest_; }
  const std::map<std::uint32_t, Place>& places() const noexcept { return places_; }
  const std::map<std::uint32_t, Seen>& sightings() const noexcept { return sightings_; }
  const landmarks::PanoramicLandmark* find(std::uint32_t place) const;

 private:
  std::uint64_t last_within(std::uint64_t version, std::size_t max_places, std::size_t max_moves) const;
  void put(landmarks::PanoramicLandmark place, std::uint64_t version);
  void put(const landmarks::LandmarkPose& pose, std::uint64_t version);
  void put(const Sighting& sighting, std::uint64_t version);

  MapId id_;
  std::uint64_t session_;
  std::size_t max_;
  std::uint64_t version_ = 0, digest_ = 0;
  std::map<std::uint32_t, Place> places_;
  std::map<std::uint32_t, Seen> sightings_;  // by slot
};

/// Id of the map that begins with this place.
MapId map_id(const std::string& robot, const landmarks::PanoramicLandmark& first);

/// Id of a robot's process that began with this stamp.
std::uint64_t session_id(const std::string& robot, std::int64_t first_stamp_ns);

}  // namespace panvo::fleet
