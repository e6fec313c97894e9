// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>

namespace panvo::interfaces {

enum class Reliability { kBestEffort, kReliable };
enum class Durability { kVolatile, kTransientLocal };

/// Quality of service of a topic, in ROS 2's terms. Writers offer reliable delivery and so match every reader, unless
/// `offered` is overridden. Readers request `requested`; best effort also matches camera drivers that offer no more.
struct Qos {
  Reliability requested = Reliability::kReliable;
  Durability durability = Durability::kVolatile;
  /// Messages kept per writer, reader and component input. Further ones are dropped, oldest first, and counted.
  std::size_t depth = 10;
  bool keep_all = false;                         ///< drop nothing: with `depth` messages pending, a writer waits
  std::chrono::milliseconds deadline{0};         ///< longest time between messages of a writer; 0: no limit
  std::chrono::milliseconds lifespan{0};         ///< age beyond which a message is not delivered; 0: no limit
  Reliability offered = Reliability::kReliable;  ///< by writers

  bool operator==(const Qos&) const = default;
};

namespace qos {
/// ROS 2's default.
inline constexpr Qos kDefault{};
/// ROS 2's sensor data profile: only the newest messages are useful.
inline constexpr Qos kSensorData{.requested = Reliability::kBestEffort, .depth = 5};
/// One result per frame; deep enough for a reader that pauses for a second or two.
inline constexpr Qos kResult{.depth = 50};
/// Also delivered to late joiners: tf_static.
inline constexpr Qos kLatched{.durability = Durability::kTransientLocal, .depth = 10};
/// A state that is repeated. Late joiners get the last message unless its writer has stopped repeating it.
inline constexpr Qos kState{.durability = Durability::kTransientLocal,
                            .depth = 1,
                            .deadline = std::chrono::milliseconds(1000),
                            .lifespan = std::chrono::milliseconds(3000)};
/// ROS 2's profile of rosout.
inline constexpr Qos kLog{.durability = Durability::kTransientLocal, .depth = 1000};
/// Events that every reader must get, late joiners included: landmarks.
inline constexpr Qos kHistory{.durability = Durability::kTransientLocal, .depth = 1'000'000, .keep_all = true};
}  // namespace qos

}  // namespace panvo::interfaces
