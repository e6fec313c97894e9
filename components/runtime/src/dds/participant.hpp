// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "discovery.hpp"
#include "local_endpoints.hpp"
#include "names.hpp"
#include "panvo/runtime/bridge.hpp"
#include "participant_qos.hpp"

namespace panvo::runtime::dds {

/// A Fast DDS participant with what its endpoints share. Shared by the bridge and its endpoints: it goes with
/// the last of them, so that no order of destruction leaves an endpoint without it. Safe to use from several
/// threads.
class Participant : public std::enable_shared_from_this<Participant> {
 public:
  /// Throws ConfigError when there can be none.
  Participant(const DdsSettings& settings, Role role, std::shared_ptr<Discovery> discovery,
              std::shared_ptr<LocalEndpoints> endpoints);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  eprosima::fastdds::dds::Publisher& publisher() { return *publisher_; }
  eprosima::fastdds::dds::Subscriber& subscriber() { return *subscriber_; }

  eprosima::fastrtps::rtps::GUID_t guid() const { return participant_->guid(); }
  /// Up to which size, serialised, messages of that type are shared with processes of this machine; 0: they are not.
  std::uint32_t shared_size(const std::string& wire_type_name) const;
  /// Where its endpoints are entered.
  LocalEndpoints& endpoints() { return *endpoints_; }

  /// The topic of that name, which Fast DDS allows once a participant: every endpoint of it holds the same,
  /// the last one deletes it. Throws ConfigError when it is already open with another type.
  std::shared_ptr<eprosima::fastdds::dds::Topic> topic(const WireTopic& topic);

 private:
  void register_type(const std::string& wire_type_name);
  void delete_topic(const std::string& wire_name);

  const DdsSettings settings_;
  const std::shared_ptr<Discovery> discovery_;  // Fast DDS calls it until the participant is gone
  const std::shared_ptr<LocalEndpoints> endpoints_;
  eprosima::fastdds::dds::DomainParticipant* participant_ = nullptr;
  eprosima::fastdds::dds::Publisher* publisher_ = nullptr;
  eprosima::fastdds::dds::Subscriber* subscriber_ = nullptr;

  struct OpenTopic {
    eprosima::fastdds::dds::Topic* topic = nullptr;
    int users = 0;
  };
  std::mutex mutex_;
  std::map<std::string, OpenTopic> topics_;  // by name on the wire
};

/// How a topic is called on the wire. Throws ConfigError when its type's name is none.
WireTopic wire_topic(const TopicDescription& description);

}  // namespace panvo::runtime::dds
