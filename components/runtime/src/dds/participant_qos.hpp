// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include <optional>
#include <string>

#include "panvo/runtime/bridge.hpp"

namespace panvo::runtime::dds {

/// Whether a participant sends messages or receives them.
enum class Role { kWriters, kReaders };

/// Reads the user's profiles into Fast DDS: those its environment variables name, then `settings.profiles`.
/// Throws ConfigError naming the file when it cannot be read or understood, or when the domain is out of
/// range.
void load_profiles(const DdsSettings& settings);

inline constexpr const char* kSharedMemoryFolder = "/dev/shm";

/// What writers of images send with: as much in a millisecond as fits into a receiver's socket buffer where the system's default is not raised
/// (208 KB), so that what comes at once is not lost there.
inline constexpr const char* kImagePace = "panvo_images";

/// In a container or a sandbox there may be none, or one that cannot be written.
bool has_shared_memory();

/// What users should know of the profiles that were loaded.
std::optional<std::string> profile_warning();

/// A participant as a profile or else we configure it: UDP sized for images, marked as ROS 2 participants are, and blind to participants of its
/// own process as far as Fast DDS can tell which these are (see own_participants.hpp).
eprosima::fastdds::dds::DomainParticipantQos participant_qos(const DdsSettings& settings, Role role);

}  // namespace panvo::runtime::dds
