// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <thread>

namespace panvo::runtime {

/// Turns SIGINT and SIGTERM into a call on a thread of its own. A second signal, or a stop that takes longer than `kLimit_s`, ends the process at once: a
/// shutdown never hangs. To be made before any other thread, for they inherit which signals are blocked.
class StopSignals {
 public:
  static constexpr int kLimit_s = 20;

  explicit StopSignals(std::function<void(int signal)> request_stop);
  ~StopSignals();

 private:
  std::thread thread_;
};

}  // namespace panvo::runtime
