// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <vector>

#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/rejections.hpp"
#include "worker.hpp"

namespace panvo::runtime {

/// One topic inside this process. Messages pass by pointer to every reader here; the bridge, where there is one, gets each message too and
/// decides whether anybody outside wants it. What is wrong with a message by the rules of its type is found here, once, wherever it comes from: such
/// a one is counted, reaches no reader but recorders, and does not leave the process.
class Channel {
 public:
  /// Takes a message in; called on the publisher's thread, must be quick.
  using Reader = std::function<void(const TopicDescription&, const SamplePtr&)>;

  /// Who must be able to rely on what it gets, and who wants all that is sent, as it is.
  enum class Wants { kValid, kAll };

  /// `clock`: by which a latched message grows old, ns.
  Channel(TopicDescription topic, Bridge* bridge, std::function<void(const std::string&)> warn,
          std::function<std::int64_t()> clock, Limits limits = {});

  const TopicDescription& topic() const noexcept { return topic_; }

  void add_publisher(const void* owner, const std::string& owner_name);
  void remove_publisher(const void* owner);
  bool has_publisher_other_than(const void* owner) const;
  bool is_published_by(const std::string& owner_name) const;
  bool is_read_by(const void* owner) const;

  bool has_readers() const;

  /// Hands what late joiners must get to `reader`, then every message from now on. When remove_reader has returned, `reader` is not called any more.
  void add_reader(const void* owner, Reader reader, Wants wants = Wants::kValid);
  void remove_reader(const void* owner);

  /// Shows `observer` what is published in this process, and only that.
  void add_observer(Reader observer);

  void publish(const SamplePtr& sample);

  bool wait_for_acknowledgments(std::chrono::milliseconds limit);
  struct Counters {
    std::uint64_t published = 0, not_sent = 0, lost = 0, overwritten = 0, too_large = 0, too_fast = 0;
    std::size_t remote_readers = 0, remote_writers = 0;
  };
  Counters counters() const;
  Rejections::Count rejected() const;
  /// Warns of what was rejected since, each reason at most once in 10 s. For a topic that other processes write: those who call deliver() with
  /// locks of Fast DDS's held cannot ask who sent a message.
  void tell_rejected();

 private:
  struct Member {
    const void* owner;
    Reader reader;
    Wants wants;
  };
  struct Latched {
    SamplePtr sample;
    bool is_from_here;  // from this process: it does not outlive who published it
    std::int64_t since_ns;
  };

  bool is_to_be_checked(const Sample& sample) const;
  bool is_rejected(const SamplePtr& sample);
  void deliver(const SamplePtr& sample, bool is_valid, bool is_from_here);
  std::string shown_sender(const std::string& sender) const;
  void remember(const SamplePtr& sample, bool is_from_here);
  bool is_old(const Latched& latched) const;

  const TopicDescription topic_;
  Bridge* const bridge_;
  const std::function<void(const std::string&)> warn_;
  const std::function<std::int64_t()> clock_;
  const Limits limits_;

  Rejections rejections_;
  std::mutex untold_mutex_;
  std::vector<Rejections::Cause> untold_;

  mutable std::shared_mutex mutex_;  // shared: to hand over; exclusive: to change who is there
  std::map<const void*, std::string> publishers_;
  std::vector<Member> readers_;
  std::vector<Reader> observers_;
  std::unique_ptr<BridgeWriter> writer_;
  std::mutex history_mutex_;
  std::deque<Latched> history_;  // of a transient-local topic
  std::atomic<std::uint64_t> published_ = 0, not_sent_ = 0;

  // Opened and closed by readers coming and going, never under mutex_: closing waits for a callback that may be delivering.
  mutable std::mutex bridge_reader_mutex_;
  std::unique_ptr<BridgeReader> bridge_reader_;
};

/// The topics of a process.
class Bus {
 public:
  Bus(std::unique_ptr<Bridge> bridge, std::function<void(const std::string&)> warn, std::function<std::int64_t()> clock,
      Limits limits = {});
  ~Bus();

  /// The channel of that topic. Throws ConfigError when the topic is already there with another type.
  Channel& channel(const TopicDescription& topic);
  std::vector<Channel*> channels() const;  // in order of name

  /// Adds `reader` to every channel that `wanted` accepts, those to come included, and the topics of other processes.
  void tap(const void* owner, std::function<bool(const TopicDescription&)> wanted, Channel::Reader reader);
  void remove_tap(const void* owner);
  /// Opens the topics of other processes that were discovered since and that a tap wants. To be called now and then.
  void join_discovered();

  /// Adds `observer` to every channel that `wanted` accepts, those to come included, for what is published in this process.
  void observe(std::function<bool(const TopicDescription&)> wanted, Channel::Reader observer);

  bool wait_for_acknowledgments(std::chrono::milliseconds limit);

  /// Warns of rejected messages of other processes. To be called now and then.
  void tell_rejected();

  /// nullptr: none.
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
  std::unique_ptr<Bridge> bridge_;  // outlives the channels, whose endpoints it made
  mutable std::recursive_mutex mutex_;
  std::map<std::string, std::unique_ptr<Channel>> channels_;
  std::vector<Tap> taps_, observers_;
  bool watching_ = false;
  std::mutex discovered_mutex_;
  std::vector<TopicDescription> discovered_;
};

}  // namespace panvo::runtime
