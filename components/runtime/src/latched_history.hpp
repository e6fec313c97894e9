// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "history_file.hpp"
#include "panvo/runtime/bridge.hpp"

namespace panvo::runtime {

/// The messages of a transient-local topic for readers that come later. A topic that keeps its last messages has them
/// in memory. One that keeps all has them in a file: they may be many, and each reader takes its time. Thread-safe.
class LatchedHistory {
 public:
  struct Entry {
    SamplePtr sample;  ///< not read, if it is stored: see Sample::unread
    std::int64_t since_ns = 0;
    std::uint64_t number = 0;  ///< 1, 2, ... in order of arrival
    bool is_from_here = false;
    bool is_checked = false;  ///< found valid; else it is still to be checked
  };

  /// `clock`: ns, for the age of messages. `folder`: of the file. `warn` is called once if it cannot be used; messages
  /// then stay in memory.
  LatchedHistory(const TopicDescription& topic, std::function<std::int64_t()> clock, std::filesystem::path folder,
                 std::function<void(const std::string&)> warn);

  bool keeps_all() const noexcept { return keeps_all_; }

  /// Returns the message to pass on: `sample`, or the stored one.
  SamplePtr add(const SamplePtr& sample, bool is_from_here, bool is_checked);

  /// Those that are not older than the topic's lifespan.
  std::vector<Entry> current() const;
  /// The first `count` with a higher number.
  std::vector<Entry> after(std::uint64_t number, std::size_t count) const;

  void forget_those_from_here();
  void forget_those_of_others();

 private:
  SamplePtr store(const SamplePtr& sample);
  bool is_old(const Entry& entry) const;

  const std::string topic_;
  const bool keeps_all_;
  const std::size_t depth_;
  const std::int64_t lifespan_ns_;
  const std::function<std::int64_t()> clock_;
  const std::filesystem::path folder_;
  const std::function<void(const std::string&)> warn_;

  mutable std::mutex mutex_;
  std::shared_ptr<HistoryFile> file_;  // shared with the messages in it
  bool is_file_usable_ = true;
  std::deque<Entry> entries_;
  std::uint64_t last_number_ = 0;
};

}  // namespace panvo::runtime
