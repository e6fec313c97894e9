// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "panvo/runtime/bridge.hpp"

namespace panvo::runtime::dds {

/// Fast DDS's data sharing, as images use it: the writer's messages lie in memory that its readers on the same machine map too. An image is
/// serialised straight into it and read straight out of it, in the form in which it is sent to all others; nothing is copied on the way, and
/// no reader gets it twice, since it is the same writer that serves readers which share its memory and readers which do not.
///
/// Nobody waits for anybody: a writer goes round in its memory whether a slow reader has read it or not. What was overwritten before it was read
/// to the end is dropped and counted.

/// Up to which size, serialised, a process shares messages of that type; 0: it shares none, as where messages are encrypted.
std::uint32_t largest_shared(const DdsSettings& settings, const std::string& wire_type_name);

/// What users should know where images were to be shared and no process can.
std::optional<std::string> sharing_warning(const DdsSettings& settings);

/// Who bears the same number can map each other's memory and finds in it what he expects: processes of the same user on the same kernel that see
/// the same /dev/shm and run the same build of Fast DDS. (Fast DDS's own is the network card's: processes in two containers would take
/// themselves for neighbours, and nothing would arrive; or what another build lays out in another way.)
std::uint64_t sharing_neighbourhood();
bool is_in_neighbourhood(const eprosima::fastdds::dds::DataSharingQosPolicy& sharing);

/// An endpoint that shares memory with those who do; messages of others, of any size, come to a reader as ever.
void share(eprosima::fastdds::dds::DataWriterQos& qos);
void share(eprosima::fastdds::dds::DataReaderQos& qos);

/// An upper bound of the memory that the writer of a topic of that depth reserves for messages of up to `max_size` bytes.
std::uint64_t room_for_writer(std::size_t depth, std::uint32_t max_size);
/// The same of a reader, which only has to be told that something is there.
inline constexpr std::uint64_t kRoomForReader = 65536;

}  // namespace panvo::runtime::dds
