// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/rtps/common/Guid.h>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>

#include <compare>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "notifier.hpp"
#include "panvo/runtime/bridge.hpp"

namespace panvo::runtime::dds {

/// Which topics other processes have: tells watchers of each that is written, and warns where the types of a
/// topic differ, which DDS itself passes over in silence. Listens to both participants of a bridge. Safe to
/// use from several threads.
class Discovery final : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  using Watcher = std::function<void(const TopicDescription&)>;

  explicit Discovery(std::shared_ptr<Notifier> notifier) : notifier_(std::move(notifier)) {}

  void watch(const Watcher& watcher);

  /// Which topics this process has open, so that others with another type are noticed. Names as on the wire.
  void topic_opened(const std::string& wire_name, const std::string& wire_type_name);
  void topic_closed(const std::string& wire_name, const std::string& wire_type_name);

  void on_publisher_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                              eprosima::fastrtps::rtps::WriterDiscoveryInfo&& info) override;
  void on_subscriber_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                               eprosima::fastrtps::rtps::ReaderDiscoveryInfo&& info) override;

 private:
  struct TypedTopic {
    std::string name, type_name;  // as on the wire
    auto operator<=>(const TypedTopic&) const = default;
  };

  void remember(const eprosima::fastrtps::rtps::GUID_t& guid, TypedTopic remote);
  void warn_if_types_differ(const TypedTopic& local, const TypedTopic& remote);
  void announce(const TopicDescription& written);

  const std::shared_ptr<Notifier> notifier_;
  std::mutex mutex_;
  std::map<TypedTopic, int> open_here_;  // how many participants have it
  std::map<eprosima::fastrtps::rtps::GUID_t, TypedTopic> remote_endpoints_;
  std::map<std::string, TopicDescription> written_;  // by other processes, now or before
  std::vector<Watcher> watchers_;
};

}  // namespace panvo::runtime::dds
