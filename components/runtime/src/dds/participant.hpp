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
#include "sample_data_type.hpp"

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
  std::uint32_t largest_shared(const std::string& wire_type_name) const;
  const Limits& limits() const noexcept { return settings_.limits; }
  /// Whether a process of this machine reads the topic that shares memory as we do.
  bool has_sharing_reader(const std::string& wire_name) const { return discovery_->has_sharing_reader(wire_name); }

  /// Endpoints of a topic of this participant; nullptr: Fast DDS will not have them. `max_size`: of the messages of one that shares memory; 0: of
  /// one that does not.
  eprosima::fastdds::dds::DataWriter* make_writer(eprosima::fastdds::dds::Topic& topic,
                                                  const eprosima::fastdds::dds::DataWriterQos& qos,
                                                  eprosima::fastdds::dds::DataWriterListener& listener,
                                                  std::uint32_t max_size);
  eprosima::fastdds::dds::DataReader* make_reader(eprosima::fastdds::dds::Topic& topic,
                                                  const eprosima::fastdds::dds::DataReaderQos& qos,
                                                  eprosima::fastdds::dds::DataReaderListener& listener,
                                                  std::uint32_t max_size);
  /// Where its endpoints are entered.
  LocalEndpoints& endpoints() { return *endpoints_; }

  /// The topic of that name, which Fast DDS allows once a participant: every endpoint of it holds the same,
  /// the last one deletes it. Throws ConfigError when it is already open with another type.
  std::shared_ptr<eprosima::fastdds::dds::Topic> topic(const WireTopic& topic);

 private:
  void register_type(const std::string& wire_type_name);
  void delete_topic(const std::string& wire_name);
  SampleDataType& type_of(const eprosima::fastdds::dds::Topic& topic) const;

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
  std::mutex making_mutex_;                  // an endpoint is made as its type is bounded then
};

/// How a topic is called on the wire. Throws ConfigError when its type's name is none.
WireTopic wire_topic(const TopicDescription& description);

}  // namespace panvo::runtime::dds
