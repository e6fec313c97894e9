// SPDX-License-Identifier: Apache-2.0
#include "panvo/fleet/members.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace panvo::fleet {
namespace {

constexpr int kMaxContradictions = 3;
constexpr int kMaxOvertaken = 3;
constexpr std::int64_t kInFlight_ns = 500'000'000;  // changes may be heard after the announcement that counts them
constexpr std::size_t kMaxNews = 100;

std::int64_t ns(double seconds) { return static_cast<std::int64_t>(1e9 * seconds); }

}  // namespace

Members::Members(const MemberParameters& parameters, std::string own_robot, landmarks::DescriptionSettings settings,
                 landmarks::DescriptionLimits limits)
    : parameters_(parameters), own_robot_(std::move(own_robot)), settings_(std::move(settings)), limits_(limits) {}

std::optional<std::string> Members::hear(const Announcement& said, std::int64_t now_ns) {
  if (auto refused = objection(said, now_ns)) return refused;
  auto* member = known(said.robot);
  if (!member || member->map.id() != said.map) {
    if (!members_.contains(said.map)) {
      if (auto full = make_room()) return full;
    }
    begin(said);
    member = known(said.robot);
  } else if (member->map.session() != said.session) {
    member->last = said;
    start_again(*member, "was restarted with its stored map");
  }
  if (!member->is_present) news_.push_back(fmt::format("{} is back", said.robot));
  member->is_present = true;
  member->heard_ns = now_ns;
  if (is_overtaken(*member, said)) return std::nullopt;
  member->last = said;
  compare(*member, now_ns);
  return std::nullopt;
}

std::optional<std::string> Members::objection(const Announcement& said, std::int64_t now_ns) {
  if (said.robot == own_robot_) {
    return fmt::format("another robot is also named {}: give each a name of its own", said.robot);
  }
  if (const auto found = landmarks::differences(landmarks::settings_from_text(said.settings), settings_);
      !found.empty()) {
    std::string reason = fmt::format("{} describes places with other settings: ", said.robot);
    for (std::size_t i = 0; i < found.size() && i < 5; ++i) reason += (i == 0 ? "" : "; ") + found[i];
    return reason;
  }
  const auto* member = known(said.robot);
  const bool is_other_process = member && (member->map.session() != said.session || member->map.id() != said.map);
  if (is_other_process && now_ns - member->heard_ns < ns(parameters_.silent_s)) {
    return fmt::format("two robots are named {}: give each a name of its own, unless it was restarted just now",
                       said.robot);
  }
  if (const auto* owned = find(said.map); owned && owned->robot != said.robot) {
    return fmt::format("{} announces the map of {}", said.robot, owned->robot);
  }
  return std::nullopt;
}

/// Forgets the map of the robot that is absent longest, if there are too many; the reason if all are present.
std::optional<std::string> Members::make_room() {
  if (members_.size() < static_cast<std::size_t>(parameters_.max_robots)) return std::nullopt;
  auto oldest = members_.end();
  for (auto member = members_.begin(); member != members_.end(); ++member) {
    const bool is_left = !member->second.is_present || map_of_[member->second.robot] != member->first;
    if (is_left && (oldest == members_.end() || member->second.heard_ns < oldest->second.heard_ns)) oldest = member;
  }
  if (oldest == members_.end()) {
    return fmt::format("there are more than {} other robots (max_robots)", parameters_.max_robots);
  }
  news_.push_back(fmt::format("map {} of {} was forgotten to make room", to_text(oldest->first), oldest->second.robot));
  restarted_.push_back(oldest->first);
  if (map_of_[oldest->second.robot] == oldest->first) map_of_.erase(oldest->second.robot);
  members_.erase(oldest);
  return std::nullopt;
}

void Members::begin(const Announcement& said) {
  const auto before = map_of_.find(said.robot);
  if (before == map_of_.end()) {
    news_.push_back(
        fmt::format("{} joined the fleet with map {}, {} places", said.robot, to_text(said.map), said.places));
  } else {
    news_.push_back(fmt::format("{} was restarted with the new map {}; its map {} is kept", said.robot,
                                to_text(said.map), to_text(before->second)));
    members_.at(before->second).is_present = false;
  }
  map_of_[said.robot] = said.map;
  members_.insert_or_assign(said.map,
                            Member{said.robot,
                                   SharedMap(said.map, said.session, static_cast<std::size_t>(parameters_.max_places)),
                                   said,
                                   0,
                                   true,
                                   {},
                                   {},
                                   0,
                                   0,
                                   0});
}

void Members::start_again(Member& member, const std::string& why) {
  news_.push_back(fmt::format("{} {}: its map is received again", member.robot, why));
  restarted_.push_back(member.map.id());
  member.map = SharedMap(member.map.id(), member.last.session, static_cast<std::size_t>(parameters_.max_places));
  member.asked_ns.reset();
}

/// Whether changes that were sent later, on a topic of their own, arrived before this announcement. Only a robot that
/// went back announces less than was received again and again: then its map is started again.
bool Members::is_overtaken(Member& member, const Announcement& said) {
  if (said.version > member.last.version || said.version >= member.map.version()) {
    member.overtaken = 0;
    return false;
  }
  if (++member.overtaken < kMaxOvertaken) return true;
  member.overtaken = 0;
  start_again(member, "went back to an earlier version of its map");
  return false;
}

/// Whether the replica has what was announced.
void Members::compare(Member& member, std::int64_t now_ns) {
  const auto& last = member.last;
  if (last.version > member.map.version()) {
    if (!member.behind_since_ns) member.behind_since_ns = now_ns;
    return;
  }
  if (member.behind_since_ns && member.missed > 0) {
    news_.push_back(fmt::format("the map of {} is complete again after {} requests", member.robot, member.missed));
  }
  member.behind_since_ns.reset();
  member.asked_ns.reset();
  member.missed = 0;
  const bool is_comparable = last.digest != 0 && last.version == member.map.version();
  if (!is_comparable || last.digest == member.map.digest()) {
    if (is_comparable) member.contradictions = 0;
    return;
  }
  if (++member.contradictions < kMaxContradictions) {
    start_again(member, "has other contents than received");
  } else if (member.contradictions == kMaxContradictions) {
    news_.push_back(
        fmt::format("the map of {} contradicts its digest again and again: kept as received", member.robot));
  }
}

std::optional<std::string> Members::take(const std::string& robot, const MapChanges& changes, std::int64_t now_ns) {
  auto* member = known(robot);
  if (!member || member->map.id() != changes.map || member->map.session() != changes.session) return std::nullopt;
  if (auto fault = fault_of(changes)) return fmt::format("{}: {}", robot, *fault);
  if (places() + changes.places.size() > static_cast<std::size_t>(parameters_.max_places)) {
    return fmt::format("{}: there are more than {} places (max_places)", robot, parameters_.max_places);
  }
  report_moves(*member, changes);
  const auto version = member->map.version();
  const auto applied = member->map.apply(changes);
  if (applied == SharedMap::Applied::kGap && !member->behind_since_ns) member->behind_since_ns = now_ns;
  if (member->map.version() > version) member->asked_ns = member->asked_ns ? std::optional(now_ns) : std::nullopt;
  if (applied == SharedMap::Applied::kApplied) compare(*member, now_ns);
  return std::nullopt;
}

std::optional<std::string> Members::fault_of(const MapChanges& changes) const {
  for (const auto& place : changes.places) {
    if (!landmarks::fits(place.description, limits_)) {
      return fmt::format("place {} does not fit the measurement matrices or the histogram", place.id);
    }
  }
  for (const auto& sighting : changes.sightings) {
    if (sighting.slot >= kMaxSlots) return fmt::format("there are more than {} sightings", kMaxSlots);
  }
  return std::nullopt;
}

void Members::report_moves(const Member& member, const MapChanges& changes) {
  for (const auto& pose : changes.moved) {
    const auto* place = member.map.find(pose.id);
    if (!place) continue;
    const double moved_m = (place->map_from_base.translation() - pose.map_from_base.translation()).norm();
    if (moved_m > parameters_.max_move_m) {
      news_.push_back(fmt::format("{} moved its place {} by {:.1f} m", member.robot, pose.id, moved_m));
    }
  }
}

std::vector<Members::Gap> Members::gaps(std::int64_t now_ns, std::size_t most) {
  std::vector<Gap> found;
  for (auto& [map, member] : members_) {
    if (found.size() >= most) break;
    if (!member.is_present || !member.behind_since_ns || now_ns - *member.behind_since_ns < kInFlight_ns) continue;
    if (member.asked_ns && now_ns - *member.asked_ns < ns(parameters_.retry_s)) continue;
    member.asked_ns = now_ns;
    ++member.missed;
    found.push_back({map, member.map.version()});
  }
  return found;
}

void Members::advance(std::int64_t now_ns) {
  for (auto& [map, member] : members_) {
    if (!member.is_present || now_ns - member.heard_ns < ns(parameters_.absent_s)) continue;
    member.is_present = false;
    news_.push_back(fmt::format("{} has gone silent; its map {} is kept", member.robot, to_text(map)));
  }
}

const Member* Members::find(MapId map) const {
  const auto found = members_.find(map);
  return found == members_.end() ? nullptr : &found->second;
}

Member* Members::known(const std::string& robot) {
  const auto found = map_of_.find(robot);
  return found == map_of_.end() ? nullptr : &members_.at(found->second);
}

std::set<MapId> Members::present() const {
  std::set<MapId> found;
  for (const auto& [map, member] : members_) {
    if (member.is_present) found.insert(map);
  }
  return found;
}

std::map<MapId, MapId> Members::frames_used() const {
  std::map<MapId, MapId> found;
  for (const auto& [map, member] : members_) {
    if (member.is_present) found[map] = member.last.common_map;
  }
  return found;
}

std::size_t Members::places() const {
  std::size_t count = 0;
  for (const auto& [map, member] : members_) count += member.map.places().size();
  return count;
}

std::vector<std::string> Members::take_news() {
  if (news_.size() > kMaxNews) news_.resize(kMaxNews);
  return std::exchange(news_, {});
}

std::vector<MapId> Members::take_restarted() { return std::exchange(restarted_, {}); }

}  // namespace panvo::fleet
