// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>

namespace panvo::aravis_camera {

/// Closes objects on its own thread, because closing an unresponsive camera takes ten seconds or more. The queue stays
/// short: a camera is reopened only after it was passed to close().
template <class Thing>
class Closer {
 public:
  Closer() : shared_(std::make_shared<Shared>()), thread_([shared = shared_] { shared->close_all(); }) {}

  /// Waits at most `kPatience` for pending objects, then detaches the thread. This is safe: the library is never
  /// unloaded, and the objects do not refer to the rest of the program.
  ~Closer() {
    std::unique_lock lock(shared_->mutex);
    shared_->is_ending = true;
    shared_->changed.notify_all();
    const bool is_closed = shared_->changed.wait_for(lock, kPatience, [this] { return shared_->has_ended; });
    lock.unlock();
    is_closed ? thread_.join() : thread_.detach();
  }
  Closer(const Closer&) = delete;
  Closer& operator=(const Closer&) = delete;

  void close(std::unique_ptr<Thing> thing) {
    const std::lock_guard lock(shared_->mutex);
    shared_->waiting.push_back(std::move(thing));
    shared_->changed.notify_all();
  }

 private:
  static constexpr std::chrono::seconds kPatience{2};

  struct Shared {
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<std::unique_ptr<Thing>> waiting;
    bool is_ending = false, has_ended = false;

    void close_all() {
      std::unique_lock lock(mutex);
      while (true) {
        changed.wait(lock, [this] { return is_ending || !waiting.empty(); });
        if (waiting.empty()) break;
        auto thing = std::move(waiting.front());
        waiting.pop_front();
        lock.unlock();
        thing.reset();
        lock.lock();
      }
      has_ended = true;
      changed.notify_all();
    }
  };

  std::shared_ptr<Shared> shared_;
  std::thread thread_;
};

}  // namespace panvo::aravis_camera
