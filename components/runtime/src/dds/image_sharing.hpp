// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "fast_dds.hpp"
#include "panvo/runtime/bridge.hpp"

namespace panvo::runtime::dds {

/// Fast DDS data sharing for images: the writer's messages are in memory that readers on the same machine map as well.
/// An image is serialised directly into it and read directly from it, in the same form as sent to other readers,
/// without copies. The same writer serves sharing and other readers, so no reader gets an image twice.
///
/// No side waits: the writer reuses its memory even if a slow reader has not finished. An image that is overwritten
/// while being read is dropped and counted.

/// Largest serialised size of messages of that type that the process shares; 0: no sharing, as with encryption.
std::uint32_t max_shared(const DdsSettings& settings, const std::string& wire_type_name);

/// Warning if image sharing is requested but impossible.
std::optional<std::string> sharing_warning(const DdsSettings& settings);

/// Identifies processes that can share memory: same user, same kernel, same /dev/shm and same Fast DDS build. Fast
/// DDS's own identifier is derived from the network card: it would also match processes in different containers, whose
/// messages would be lost, and other builds with an incompatible memory layout.
std::uint64_t sharing_neighbourhood();
bool is_in_neighbourhood(const fdds::DataSharingQosPolicy& sharing);

/// Makes an endpoint share memory where possible. Readers still receive messages of any size from other writers.
void share(fdds::DataWriterQos& qos);
void share(fdds::DataReaderQos& qos);

/// Upper bound of the memory reserved by a writer with history `depth` for messages of up to `max_size` bytes.
std::uint64_t room_for_writer(std::size_t depth, std::uint32_t max_size);
/// The same for a reader, which only receives notifications.
inline constexpr std::uint64_t kRoomForReader = 65536;

}  // namespace panvo::runtime::dds
