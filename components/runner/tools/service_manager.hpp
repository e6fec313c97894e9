// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace panvo::runner {

/// Tells systemd about this process, if it was started as a service with Type=notify: that it is ready when this object
/// is created, that it stops when it is destroyed, and in between, with WatchdogSec, that it is alive.
class ServiceManager {
 public:
  /// `is_alive` is asked twice per WatchdogSec, on a thread of its own. If it answers no for that long, systemd ends
  /// the process and, with Restart=on-failure, starts it again.
  explicit ServiceManager(std::function<bool()> is_alive);
  ~ServiceManager();
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable ends_;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace panvo::runner
