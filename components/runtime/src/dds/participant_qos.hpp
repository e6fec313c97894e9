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

/// In a container or a sandbox there may be none, or one that cannot be written.
bool has_shared_memory();

/// What users should know when processes of this machine cannot share memory.
std::optional<std::string> shared_memory_warning();

/// A participant as a profile or else we configure it: shared memory and UDP transports sized for images,
/// marked as ROS 2 participants are, and blind to participants of its own process.
eprosima::fastdds::dds::DomainParticipantQos participant_qos(const DdsSettings& settings, Role role);

}  // namespace panvo::runtime::dds
