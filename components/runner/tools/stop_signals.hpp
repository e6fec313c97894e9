// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <thread>

namespace panvo::runner {

/// Calls `request_stop` on its own thread after SIGINT, SIGTERM, or SIGHUP of a terminal that closes. A second signal, or a stop that takes longer than
/// `kLimit_s`, ends the process immediately, so a shutdown never hangs. Create it before any other thread, as threads
/// inherit the signal mask.
class StopSignals {
 public:
  static constexpr int kLimit_s = 20;

  explicit StopSignals(std::function<void(int signal)> request_stop);
  ~StopSignals();

 private:
  std::thread thread_;
};

}  // namespace panvo::runner
