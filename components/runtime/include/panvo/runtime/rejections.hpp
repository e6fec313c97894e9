// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

namespace panvo::runtime {

/// The messages that a component was given and could not use, topic by topic: diagnostics tell of them. Safe to use from several threads.
class Rejections {
 public:
  struct Count {
    std::uint64_t messages = 0;
    std::string last_reason;
  };

  /// Returns whether the reason is another than the last one of this topic: worth a line in the log. A topic that was accepted meanwhile counts as
  /// one without a last reason.
  bool add(std::string_view topic, std::string_view reason);
  void accepted(std::string_view topic);

  /// In order of the topics' names; those that had a message rejected.
  std::map<std::string, Count, std::less<>> snapshot() const;

 private:
  struct Topic {
    Count count;
    bool is_rejected = false;  // the newest message was
  };
  mutable std::mutex mutex_;
  std::map<std::string, Topic, std::less<>> topics_;
};

}  // namespace panvo::runtime
