// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace panvo::bench {

/// Role of a process in a measurement: `write` and `read` for two processes, `both` for one.
struct PeerTask {
  std::string role, stack, message;
  int domain = 0;

  std::vector<std::string> words() const { return {"--peer", role, stack, message, std::to_string(domain)}; }
};

/// Results of a measurement, parsed from the output of the peers.
struct Measured {
  std::vector<double> latencies_us;
  double cpu_us = 0;
  int sent = 0;

  void add(const std::string& output);
};

/// Runs the task and prints the measurements. A writer ends after all messages have been written and had time to
/// arrive, a reader at SIGTERM.
int run_peer(const std::vector<std::string>& words);

}  // namespace panvo::bench
