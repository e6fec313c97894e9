// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "panvo/interfaces/qos.hpp"

namespace panvo::recorder {

/// The quality of service that one recorded publisher offered, as rosbag2 stores it. The values are those of ROS 2's
/// rmw layer: bags up to metadata version 8 hold them as numbers, later ones as names.
struct QosProfile {
  enum class History { kSystemDefault = 0, kKeepLast = 1, kKeepAll = 2, kUnknown = 3 };
  enum class Reliability { kSystemDefault = 0, kReliable = 1, kBestEffort = 2, kUnknown = 3, kBestAvailable = 4 };
  enum class Durability { kSystemDefault = 0, kTransientLocal = 1, kVolatile = 2, kUnknown = 3, kBestAvailable = 4 };
  enum class Liveliness {
    kSystemDefault = 0,
    kAutomatic = 1,
    kManualByNode = 2,
    kManualByTopic = 3,
    kUnknown = 4,
    kBestAvailable = 5
  };
  /// Infinite unless it says otherwise.
  struct Duration {
    std::int64_t sec = 9223372036;
    std::int64_t nsec = 854775807;
    bool operator==(const Duration&) const = default;
  };

  History history = History::kKeepLast;
  std::int64_t depth = 10;
  Reliability reliability = Reliability::kReliable;
  Durability durability = Durability::kVolatile;
  Duration deadline, lifespan;
  Liveliness liveliness = Liveliness::kAutomatic;
  Duration liveliness_lease_duration;
  bool avoid_ros_namespace_conventions = false;

  bool operator==(const QosProfile&) const = default;
};

/// How the policies are written: "reliability: reliable" (metadata version 9) or "reliability: 1" (up to version 8).
enum class QosNotation { kNames, kNumbers };

/// What our publishers of a topic with this quality of service offer.
QosProfile offered_profile(const interfaces::Qos& qos);

/// What to publish a recorded topic with, so that whoever subscribed to the original publishers matches the replay.
/// `message_count` is the number of recorded messages: of a latched topic all are kept for late joiners, as they may
/// have come from several publishers.
interfaces::Qos replay_qos(const std::vector<QosProfile>& offered, std::uint64_t message_count);

/// The profiles as the YAML sequence that a bag holds; "" for none.
std::string to_text(const std::vector<QosProfile>& profiles, QosNotation notation);

/// Reads either notation; "" is no profile. nullopt: not a sequence of profiles.
std::optional<std::vector<QosProfile>> parse_qos_profiles(const std::string& text);

}  // namespace panvo::recorder
