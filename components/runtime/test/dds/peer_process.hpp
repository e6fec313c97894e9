// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>

namespace panvo::runtime::test {

/// Waits until `condition` holds; false at the limit.
[[nodiscard]] bool eventually(const std::function<bool()>& condition);

/// Another process: one with a bridge (bridge_peer.cpp), optionally sharing images, or another program. Ends with this
/// object.
class PeerProcess {
 public:
  explicit PeerProcess(int domain, std::string program = PANVO_BRIDGE_PEER, std::uint32_t shared_image_bytes = 0);
  ~PeerProcess();
  PeerProcess(const PeerProcess&) = delete;
  PeerProcess& operator=(const PeerProcess&) = delete;

  /// Sends a command and returns its answer without the leading `ok `. Throws std::runtime_error on an error or a
  /// missing answer.
  std::string ask(const std::string& command);

  /// The rest of the next line that starts with `received TOPIC `: "SIZE HASH".
  std::string next_received(const std::string& topic);

  bool matches(const std::string& topic, int count);

  /// Its current memory use.
  std::size_t resident_kb() const;

  pid_t id() const { return pid_; }
  void signal(int number) const;
  /// Kills the process; it has ended and its ports are free once this has returned.
  void kill_and_wait() const;
  /// Waits until a stop signal has taken effect.
  void wait_until_stopped() const;

 private:
  std::string read_line();

  pid_t pid_ = -1;
  int commands_ = -1, answers_ = -1;
  std::string buffer_;
  std::deque<std::string> received_;
};

}  // namespace panvo::runtime::test
