// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "channel.hpp"

namespace panvo::runtime {

/// The topics of a process.
class Bus {
 public:
  Bus(std::unique_ptr<Bridge> bridge, std::function<void(const std::string&)> warn, std::function<std::int64_t()> clock,
      Limits limits = {});
  ~Bus();

  /// Returns the channel of a topic. Throws ConfigError if the topic exists with another type.
  Channel& channel(const TopicDescription& topic);
  std::vector<Channel*> channels() const;  // in order of name

  /// Adds `reader` to all present and future channels that `wanted` accepts, including topics of other processes.
  void tap(const void* owner, std::function<bool(const TopicDescription&)> wanted, Channel::Reader reader);
  void remove_tap(const void* owner);
  /// Opens newly discovered topics of other processes that a tap wants. Call periodically.
  void join_discovered();

  /// Adds `observer` to all present and future channels that `wanted` accepts, for messages published in this process.
  void observe(std::function<bool(const TopicDescription&)> wanted, Channel::Reader observer);

  bool wait_for_acknowledgments(std::chrono::milliseconds limit);

  /// Logs rejected messages of other processes. Call periodically.
  void tell_rejected();
  /// See Channel::send_history.
  void send_history();

  /// nullptr without a bridge.
  Bridge* bridge() const noexcept { return bridge_.get(); }

 private:
  struct Tap {
    const void* owner;
    std::function<bool(const TopicDescription&)> wanted;
    Channel::Reader reader;
  };

  std::function<void(const std::string&)> warn_;
  std::function<std::int64_t()> clock_;
  const Limits limits_;
  std::unique_ptr<Bridge> bridge_;  // outlives the channels, which own its endpoints
  mutable std::recursive_mutex mutex_;
  std::map<std::string, std::unique_ptr<Channel>> channels_;
  std::vector<Tap> taps_, observers_;
  bool watching_ = false;
  std::mutex discovered_mutex_;
  std::vector<TopicDescription> discovered_;
};

}  // namespace panvo::runtime
