// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace panvo::web_view {

/// Who is behind each connection that a relay of this process makes, by the port from which it makes it. Thread-safe.
class RelayedPeers {
 public:
  void add(int port, std::string address) {
    const std::lock_guard lock(mutex_);
    addresses_.insert_or_assign(port, std::move(address));
  }
  void remove(int port) {
    const std::lock_guard lock(mutex_);
    addresses_.erase(port);
  }
  /// "192.168.1.7:43210"; nullopt: the connection is not of the relay.
  std::optional<std::string> find(int port) const {
    const std::lock_guard lock(mutex_);
    const auto found = addresses_.find(port);
    return found == addresses_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  mutable std::mutex mutex_;
  std::map<int, std::string> addresses_;
};

}  // namespace panvo::web_view
