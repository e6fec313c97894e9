// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace panvo::runtime::dds {

/// Calls users back on a thread of its own. Discovery and QoS events come from inside Fast DDS, which holds
/// its locks then; a user who opens or writes a topic from there (a warning that goes to rosout does) could
/// wait for himself. Here he holds nothing. Safe to use from several threads.
class Notifier {
 public:
  Notifier();
  ~Notifier();
  Notifier(const Notifier&) = delete;
  Notifier& operator=(const Notifier&) = delete;

  /// Runs `call` on the thread, in order of posting. An exception it throws becomes a warning.
  void post(std::function<void()> call);

  /// Tells users; the same text once only. What is said before anybody listens is kept for who comes.
  void warn(const std::string& text);
  void on_warning(std::function<void(const std::string&)> callback);

  /// When this returns nobody is being called back, and nobody will be.
  void stop();

 private:
  void run();
  void post_locked(std::function<void()> call);

  std::mutex mutex_;
  std::condition_variable wake_up_;
  std::deque<std::function<void()>> calls_;
  bool stopping_ = false;

  std::set<std::string> warned_;
  std::vector<std::string> unheard_;
  std::function<void(const std::string&)> warning_callback_;

  std::thread thread_;  // last: it uses all of the above
};

}  // namespace panvo::runtime::dds
