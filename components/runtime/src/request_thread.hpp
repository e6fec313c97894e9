// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>

#include "panvo/runtime/service.hpp"
#include "service_directory.hpp"

namespace panvo::runtime {

/// Answers requests of this process to services that do not belong to a component's message thread: those of the nodes.
/// One request at a time, on its own thread, which the first request starts.
class RequestThread {
 public:
  RequestThread() = default;
  ~RequestThread();
  RequestThread(const RequestThread&) = delete;
  RequestThread& operator=(const RequestThread&) = delete;

  /// `owner` is the key for remove_of().
  ServiceDirectory::Serve serve(const void* owner, ServiceHandler handler);

  /// Drops the owner's waiting requests, and waits for the one that is being answered. A handler must not remove its own
  /// owner, but may remove others.
  void remove_of(const void* owner);

 private:
  struct Request {
    const void* owner;
    std::shared_ptr<const ServiceHandler> handler;
    interfaces::Bytes bytes;
    std::shared_ptr<Reply> reply;
  };

  void put(Request request);
  void loop();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Request> waiting_;
  const void* answering_ = nullptr;  // the owner
  bool is_ending_ = false;
  std::thread thread_;
};

}  // namespace panvo::runtime
