// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace panvo::runtime::dds {

/// Runs user callbacks on its own thread. Discovery and QoS events arrive while Fast DDS holds its locks; a callback
/// that opened or wrote a topic there (as warnings on /rosout do) could deadlock. Thread-safe.
class Notifier {
 public:
  Notifier();
  ~Notifier();
  Notifier(const Notifier&) = delete;
  Notifier& operator=(const Notifier&) = delete;

  /// Runs `call` on the thread, in order of posting. An exception becomes a warning.
  void post(std::function<void()> call);
  /// The same once `delay` has passed.
  void post_after(std::chrono::milliseconds delay, std::function<void()> call);

  /// Reports each text once. Warnings before on_warning() are kept for the first callback.
  void warn(const std::string& text);
  void on_warning(std::function<void(const std::string&)> callback);

  /// No callback is running or will run once this has returned.
  void stop();

 private:
  using Clock = std::chrono::steady_clock;

  void run();
  void wait_for_call(std::unique_lock<std::mutex>& lock);
  void post_locked(std::function<void()> call);

  std::mutex mutex_;
  std::condition_variable wake_up_;
  std::deque<std::function<void()>> calls_;
  std::multimap<Clock::time_point, std::function<void()>> later_;
  bool stopping_ = false;

  std::set<std::string> warned_;
  std::vector<std::string> unheard_;
  std::function<void(const std::string&)> warning_callback_;

  std::thread thread_;  // last: it uses the members above
};

}  // namespace panvo::runtime::dds
