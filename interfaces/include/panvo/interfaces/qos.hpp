// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>

namespace panvo::interfaces {

enum class Reliability { kBestEffort, kReliable };
enum class Durability { kVolatile, kTransientLocal };

/// The quality of service of a topic, in ROS 2's terms. A writer always offers reliable, so that it matches every reader; `requested`
/// is what our readers ask for, so that a camera driver that offers best effort still matches.
struct Qos {
  Reliability requested = Reliability::kReliable;
  Durability durability = Durability::kVolatile;
  /// Keep last; of each input of a component too: what is more is dropped, oldest first, and counted.
  std::size_t depth = 10;
  bool keep_all = false;                  ///< nothing is dropped: `depth` is then the bound at which a writer waits
  std::chrono::milliseconds deadline{0};  ///< the writer publishes at least this often; 0: no promise
  std::chrono::milliseconds lifespan{
      0};  ///< an older message is not delivered, not to late joiners either; 0: no limit
};

namespace qos {
/// ROS 2's default.
inline constexpr Qos kDefault{};
/// ROS 2's sensor data: the newest few, late ones are worth nothing.
inline constexpr Qos kSensorData{.requested = Reliability::kBestEffort, .depth = 5};
/// A result a frame; deep enough that a reader may pause a second or two.
inline constexpr Qos kResult{.depth = 50};
/// What a late joiner must still get, in one message: tf_static.
inline constexpr Qos kLatched{.durability = Durability::kTransientLocal, .depth = 10};
/// A state that is repeated: a late joiner gets the last one, but never one that its writer stopped confirming.
inline constexpr Qos kState{.durability = Durability::kTransientLocal,
                            .depth = 1,
                            .deadline = std::chrono::milliseconds(1000),
                            .lifespan = std::chrono::milliseconds(3000)};
/// rosout as ROS 2 has it.
inline constexpr Qos kLog{.durability = Durability::kTransientLocal, .depth = 1000};
/// Events of which none may be missed, not by late joiners either: landmarks.
inline constexpr Qos kHistory{.durability = Durability::kTransientLocal, .depth = 10000, .keep_all = true};
}  // namespace qos

}  // namespace panvo::interfaces
