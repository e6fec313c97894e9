// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "panvo/interfaces/qos.hpp"

namespace panvo::recorder {

/// Quality of service offered by one recorded publisher, as stored by rosbag2. The values are those of ROS 2's rmw
/// layer: stored as numbers up to metadata version 8, as names since version 9.
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
  /// Default: infinite, in rmw's encoding.
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

/// Notation of the policies: "reliability: reliable" (metadata version 9) or "reliability: 1" (up to version 8).
enum class QosNotation { kNames, kNumbers };

/// Profile offered by our publishers of a topic with this quality of service.
QosProfile offered_profile(const interfaces::Qos& qos);

/// Quality of service for replaying a topic, compatible with all subscribers of the original publishers.
/// `message_count`: recorded messages of the topic. A latched topic keeps up to 1000 of them for late joiners, since
/// they may come from several publishers.
interfaces::Qos replay_qos(const std::vector<QosProfile>& offered, std::uint64_t message_count);

/// The profiles as the YAML sequence stored in a bag; "" if there are none.
std::string to_text(const std::vector<QosProfile>& profiles, QosNotation notation);

/// Parses either notation; "" gives no profiles. Returns nullopt if the text is not a sequence of profiles.
std::optional<std::vector<QosProfile>> parse_qos_profiles(const std::string& text);

}  // namespace panvo::recorder
