// SPDX-License-Identifier: Apache-2.0
#include "channel_table.hpp"

#include <set>

namespace panvo::web_view {

ChannelTable::Change ChannelTable::update(const std::vector<runtime::TopicDescription>& topics) {
  Change change;
  std::set<Key> present;
  for (const auto& topic : topics) present.insert({topic.name, topic.type_name});
  std::erase_if(ids_, [&](const auto& entry) {
    if (present.contains(entry.first)) return false;
    change.removed.push_back(entry.second);
    topics_.erase(entry.second);
    return true;
  });
  left_out_ = 0;
  for (const auto& topic : topics) {
    if (ids_.contains({topic.name, topic.type_name})) continue;
    if (ids_.size() >= kMaxChannels) {
      ++left_out_;
      continue;
    }
    const std::uint32_t id = next_id_++;
    ids_.emplace(Key{topic.name, topic.type_name}, id);
    topics_.emplace(id, topic);
    change.added.push_back(channel_of(id, topic));
  }
  return change;
}

std::vector<Channel> ChannelTable::channels() const {
  std::vector<Channel> channels;
  for (const auto& [id, topic] : topics_) channels.push_back(channel_of(id, topic));
  return channels;
}

const runtime::TopicDescription* ChannelTable::find(std::uint32_t channel) const {
  const auto found = topics_.find(channel);
  return found == topics_.end() ? nullptr : &found->second;
}

Channel ChannelTable::channel_of(std::uint32_t id, const runtime::TopicDescription& topic) {
  return {id, topic.name, topic.type_name, topic.type ? std::string(topic.type->definition) : std::string()};
}

}  // namespace panvo::web_view
