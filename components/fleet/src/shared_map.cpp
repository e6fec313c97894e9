// SPDX-License-Identifier: Apache-2.0
#include "panvo/fleet/shared_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hash.hpp"

namespace panvo::fleet {
namespace {

enum Kind : std::uint8_t { kPlace = 1, kSighting = 2 };

void hash_features(Hash& hash, const std::vector<landmarks::AdaptiveFeature>& features) {
  for (const auto& feature : features) hash.add(feature.row).add(feature.value).add(feature.weight);
}

void hash_description(Hash& hash, const landmarks::PanoramaDescription& description) {
  for (const float share : description.histogram) hash.add(share);
  hash_features(hash, description.large);
  hash_features(hash, description.small);
}

/// Rotations are left out: a message carries them as quaternions, which changes their last bits.
void hash_position(Hash& hash, const Eigen::Isometry3d& pose) {
  for (int i = 0; i < 3; ++i) hash.add(pose.translation()[i]);
}

std::uint64_t digest_of(const landmarks::PanoramicLandmark& place) {
  Hash hash;
  hash.add(std::uint8_t{kPlace}).add(place.id).add(place.stamp_ns);
  hash_position(hash, place.map_from_base);
  hash_description(hash, place.description);
  return hash.value();
}

std::uint64_t digest_of(const Sighting& sighting) {
  Hash hash;
  hash.add(std::uint8_t{kSighting}).add(sighting.slot).add(sighting.own_place).add(sighting.seen.map);
  hash.add(sighting.seen.place).add(sighting.inliers).add(sighting.travelled_m);
  hash_position(hash, sighting.own_from_seen);
  return hash.value();
}

bool is_moved(const landmarks::PanoramicLandmark& place, const landmarks::LandmarkPose& pose, double tolerance_m,
              double tolerance_rad) {
  const auto moved = vision::pose_error(place.map_from_base, pose.map_from_base);
  if (moved.head<3>().norm() > tolerance_m || moved.tail<3>().norm() > tolerance_rad) return true;
  // A place whose uncertainty halved is worth more to others, even if it stays where it was.
  const double before = vision::horizontal_sigma(place.covariance), after = vision::horizontal_sigma(pose.covariance);
  return std::abs(before - after) > tolerance_m && (after < 0.5 * before || before < 0.5 * after);
}

}  // namespace

std::string to_text(MapId id) { return fmt::format("{:016x}", id); }

MapId map_id(const std::string& robot, const landmarks::PanoramicLandmark& first) {
  Hash hash;
  hash.add(std::string_view(robot)).add(first.id).add(first.stamp_ns);
  hash_description(hash, first.description);
  return std::max<MapId>(1, hash.value());
}

std::uint64_t session_id(const std::string& robot, std::int64_t first_stamp_ns) {
  return Hash().add(std::string_view(robot)).add(first_stamp_ns).value();
}

bool SharedMap::add(landmarks::PanoramicLandmark place) {
  if (places_.contains(place.id)) {
    return move({{place.id, place.map_from_base, place.covariance}}, 0.0, 0.0) > 0;
  }
  if (places_.size() >= max_) return false;
  put(std::move(place), version_ + 1);
  ++version_;
  return true;
}

bool SharedMap::add(const Sighting& sighting) {
  put(sighting, version_ + 1);
  ++version_;
  return true;
}

std::size_t SharedMap::move(const std::vector<landmarks::LandmarkPose>& poses, double tolerance_m,
                            double tolerance_rad) {
  std::size_t count = 0;
  for (const auto& pose : poses) {
    const auto found = places_.find(pose.id);
    if (found == places_.end() || !is_moved(found->second.landmark, pose, tolerance_m, tolerance_rad)) continue;
    put(pose, version_ + 1);
    ++count;
  }
  if (count > 0) ++version_;
  return count;
}

std::optional<MapChanges> SharedMap::since(std::uint64_t version, std::size_t max_places, std::size_t max_moves) const {
  if (version >= version_) return std::nullopt;
  const std::uint64_t until = last_within(version, max_places, max_moves);
  MapChanges changes{id_, session_, version, until, {}, {}, {}};
  for (const auto& [id, place] : places_) {
    // A place described by `until` and moved later is sent as it is now: its later change will not describe it again.
    if (place.described > version && place.described <= until) {
      changes.places.push_back(place.landmark);
    } else if (place.described <= version && place.changed > version && place.changed <= until) {
      changes.moved.push_back({id, place.landmark.map_from_base, place.landmark.covariance});
    }
  }
  for (const auto& [slot, seen] : sightings_) {
    if (seen.changed > version && seen.changed <= until) changes.sightings.push_back(seen.sighting);
  }
  return changes;
}

std::uint64_t SharedMap::last_within(std::uint64_t version, std::size_t max_places, std::size_t max_moves) const {
  std::map<std::uint64_t, std::pair<std::size_t, std::size_t>> counts;  // of each version: new places, moved ones
  for (const auto& [id, place] : places_) {
    if (place.described > version) {
      ++counts[place.described].first;
    } else if (place.changed > version) {
      ++counts[place.changed].second;
    }
  }
  std::size_t described = 0, moved = 0;
  std::uint64_t last = 0;  // the first version is taken whatever its size: a part of it would be of no version
  for (const auto& [changed, count] : counts) {
    described += count.first;
    moved += count.second;
    if (last > 0 && (described > max_places || moved > max_moves)) return last;
    last = changed;
  }
  return version_;
}

SharedMap::Applied SharedMap::apply(const MapChanges& changes) {
  if (changes.version <= version_) return Applied::kOld;
  if (changes.previous > version_) return Applied::kGap;
  std::size_t added = 0;
  for (const auto& place : changes.places) added += places_.contains(place.id) ? 0 : 1;
  if (places_.size() + added > max_) return Applied::kFull;
  for (const auto& place : changes.places) put(place, changes.version);
  for (const auto& pose : changes.moved) put(pose, changes.version);
  for (const auto& sighting : changes.sightings) put(sighting, changes.version);
  version_ = changes.version;
  return Applied::kApplied;
}

const landmarks::PanoramicLandmark* SharedMap::find(std::uint32_t place) const {
  const auto found = places_.find(place);
  return found == places_.end() ? nullptr : &found->second.landmark;
}

void SharedMap::put(landmarks::PanoramicLandmark place, std::uint64_t version) {
  std::vector<landmarks::Keypoint>().swap(place.keypoints);  // releases the memory
  std::vector<std::uint8_t>().swap(place.thumbnail);
  auto& kept = places_[place.id];
  if (kept.changed > 0) digest_ ^= digest_of(kept.landmark);
  digest_ ^= digest_of(place);
  kept = {std::move(place), version, version};
}

void SharedMap::put(const landmarks::LandmarkPose& pose, std::uint64_t version) {
  const auto found = places_.find(pose.id);
  if (found == places_.end()) return;
  auto& kept = found->second;
  digest_ ^= digest_of(kept.landmark);
  kept.landmark.map_from_base = pose.map_from_base;
  kept.landmark.covariance = pose.covariance;
  kept.changed = version;
  digest_ ^= digest_of(kept.landmark);
}

void SharedMap::put(const Sighting& sighting, std::uint64_t version) {
  auto& kept = sightings_[sighting.slot];
  if (kept.changed > 0) digest_ ^= digest_of(kept.sighting);
  digest_ ^= digest_of(sighting);
  kept = {sighting, version};
}

}  // namespace panvo::fleet
