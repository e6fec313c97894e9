// SPDX-License-Identifier: Apache-2.0
#include "endpoint_qos.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "participant_qos.hpp"

namespace panvo::runtime::dds {

namespace fdds = eprosima::fastdds::dds;
using interfaces::Durability;
using interfaces::Reliability;

namespace {

// A lost fragment or acknowledgement is noticed at the next heartbeat, which has to come well within the time
// a write may wait. Fast DDS's default is 3 s. Sent only while something is unacknowledged.
constexpr std::chrono::milliseconds kHeartbeatPeriod{20};
constexpr int kPreallocatedSamples = 4;

fdds::DurabilityQosPolicyKind durability_kind(Durability durability) {
  return durability == Durability::kTransientLocal ? fdds::TRANSIENT_LOCAL_DURABILITY_QOS
                                                   : fdds::VOLATILE_DURABILITY_QOS;
}

// What writers and readers have in common.
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
  qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  if (topic.type) {
    const std::string hash = fmt::format("typehash={};", topic.type->hash);
    qos.user_data().setValue(std::vector<eprosima::fastrtps::rtps::octet>(hash.begin(), hash.end()));
  }
}

struct PolicyText {
  std::string_view difference, remedy;
};

PolicyText describe(fdds::QosPolicyId_t policy) {
  switch (policy) {
    case fdds::RELIABILITY_QOS_POLICY_ID:
      return {"the reader asks for reliable delivery and the writer offers best effort",
              "let the reader ask for best effort, or the writer offer reliable"};
    case fdds::DURABILITY_QOS_POLICY_ID:
      return {"the reader asks for transient local (what was sent before it came) and the writer offers volatile",
              "let the reader ask for volatile, or the writer offer transient local"};
    case fdds::DEADLINE_QOS_POLICY_ID:
      return {"the reader asks for a shorter deadline than the writer offers", "remove the reader's deadline"};
    case fdds::LIVELINESS_QOS_POLICY_ID:
      return {"the reader asks for a stricter liveliness than the writer offers",
              "let the reader ask for automatic liveliness"};
    case fdds::OWNERSHIP_QOS_POLICY_ID:
      return {"one side has exclusive ownership", "let both sides use shared ownership"};
    default:
      return {"their quality of service is incompatible", "compare them with `ros2 topic info --verbose`"};
  }
}

}  // namespace

eprosima::fastrtps::Duration_t to_dds(std::chrono::nanoseconds time) {
  time = std::max(time, std::chrono::nanoseconds(0));
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(time);
  return {static_cast<std::int32_t>(seconds.count()), static_cast<std::uint32_t>((time - seconds).count())};
}

void apply(const TopicDescription& topic, fdds::DataWriterQos& qos) {
  apply_common(topic, qos);
  // A reliable writer serves readers of either kind; who wants best effort is not slowed by it.
  qos.reliability().kind = fdds::RELIABLE_RELIABILITY_QOS;
  qos.reliability().max_blocking_time = to_dds(kMaxBlockingTime);
  // Topics of which only the newest counts carry images. Their fragments are sent from a thread of Fast
  // DDS's, so that a network slower than the camera does not hold the publisher (at 100 Mbit/s a panorama of
  // 1.75 MB held it for 122 ms, now 0.8 ms). Others are small and leave at once.
  // And at a pace that a receiver keeps up with, see participant_qos().
  if (topic.qos.requested == Reliability::kBestEffort) {
    qos.publish_mode().kind = fdds::ASYNCHRONOUS_PUBLISH_MODE;
    qos.publish_mode().flow_controller_name = kImagePace;
  }
  qos.reliable_writer_qos().times.heartbeatPeriod = to_dds(kHeartbeatPeriod);
  qos.representation().m_value = {fdds::XCDR_DATA_REPRESENTATION};
  if (topic.qos.deadline.count() > 0) qos.deadline().period = to_dds(topic.qos.deadline);
  if (topic.qos.lifespan.count() > 0) qos.lifespan().duration = to_dds(topic.qos.lifespan);
  // ROS 2 has data sharing off, and a reader of it that is slower than its writer would see its samples
  // change.
  qos.data_sharing().off();
}

void apply(const TopicDescription& topic, fdds::DataReaderQos& qos) {
  apply_common(topic, qos);
  // A profile may ask for more than a topic needs: where the network loses packets, an image hardly ever comes whole at the first attempt.
  const bool is_reliable_by_profile = qos.reliability().kind == fdds::RELIABLE_RELIABILITY_QOS;
  qos.reliability().kind = topic.qos.requested == Reliability::kReliable || is_reliable_by_profile
                               ? fdds::RELIABLE_RELIABILITY_QOS
                               : fdds::BEST_EFFORT_RELIABILITY_QOS;
  qos.type_consistency().representation.m_value = {fdds::XCDR_DATA_REPRESENTATION};
  qos.data_sharing().off();
}

std::string describe_offer_refused(const std::string& topic, fdds::QosPolicyId_t policy) {
  const auto [difference, remedy] = describe(policy);
  return fmt::format("topic {}: a reader in another process gets nothing from here: {}. Remedy: {}.", topic, difference,
                     remedy);
}

std::string describe_request_refused(const std::string& topic, fdds::QosPolicyId_t policy) {
  const auto [difference, remedy] = describe(policy);
  return fmt::format("topic {}: nothing is received from a writer in another process: {}. Remedy: {}.", topic,
                     difference, remedy);
}

}  // namespace panvo::runtime::dds
