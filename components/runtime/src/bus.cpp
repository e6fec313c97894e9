// SPDX-License-Identifier: Apache-2.0
#include "bus.hpp"

#include <algorithm>
#include <utility>

#include "panvo/runtime/errors.hpp"

namespace panvo::runtime {

Bus::Bus(std::unique_ptr<Bridge> bridge, std::function<void(const std::string&)> warn,
         std::function<std::int64_t()> clock, Limits limits)
    : warn_(std::move(warn)), clock_(std::move(clock)), limits_(limits), bridge_(std::move(bridge)) {
  if (bridge_) bridge_->on_warning(warn_);
}

Bus::~Bus() {
  {
    const std::lock_guard lock(mutex_);
    channels_.clear();
  }
  bridge_.reset();
}

Channel& Bus::channel(const TopicDescription& topic) {
  const std::lock_guard lock(mutex_);
  if (const auto found = channels_.find(topic.name); found != channels_.end()) {
    const auto& there = found->second->topic();
    if (there.type_name != topic.type_name) {
      throw ConfigError("topic " + topic.name + " has type " + there.type_name + " here, not " + topic.type_name +
                        ": remap one of the two topics in the system file");
    }
    if (topic.type) found->second->learn_type(*topic.type);
    return *found->second;
  }
  auto& channel =
      *channels_.emplace(topic.name, std::make_unique<Channel>(topic, bridge_.get(), warn_, clock_, limits_))
           .first->second;
  for (const auto& observer : observers_) {
    if (observer.wanted(topic)) channel.add_observer(observer.reader);
  }
  for (const auto& tap : taps_) {
    if (tap.wanted(topic)) channel.add_reader(tap.owner, tap.reader, Channel::Wants::kAll);
  }
  return channel;
}

std::vector<Channel*> Bus::channels() const {
  const std::lock_guard lock(mutex_);
  std::vector<Channel*> channels;
  for (const auto& [name, channel] : channels_) channels.push_back(channel.get());
  return channels;
}

void Bus::observe(std::function<bool(const TopicDescription&)> wanted, Channel::Reader observer) {
  const std::lock_guard lock(mutex_);
  for (const auto& [name, channel] : channels_) {
    if (wanted(channel->topic())) channel->add_observer(observer);
  }
  observers_.push_back({nullptr, std::move(wanted), std::move(observer)});
}

void Bus::tap(const void* owner, std::function<bool(const TopicDescription&)> wanted, Channel::Reader reader) {
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [name, channel] : channels_) {
      if (wanted(channel->topic())) channel->add_reader(owner, reader, Channel::Wants::kAll);
    }
    taps_.push_back({owner, std::move(wanted), std::move(reader)});
  }
  if (!bridge_ || watching_) return;
  watching_ = true;
  // The bridge calls back while holding its locks: the topic is only stored here and opened by join_discovered().
  bridge_->watch_topics([this](const TopicDescription& topic) {
    const std::lock_guard discovered_lock(discovered_mutex_);
    discovered_.push_back(topic);
  });
}

void Bus::join_discovered() {
  std::vector<TopicDescription> discovered;
  {
    const std::lock_guard lock(discovered_mutex_);
    discovered.swap(discovered_);
  }
  for (const auto& topic : discovered) {
    try {
      const std::lock_guard lock(mutex_);
      const bool is_wanted = std::any_of(taps_.begin(), taps_.end(), [&](const Tap& tap) { return tap.wanted(topic); });
      if (is_wanted) channel(topic);
    } catch (const ConfigError& error) {
      warn_(error.what());
    }
  }
}

void Bus::tell_rejected() {
  for (Channel* channel : channels()) channel->tell_rejected();
}

void Bus::send_history() {
  for (Channel* channel : channels()) channel->send_history();
}

void Bus::remove_tap(const void* owner) {
  const std::lock_guard lock(mutex_);
  std::erase_if(taps_, [&](const Tap& tap) { return tap.owner == owner; });
  for (const auto& [name, channel] : channels_) channel->remove_reader(owner);
}

bool Bus::wait_for_acknowledgments(std::chrono::milliseconds limit) {
  const auto deadline = std::chrono::steady_clock::now() + limit;
  bool all = true;
  for (Channel* channel : channels()) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    all = channel->wait_for_acknowledgments(std::max(left, std::chrono::milliseconds(0))) && all;
  }
  return all;
}

}  // namespace panvo::runtime
