// SPDX-License-Identifier: Apache-2.0
#include "service_manager.hpp"

#include <systemd/sd-daemon.h>

#include <chrono>
#include <cstdint>
#include <utility>

namespace panvo::runner {

ServiceManager::ServiceManager(std::function<bool()> is_alive) {
  sd_notify(0, "READY=1");
  std::uint64_t limit_us = 0;
  if (sd_watchdog_enabled(0, &limit_us) <= 0) return;
  thread_ = std::thread([this, interval = std::chrono::microseconds(limit_us / 2), is_alive = std::move(is_alive)] {
    std::unique_lock lock(mutex_);
    while (!ends_.wait_for(lock, interval, [this] { return ended_; })) {
      if (is_alive()) sd_notify(0, "WATCHDOG=1");
    }
  });
}

ServiceManager::~ServiceManager() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  ends_.notify_one();
  if (thread_.joinable()) thread_.join();
  sd_notify(0, "STOPPING=1");
}

}  // namespace panvo::runner
