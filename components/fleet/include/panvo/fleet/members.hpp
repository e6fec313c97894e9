// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "panvo/fleet/shared_map.hpp"
#include "panvo/landmarks/description_settings.hpp"

namespace panvo::fleet {

struct MemberParameters {
  int max_robots = 64;
  int max_places = 5000;
  double absent_s = 5.0;
  double silent_s = 3.0;
  double retry_s = 2.0;
  double max_move_m = 5.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = MemberParameters;
    field(
        &P::max_robots, "max_robots", "1",
        "largest number of other robots, and of their maps; further ones are refused. Maps of absent robots make room",
        1, 1000);
    field(&P::max_places, "max_places", "1", "largest number of places of all their maps, 8 kB each; more are refused",
          1, 1'000'000);
    field(&P::absent_s, "absent_s", "s", "silence after which a robot counts as absent; its map is kept", 1.0, 3600.0);
    field(&P::silent_s, "silent_s", "s",
          "silence after which another process may take over a robot's name: a restart. Before, it is refused: two "
          "robots have one name",
          1.0, 3600.0);
    field(&P::retry_s, "retry_s", "s", "time after which something missing is asked for again", 0.1, 60.0);
    field(&P::max_move_m, "max_move_m", "m", "a place moved farther by its owner is reported", 0.1, 1000.0);
  }
};

/// A robot's announcement, sent once a second.
struct Announcement {
  std::string robot;
  MapId map = 0;
  std::uint64_t session = 0;
  std::uint64_t version = 0;  ///< the latest one sent
  std::uint64_t digest = 0;   ///< at this version; 0: not known
  std::uint32_t places = 0;
  std::string settings;  ///< of its descriptions, "key=value" lines
  MapId common_map = 0;
};

/// A replica of the map of another robot, and what was heard of that robot.
struct Member {
  std::string robot;
  SharedMap map;
  Announcement last;
  std::int64_t heard_ns = 0;
  bool is_present = true;
  std::optional<std::int64_t> behind_since_ns;  ///< less was received than announced
  std::optional<std::int64_t> asked_ns;
  int missed = 0;          ///< changes asked for again
  int contradictions = 0;  ///< contents unlike their digest, one after another
  int overtaken = 0;       ///< announcements of less than was received, one after another
};

/// The other robots and replicas of their maps. Their messages may be lost, doubled, late, or wrong; what is unusable is
/// refused with a reason. Times are of this computer's monotonic clock.
class Members {
 public:
  Members(const MemberParameters& parameters, std::string own_robot, landmarks::DescriptionSettings settings,
          landmarks::DescriptionLimits limits);

  /// The reason why an announcement is refused; nullopt if it is used.
  std::optional<std::string> hear(const Announcement& said, std::int64_t now_ns);
  /// Likewise for changes. Changes that arrive early or late are ignored, not refused.
  std::optional<std::string> take(const std::string& robot, const MapChanges& changes, std::int64_t now_ns);

  /// A map of which changes are missing, and the version from which on.
  struct Gap {
    MapId map = 0;
    std::uint64_t from_version = 0;
  };
  /// What to ask for now, at most `most`.
  std::vector<Gap> gaps(std::int64_t now_ns, std::size_t most);

  /// Notes which robots have fallen silent.
  void advance(std::int64_t now_ns);

  const std::map<MapId, Member>& all() const noexcept { return members_; }
  const Member* find(MapId map) const;
  std::set<MapId> present() const;
  /// For each present map, the map whose frame its robot uses.
  std::map<MapId, MapId> frames_used() const;
  std::size_t places() const;

  /// What a user should know, since the last call: robots that came, left, restarted or caught up; maps started again.
  std::vector<std::string> take_news();
  /// Maps whose replicas were started again since the last call: what was derived from their places is void.
  std::vector<MapId> take_restarted();

 private:
  std::optional<std::string> objection(const Announcement& said, std::int64_t now_ns);
  std::optional<std::string> make_room();
  Member* known(const std::string& robot);
  void begin(const Announcement& said);
  void start_again(Member& member, const std::string& why);
  bool is_overtaken(Member& member, const Announcement& said);
  void compare(Member& member, std::int64_t now_ns);
  std::optional<std::string> fault_of(const MapChanges& changes) const;
  void report_moves(const Member& member, const MapChanges& changes);

  const MemberParameters parameters_;
  const std::string own_robot_;
  const landmarks::DescriptionSettings settings_;
  const landmarks::DescriptionLimits limits_;
  std::map<MapId, Member> members_;
  std::map<std::string, MapId> map_of_;  // the current map of each robot
  std::vector<std::string> news_;
  std::vector<MapId> restarted_;
};

}  // namespace panvo::fleet
