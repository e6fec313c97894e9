// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/core/policy/QosPolicies.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include <chrono>
#include <string>

#include "panvo/runtime/bridge.hpp"

namespace panvo::runtime::dds {

/// How long a write may wait for a slow reliable reader of a keep-all topic: 100 ms in all. In two attempts,
/// as Fast DDS 2.9 ends the first with an error when, while it waited for room for one message,
/// acknowledgements emptied the whole history.
inline constexpr int kWriteAttempts = 2;
inline constexpr std::chrono::milliseconds kMaxBlockingTime{50};

/// A time in the terms of DDS; negative times are none.
eprosima::fastrtps::Duration_t to_dds(std::chrono::nanoseconds time);

/// Sets what a topic's QoS says, and what ROS 2 expects of a writer or reader, on top of the participant's
/// defaults (`qos`), which may come from a user's profile.
void apply(const TopicDescription& topic, eprosima::fastdds::dds::DataWriterQos& qos);
void apply(const TopicDescription& topic, eprosima::fastdds::dds::DataReaderQos& qos);

/// What users are told when our writer (or reader) of `topic` and a reader (or writer) of another process
/// cannot meet because of that policy: which topic, what differs, and the remedy.
std::string describe_offer_refused(const std::string& topic, eprosima::fastdds::dds::QosPolicyId_t policy);
std::string describe_request_refused(const std::string& topic, eprosima::fastdds::dds::QosPolicyId_t policy);

}  // namespace panvo::runtime::dds
