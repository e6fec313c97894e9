// SPDX-License-Identifier: Apache-2.0
#include "participant.hpp"

#include <spdlog/fmt/fmt.h>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include <mutex>

#include "fast_dds.hpp"
#include "image_sharing.hpp"
#include "names.hpp"
#include "own_participants.hpp"
#include "panvo/runtime/errors.hpp"
#include "remote_only_filter.hpp"
#include "sample_data_type.hpp"
#include "udp_transport.hpp"

namespace panvo::runtime::dds {

Participant::Participant(const DdsSettings& settings, Hears hears, std::shared_ptr<Discovery> discovery,
                         std::shared_ptr<LocalEndpoints> endpoints)
    : settings_(settings), discovery_(std::move(discovery)), endpoints_(std::move(endpoints)) {
  std::unique_lock lock(factory_mutex());
  const auto qos = participant_qos(settings, hears);
  // The mask is empty, as endpoints have their own listeners. Discovery is called anyway.
  participant_ = fdds::DomainParticipantFactory::get_instance()->create_participant(
      static_cast<fdds::DomainId_t>(settings.domain), qos, discovery_.get(), fdds::StatusMask::none());
  lock.unlock();
  if (!participant_) {
    throw ConfigError(fmt::format(
        "cannot create a DDS participant in domain {}: check that there is a network interface (lo suffices) and that "
        "the profile file suits this machine",
        settings.domain));
  }
  add_own_participant(participant_->guid());
  start_reception(qos);
  participant_->register_content_filter_factory(kRemoteOnlyClass, &remote_only_filters());
  publisher_ = participant_->create_publisher(fdds::PUBLISHER_QOS_DEFAULT);
  subscriber_ = participant_->create_subscriber(fdds::SUBSCRIBER_QOS_DEFAULT);
}

Participant::~Participant() {
  participant_->delete_publisher(publisher_);
  participant_->delete_subscriber(subscriber_);
  fdds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

void Participant::register_type(const std::string& wire_type_name) {
  // A registered type is kept: it is small, and its code belongs to this library.
  if (!participant_->find_type(wire_type_name).empty()) return;
  fdds::TypeSupport(new SampleDataType(wire_type_name, limits().max_message_bytes)).register_type(participant_);
}

std::uint32_t Participant::max_shared(const std::string& wire_type_name) const {
  return dds::max_shared(settings_, wire_type_name);
}

void Participant::bound(const fdds::Topic& topic, std::uint32_t max_size) {
  if (max_size > 0 && !mark_) mark_.emplace(guid().guidPrefix);
  static_cast<SampleDataType&>(*participant_->find_type(topic.get_type_name()).get()).bound(max_size);
}

fdds::DataWriter* Participant::make_writer(fdds::Topic& topic, const fdds::DataWriterQos& qos,
                                           fdds::DataWriterListener& listener, std::uint32_t max_size) {
  const std::lock_guard lock(making_mutex_);
  bound(topic, max_size);
  return publisher_->create_datawriter(&topic, qos, &listener);
}

fdds::DataReader* Participant::make_reader(fdds::Topic& topic, const fdds::DataReaderQos& qos,
                                           fdds::DataReaderListener& listener, std::uint32_t max_size) {
  const std::lock_guard lock(making_mutex_);
  bound(topic, max_size);
  // A discovery server with a backup loses clients whose readers have filters when it is replaced. With a server, own
  // writers are in another participant, see DdsBridge.
  fdds::TopicDescription* described = &topic;
  if (!has_discovery_server()) described = remote_only(topic);
  return subscriber_->create_datareader(described, qos, &listener);
}

WireTopic wire_topic(const TopicDescription& description) {
  auto type_name =
      description.type ? std::optional<std::string>(description.type->dds_name) : wire_type_name(description.type_name);
  if (!type_name) {
    throw ConfigError(fmt::format("topic {}: '{}' is not a type name; write it as package/msg/Type", description.name,
                                  description.type_name));
  }
  return {wire_topic_name(description.name), std::move(*type_name), description.name};
}

std::shared_ptr<fdds::Topic> Participant::topic(const WireTopic& topic) {
  const std::lock_guard lock(mutex_);
  OpenTopic& open = topics_[topic.name];
  const auto readable = [](const std::string& wire_type) { return type_name_from_wire(wire_type).value_or(wire_type); };
  if (open.topic && open.topic->get_type_name() != topic.type_name) {
    throw ConfigError(fmt::format("topic {}: is already open here with type {}, not {}; remap one of them", topic.shown,
                                  readable(open.topic->get_type_name()), readable(topic.type_name)));
  }
  if (!open.topic) {
    register_type(topic.type_name);
    open.topic = participant_->create_topic(topic.name, topic.type_name, fdds::TOPIC_QOS_DEFAULT);
    if (!open.topic) {
      topics_.erase(topic.name);
      throw ConfigError(
          fmt::format("topic {}: Fast DDS refused it with type {}", topic.shown, readable(topic.type_name)));
    }
    discovery_->topic_opened(topic.name, topic.type_name);
  }
  ++open.users;
  return {open.topic, [self = shared_from_this(), name = topic.name](fdds::Topic*) { self->delete_topic(name); }};
}

fdds::ContentFilteredTopic* Participant::remote_only(fdds::Topic& topic) {
  const std::lock_guard lock(mutex_);
  auto*& filtered = topics_.at(topic.get_name()).remote_only;
  if (!filtered) {
    filtered = participant_->create_contentfilteredtopic(topic.get_name() + "/remote_only", &topic,
                                                         kRemoteOnlyExpression, {}, kRemoteOnlyClass);
  }
  return filtered;
}

void Participant::delete_topic(const std::string& wire_name) {
  const std::lock_guard lock(mutex_);
  const auto open = topics_.find(wire_name);
  if (--open->second.users > 0) return;
  discovery_->topic_closed(wire_name, open->second.topic->get_type_name());
  if (open->second.remote_only) participant_->delete_contentfilteredtopic(open->second.remote_only);
  participant_->delete_topic(open->second.topic);
  topics_.erase(open);
}

}  // namespace panvo::runtime::dds
