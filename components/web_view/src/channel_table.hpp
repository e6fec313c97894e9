// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "panvo/runtime/bridge.hpp"
#include "server_message.hpp"

namespace panvo::web_view {

/// The topics that are offered to clients, each with the id of its channel. A topic that comes again, or with another
/// type, gets a new id. Not thread-safe.
class ChannelTable {
 public:
  struct Change {
    std::vector<Channel> added;
    std::vector<std::uint32_t> removed;
  };

  /// Takes over the topics that there are now. Topics beyond `kMaxChannels` are left out and counted.
  Change update(const std::vector<runtime::TopicDescription>& topics);

  std::vector<Channel> channels() const;
  /// Returns nullptr for an unknown or removed channel. Valid until the next update.
  const runtime::TopicDescription* find(std::uint32_t channel) const;
  std::size_t left_out() const { return left_out_; }

  static constexpr std::size_t kMaxChannels = 5000;

 private:
  struct Key {
    std::string name, type_name;
    auto operator<=>(const Key&) const = default;
  };
  static Channel channel_of(std::uint32_t id, const runtime::TopicDescription& topic);

  std::map<Key, std::uint32_t> ids_;
  std::map<std::uint32_t, runtime::TopicDescription> topics_;  // by id
  std::uint32_t next_id_ = 1;
  std::size_t left_out_ = 0;
};

}  // namespace panvo::web_view
