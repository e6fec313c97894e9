// SPDX-License-Identifier: Apache-2.0
#include "endpoint_qos.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "fast_dds.hpp"
#include "panvo/interfaces/service_type.hpp"
#include "participant_qos.hpp"

namespace panvo::runtime::dds {

using interfaces::Durability;
using interfaces::Reliability;

namespace {

// A lost fragment or acknowledgement is detected at the next heartbeat, which must come well within the limit of a
// write. Fast DDS's default is 3 s. Heartbeats are sent only while data is unacknowledged.
constexpr std::chrono::milliseconds kHeartbeatPeriod{20};
constexpr int kPreallocatedSamples = 4;

// ROS 2's QoS of service topics, but a second of requests at their default limit instead of 10. All clients of a service
// read the same replies. A new client keeps its first one until it knows that the earlier ones are not for it;
// meanwhile, the replies to a busy client must not push it out of the history of the service, nor of the reader.
constexpr interfaces::Qos kServiceQos{.depth = 1000};

// How soon the reader of a service finds that out. Fast DDS's defaults are 70 ms and 5 ms.
constexpr std::chrono::milliseconds kServiceAcknowledgement{1};

fdds::DurabilityQosPolicyKind durability_kind(Durability durability) {
  return durability == Durability::kTransientLocal ? fdds::TRANSIENT_LOCAL_DURABILITY_QOS
                                                   : fdds::VOLATILE_DURABILITY_QOS;
}

/// ROS 2's user data of an endpoint.
template <class EndpointQos>
void set_type_hash(std::string_view type_hash, EndpointQos& qos) {
  const std::string text = fmt::format("typehash={};", type_hash);
  qos.user_data().setValue(std::vector<rtps::octet>(text.begin(), text.end()));
}

// QoS common to writers and readers.
template <class EndpointQos>
void apply_common(const TopicDescription& topic, EndpointQos& qos) {
  const int depth = static_cast<int>(
      std::clamp<std::size_t>(topic.qos.depth, 1, static_cast<std::size_t>(std::numeric_limits<int>::max())));
  qos.durability().kind = durability_kind(topic.qos.durability);
  qos.history().kind = topic.qos.keep_all ? fdds::KEEP_ALL_HISTORY_QOS : fdds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = depth;
  qos.resource_limits().max_samples = depth;
  qos.resource_limits().max_instances = 1;
  qos.resource_limits().max_samples_per_instance = depth;
  qos.resource_limits().allocated_samples = std::min(depth, kPreallocatedSamples);
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  if (topic.type) set_type_hash(topic.type->hash, qos);
}

template <class EndpointQos>
void apply_service(const ServiceDescription& service, EndpointQos& qos) {
  apply(TopicDescription{service.name, service.type_name, kServiceQos, nullptr}, qos);
  if (const auto hash = interfaces::service_hash(service.type_name); !hash.empty()) set_type_hash(hash, qos);
}

struct PolicyText {
  std::string_view difference, remedy;
};

PolicyText policy_text(fdds::QosPolicyId_t policy) {
  switch (policy) {
    case fdds::RELIABILITY_QOS_POLICY_ID:
      return {"the reader requests reliable delivery and the writer offers best effort",
              "use best effort for the reader, or reliable for the writer"};
    case fdds::DURABILITY_QOS_POLICY_ID:
      return {"the reader requests transient local (earlier messages) and the writer offers volatile",
              "use volatile for the reader, or transient local for the writer"};
    case fdds::DEADLINE_QOS_POLICY_ID:
      return {"the reader requests a shorter deadline than the writer offers", "remove the reader's deadline"};
    case fdds::LIVELINESS_QOS_POLICY_ID:
      return {"the reader requests a stricter liveliness than the writer offers",
              "use automatic liveliness for the reader"};
    case fdds::OWNERSHIP_QOS_POLICY_ID:
      return {"one side has exclusive ownership", "use shared ownership on both sides"};
    default:
      return {"their quality of service is incompatible", "compare them with `ros2 topic info --verbose`"};
  }
}

}  // namespace

Duration to_dds(std::chrono::nanoseconds time) {
  time = std::max(time, std::chrono::nanoseconds(0));
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(time);
  return {static_cast<std::int32_t>(seconds.count()), static_cast<std::uint32_t>((time - seconds).count())};
}

void apply(const TopicDescription& topic, fdds::DataWriterQos& qos) {
  apply_common(topic, qos);
  // A reliable writer also serves best-effort readers, without delaying them.
  qos.reliability().kind =
      topic.qos.offered == Reliability::kReliable ? fdds::RELIABLE_RELIABILITY_QOS : fdds::BEST_EFFORT_RELIABILITY_QOS;
  qos.reliability().max_blocking_time = to_dds(kMaxBlockingTime);
  // Best-effort topics carry images. They are sent asynchronously, so a network slower than the camera does not block
  // the publisher (at 100 Mbit/s a panorama of 1.75 MB blocked it for 122 ms, now 0.8 ms). Other messages are small and
  // sent at once.
  if (topic.qos.requested == Reliability::kBestEffort) qos.publish_mode().kind = fdds::ASYNCHRONOUS_PUBLISH_MODE;
  set_heartbeat(to_dds(kHeartbeatPeriod), qos);
  qos.representation().m_value = {fdds::XCDR_DATA_REPRESENTATION};
  // Readers filter, see remote_only_filter.hpp: a writer would send the result with each message.
  qos.writer_resource_limits().reader_filters_allocation = {0, 0, 0};
  if (topic.qos.deadline.count() > 0) qos.deadline().period = to_dds(topic.qos.deadline);
  if (topic.qos.lifespan.count() > 0) qos.lifespan().duration = to_dds(topic.qos.lifespan);
  // Data sharing is off, as in ROS 2: samples of a reader slower than the writer would change.
  qos.data_sharing().off();
}

void apply(const TopicDescription& topic, fdds::DataReaderQos& qos) {
  apply_common(topic, qos);
  // A profile may request reliability: with packet loss, an image rarely arrives complete at the first attempt.
  const bool is_reliable_by_profile = qos.reliability().kind == fdds::RELIABLE_RELIABILITY_QOS;
  qos.reliability().kind = topic.qos.requested == Reliability::kReliable || is_reliable_by_profile
                               ? fdds::RELIABLE_RELIABILITY_QOS
                               : fdds::BEST_EFFORT_RELIABILITY_QOS;
  set_representation(qos);
  qos.data_sharing().off();
}

void apply(const ServiceDescription& service, fdds::DataWriterQos& qos) { apply_service(service, qos); }
void apply(const ServiceDescription& service, fdds::DataReaderQos& qos) {
  apply_service(service, qos);
  set_acknowledgement_delays(to_dds(kServiceAcknowledgement), qos);
}

std::string describe_offer_refused(const std::string& topic, fdds::QosPolicyId_t policy) {
  const auto [difference, remedy] = policy_text(policy);
  return fmt::format("topic {}: a reader in another process receives nothing from here: {}. Remedy: {}.", topic,
                     difference, remedy);
}

std::string describe_request_refused(const std::string& topic, fdds::QosPolicyId_t policy) {
  const auto [difference, remedy] = policy_text(policy);
  return fmt::format("topic {}: nothing is received from a writer in another process: {}. Remedy: {}.", topic,
                     difference, remedy);
}

}  // namespace panvo::runtime::dds
