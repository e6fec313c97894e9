// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/ContentFilteredTopic.hpp>
#include <fastdds/dds/topic/Topic.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "discovery.hpp"
#include "fast_dds.hpp"
#include "local_endpoints.hpp"
#include "names.hpp"
#include "panvo/runtime/bridge.hpp"
#include "participant_qos.hpp"
#include "same_host.hpp"
#include "shared_memory.hpp"

namespace panvo::runtime::dds {

/// A Fast DDS participant and the objects its endpoints share. Owned jointly by the bridge and its endpoints, so it
/// outlives all of them in any order of destruction. Thread-safe.
class Participant : public std::enable_shared_from_this<Participant> {
 public:
  /// Throws ConfigError if it cannot be created.
  Participant(const DdsSettings& settings, Hears hears, std::shared_ptr<Discovery> discovery,
              std::shared_ptr<LocalEndpoints> endpoints);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  fdds::Publisher& publisher() { return *publisher_; }
  fdds::Subscriber& subscriber() { return *subscriber_; }

  rtps::GUID_t guid() const { return participant_->guid(); }
  /// Largest serialised size of messages of that type that are shared on this machine; 0: no sharing.
  std::uint32_t max_shared(const std::string& wire_type_name) const;
  const Limits& limits() const noexcept { return settings_.limits; }
  /// Whether a reader on this machine shares memory with us on the topic.
  bool has_sharing_reader(const std::string& wire_name) const { return discovery_->has_sharing_reader(wire_name); }

  /// Whether a program other than panvo reads the topic.
  bool has_foreign_reader(const std::string& wire_name) const { return discovery_->has_foreign_reader(wire_name); }

  /// Whether an endpoint of another process is of Cyclone DDS.
  bool is_of_cyclone(const rtps::GUID_t& endpoint) const { return discovery_->is_of_cyclone(endpoint.guidPrefix); }

  /// Which client of ROS 2 on Cyclone DDS an endpoint is of; empty if it does not say.
  std::string client_of(const rtps::GUID_t& endpoint) const { return discovery_->client_of(endpoint); }

  /// Whether an endpoint of another process claims to be on this host; never with DDS Security. See same_host.hpp.
  bool is_on_this_host(const rtps::GUID_t& endpoint) const {
    return is_on_same_host(guid(), endpoint) ||
           (tells_host(guid()) && discovery_->is_of_cyclone_here(endpoint.guidPrefix));
  }

  /// Creates an endpoint of a topic; nullptr if Fast DDS refuses it. `max_size`: largest message of an endpoint that
  /// shares memory; 0: no sharing. Readers do not receive what this participant writes, see remote_only_filter.hpp.
  fdds::DataWriter* make_writer(fdds::Topic& topic, const fdds::DataWriterQos& qos, fdds::DataWriterListener& listener,
                                std::uint32_t max_size = 0);
  fdds::DataReader* make_reader(fdds::Topic& topic, const fdds::DataReaderQos& qos, fdds::DataReaderListener& listener,
                                std::uint32_t max_size = 0);
  /// Registry of its endpoints.
  LocalEndpoints& endpoints() { return *endpoints_; }

  /// Returns the topic of that name. Fast DDS allows one per participant; all its endpoints share it, and the last one
  /// deletes it. Throws ConfigError if it is open with another type.
  std::shared_ptr<fdds::Topic> topic(const WireTopic& topic);

 private:
  void register_type(const std::string& wire_type_name);
  void delete_topic(const std::string& wire_name);
  fdds::ContentFilteredTopic* remote_only(fdds::Topic& topic);
  /// Sets the size bound of a type while an endpoint is created.
  void bound(const fdds::Topic& topic, std::uint32_t max_size);

  const DdsSettings settings_;
  const std::shared_ptr<Discovery> discovery_;  // used by Fast DDS until the participant is destroyed
  const std::shared_ptr<LocalEndpoints> endpoints_;
  fdds::DomainParticipant* participant_ = nullptr;
  fdds::Publisher* publisher_ = nullptr;
  fdds::Subscriber* subscriber_ = nullptr;

  struct OpenTopic {
    fdds::Topic* topic = nullptr;
    fdds::ContentFilteredTopic* remote_only = nullptr;  // for readers
    int users = 0;
  };
  std::mutex mutex_;
  std::map<std::string, OpenTopic> topics_;  // by wire name
  std::mutex making_mutex_;                  // guards the size bound of a type while an endpoint is created
  std::optional<SharingMark> mark_;          // if an endpoint shares memory
};

/// Wire names of a topic. Throws ConfigError on an invalid type name.
WireTopic wire_topic(const TopicDescription& description);

}  // namespace panvo::runtime::dds
