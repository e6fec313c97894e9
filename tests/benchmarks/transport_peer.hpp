// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace panvo::bench {

/// What one process does in a measurement; `write` and `read` are two processes', `both` is one's.
struct PeerTask {
  std::string role, stack, message;
  int domain = 0;

  std::vector<std::string> words() const { return {"--peer", role, stack, message, std::to_string(domain)}; }
};

/// What the peers of a measurement say, read from their output.
struct Measured {
  std::vector<double> latencies_us;
  double cpu_us = 0;
  int sent = 0;

  void add(const std::string& output);
};

/// Does the task: a writer ends when all is written and has had time to arrive, a reader at SIGTERM. Says what it has measured.
int run_peer(const std::vector<std::string>& words);

}  // namespace panvo::bench
