// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include <mutex>
#include <optional>
#include <string>

#include "fast_dds.hpp"
#include "panvo/runtime/bridge.hpp"

namespace panvo::runtime::dds {

/// Locked while Fast DDS's factory is used, which has the environment, the profiles and the user's name in memory that
/// all threads share. The functions below lock it where needed, except participant_qos().
std::mutex& factory_mutex();

/// Loads the user's profiles into Fast DDS: those named by its environment variables, then `settings.profiles`. Throws
/// ConfigError if the file cannot be read or is invalid (naming it), or if the domain is out of range.
void load_profiles(const DdsSettings& settings);

inline constexpr const char* kSharedMemoryFolder = "/dev/shm";

/// Flow controller of paced writers. It limits the data per millisecond to what fits into a receiver's socket buffer at
/// the system default (208 KB), to avoid losses. Once used, it wakes up 1000 times per second: 2 % of a core.
inline constexpr const char* kPace = "panvo_pace";

/// Whether sockets of panvo's own processes have smaller buffers than they ask for, so that image writers must be paced
/// for them.
bool has_small_socket_buffers();

/// False in containers or sandboxes where it is missing or not writable.
bool has_shared_memory();

/// Warning about the loaded profiles, if any.
std::optional<std::string> profile_warning();

/// What a participant learns from a discovery server. Without a server, all learn of all endpoints.
enum class Hears {
  kMatching,  ///< of endpoints that match its own
  kAll        ///< of all endpoints
};

/// Whether participants meet by means of the server in ROS_DISCOVERY_SERVER.
bool has_discovery_server();

/// That the server does not answer, with the remedy.
std::string silent_server_warning();

/// QoS of a participant, from a profile or our defaults: UDP with buffers for images, ROS 2's user data, and ignoring
/// other participants of the same process as far as Fast DDS can identify them (see own_participants.hpp). Call it with
/// factory_mutex() locked.
fdds::DomainParticipantQos participant_qos(const DdsSettings& settings, Hears hears);

}  // namespace panvo::runtime::dds
