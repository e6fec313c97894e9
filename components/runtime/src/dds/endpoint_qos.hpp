// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/core/policy/QosPolicies.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include <chrono>
#include <string>

#include "fast_dds.hpp"
#include "panvo/runtime/bridge.hpp"

namespace panvo::runtime::dds {

/// Limit for a write that waits for a slow reliable reader of a keep-all topic: 100 ms in total. Split into two
/// attempts because Fast DDS 2.9 reports an error on the first one if acknowledgements empty the whole history during
/// the wait.
inline constexpr int kWriteAttempts = 2;
inline constexpr std::chrono::milliseconds kMaxBlockingTime{50};

/// Converts to a DDS duration; negative times become 0.
Duration to_dds(std::chrono::nanoseconds time);

/// Applies a topic's QoS and ROS 2's conventions to `qos`, which holds the participant's defaults (possibly from a
/// user's profile).
void apply(const TopicDescription& topic, fdds::DataWriterQos& qos);
void apply(const TopicDescription& topic, fdds::DataReaderQos& qos);

/// The same for the topics of a service.
void apply(const ServiceDescription& service, fdds::DataWriterQos& qos);
void apply(const ServiceDescription& service, fdds::DataReaderQos& qos);

/// Warning for a writer (or reader) of `topic` that is incompatible with a remote reader (or writer) in that policy:
/// topic, difference, remedy.
std::string describe_offer_refused(const std::string& topic, fdds::QosPolicyId_t policy);
std::string describe_request_refused(const std::string& topic, fdds::QosPolicyId_t policy);

}  // namespace panvo::runtime::dds
