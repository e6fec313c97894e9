// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include <cstdint>
#include <string>

#include "panvo/runtime/bridge.hpp"

namespace panvo::runtime::dds {

/// Fast DDS's data sharing, as images use it: the writer's messages lie in memory that its readers on the same machine map too. An image is
/// serialised straight into it and read straight out of it, in the form in which it is sent to all others; nothing is copied on the way, and
/// no reader gets it twice, since it is the same writer that serves readers which share its memory and readers which do not.
///
/// Nobody waits for anybody: a writer goes round in its memory whether a slow reader has read it or not. What was overwritten before it was read
/// to the end is dropped and counted.

/// Up to which size, serialised, a process shares messages of that type; 0: it shares none.
std::uint32_t shared_size(const DdsSettings& settings, const std::string& wire_type_name);

/// Who bears the same number can map each other's memory: processes of the same user on the same kernel that see the same /dev/shm. (Fast
/// DDS's own is the network card's: processes in two containers would take themselves for neighbours, and nothing would arrive.)
std::uint64_t sharing_neighbourhood();

/// An endpoint that shares memory with those who do; messages of others, of any size, come to a reader as ever.
void share(eprosima::fastdds::dds::DataWriterQos& qos);
void share(eprosima::fastdds::dds::DataReaderQos& qos);

/// A writer of messages of any size, of a type that others share.
void send_any_size(eprosima::fastdds::dds::DataWriterQos& qos);

}  // namespace panvo::runtime::dds
