// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <string>
#include <vector>

#include "latched_history.hpp"
#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/rejected_messages.hpp"
#include "worker.hpp"

namespace panvo::runtime {

/// A topic within this process. Messages are passed by pointer to all local readers, and to the bridge, if any. Each
/// message is validated once against the rules of its type, whatever its origin. Invalid messages are counted, reach
/// only recorders and do not leave the process.
class Channel {
 public:
  /// Receives a message on the publisher's thread; must be fast.
  using Reader = std::function<void(const TopicDescription&, const SamplePtr&)>;

  /// kValid: valid messages only; kAll: every message as sent (recorders).
  enum class Wants { kValid, kAll };

  /// `clock` measures the age of latched messages, ns.
  Channel(TopicDescription topic, Bridge* bridge, std::function<void(const std::string&)> warn,
          std::function<std::int64_t()> clock, Limits limits = {});

  /// The reference holds as long as the channel.
  const TopicDescription& topic() const noexcept { return *topic_; }
  /// Of a topic that was opened as bytes only, by a recorder or a player, before a component came that knows its type.
  void learn_type(const interfaces::MessageType& type);

  /// `qos`: overrides that of the topic. Throws ConfigError if another publisher of this process has another one.
  void add_publisher(const void* owner, const std::string& owner_name,
                     const std::optional<interfaces::Qos>& qos = std::nullopt);
  void remove_publisher(const void* owner);
  bool has_publisher_other_than(const void* owner) const;
  bool is_published_by(const std::string& owner_name) const;
  bool is_read_by(const void* owner) const;

  bool has_readers() const;
  bool has_observers() const;

  /// Passes latched messages and then all further messages to `reader`, until remove_reader() returns. `qos`: overrides
  /// that of the topic. Throws ConfigError if another reader of this process requests another reliability or
  /// durability. A reader of all messages takes what the others request, so it may get latched messages of other
  /// processes again when the first of them comes.
  void add_reader(const void* owner, Reader reader, Wants wants = Wants::kValid,
                  const std::optional<interfaces::Qos>& qos = std::nullopt);
  void remove_reader(const void* owner);

  /// Calls `observer` only for messages published in this process.
  void add_observer(Reader observer);

  void publish(const SamplePtr& published);
  /// Sends the history of a topic that keeps all, once another process reads it. Call periodically.
  void send_history();

  bool wait_for_acknowledgments(std::chrono::milliseconds limit);
  struct Counters {
    std::uint64_t published = 0, not_sent = 0, lost = 0, overwritten = 0, too_large = 0, too_fast = 0;
    std::size_t remote_readers = 0, remote_writers = 0;
  };
  Counters counters() const;
  RejectedMessages::Count rejected() const;
  /// Logs messages rejected since the last call, each reason at most once in 10 s. Deferred for topics of other
  /// processes: deliver() may be called while Fast DDS holds locks, where the sender cannot be looked up.
  void tell_rejected();

 private:
  struct Member {
    const void* owner;
    Reader reader;
    Wants wants;
  };
  enum class Verdict { kValid, kInvalid, kNotChecked };

  SamplePtr typed(const SamplePtr& sample) const;
  bool is_to_be_checked(const Sample& sample) const;
  Verdict check(const SamplePtr& sample);
  bool is_rejected(const SamplePtr& sample);
  void deliver(const SamplePtr& sample, Verdict verdict, bool is_from_here);
  std::string shown_sender(const std::string& sender) const;
  TopicDescription with(const interfaces::Qos& qos) const;
  bool has_readers_of_valid() const;
  interfaces::Qos agreed_on_reading(const std::optional<interfaces::Qos>& qos, Wants wants) const;
  void close_bridge_reader();
  void pass_history_to(const Member& reader);
  bool send_next();

  const TopicDescription opened_;  // as the first user described it
  TopicDescription learnt_;        // the same with its type; set once, before topic_ points here
  std::atomic<const TopicDescription*> topic_ = &opened_;
  Bridge* const bridge_;
  const std::function<void(const std::string&)> warn_;
  const Limits limits_;

  RejectedMessages rejections_;
  std::mutex untold_mutex_;
  std::vector<RejectedMessages::Cause> untold_;

  // Held while publishers and readers, respectively, are added or removed, and locked before mutex_. The bridge's
  // writer and reader are opened and closed under these alone, never under mutex_: Fast DDS then waits for its
  // receiving threads, which hold its locks while they deliver.
  std::mutex bridge_writer_mutex_;
  mutable std::mutex bridge_reader_mutex_;

  mutable std::shared_mutex mutex_;  // shared: delivery; exclusive: changes of publishers and readers
  std::map<const void*, std::string> publishers_;
  std::vector<Member> readers_;
  std::vector<Reader> observers_;
  interfaces::Qos offered_, requested_;  // of publishers and readers of this process
  LatchedHistory history_;

  // Shared: writing; exclusive: a change of the writer. Never held together with mutex_: a written message goes to a
  // reader of the same process under that reader's lock in Fast DDS, under which its receiving thread comes to deliver.
  mutable std::shared_mutex writing_mutex_;
  std::unique_ptr<BridgeWriter> writer_;
  bool sends_history_ = false;  // by send_history(), not as messages are published
  std::mutex sending_mutex_;    // among those that write: guards what the writer has of a history that keeps all
  std::uint64_t sent_ = 0;      // number of its last message
  bool has_sent_all_ = false;   // new messages follow at once

  std::atomic<std::uint64_t> published_ = 0, not_sent_ = 0;

  std::unique_ptr<BridgeReader> bridge_reader_;  // opened with the first reader, closed after the last
};

}  // namespace panvo::runtime
