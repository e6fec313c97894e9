// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <shared_mutex>
#include <string>
#include <utility>
#include <vector>

#include "panvo/runtime/service.hpp"

namespace panvo::runtime {

/// Answers a call, once. If it is destroyed unanswered, the answer is nullopt, so every call ends.
class Reply {
 public:
  explicit Reply(Answer answer) : answer_(std::move(answer)) {}
  ~Reply() {
    if (answer_) answer_(std::nullopt);
  }
  Reply(const Reply&) = delete;
  Reply& operator=(const Reply&) = delete;

  void send(interfaces::Bytes bytes) { std::exchange(answer_, nullptr)(std::move(bytes)); }

 private:
  Answer answer_;
};

/// Services of the components of this process, by resolved name. Thread-safe.
class ServiceDirectory {
 public:
  /// Queues a request for its handler. Never blocks.
  using Serve = std::function<void(interfaces::Bytes request, std::shared_ptr<Reply> reply)>;

  /// False, without effect, if another one has that name. `owner` is the key for remove_of().
  bool add(const ServiceDescription& service, const void* owner, Serve serve);
  /// No service of the owner is called once this has returned.
  void remove_of(const void* owner);

  /// False if no component of this process offers a service of that name and type; `reply` is then unused.
  bool call(const ServiceDescription& service, interfaces::Bytes& request, const std::shared_ptr<Reply>& reply) const;

  /// In order of name.
  std::vector<ServiceDescription> services() const;

 private:
  struct Entry {
    std::string type_name;
    const void* owner;
    Serve serve;
  };
  mutable std::shared_mutex mutex_;
  std::map<std::string, Entry> entries_;
};

/// Waits for the answer to a request; `ask` makes it. nullopt: none within `limit`.
std::optional<interfaces::Bytes> answer_to(const std::function<void(std::shared_ptr<Reply>)>& ask,
                                           std::chrono::milliseconds limit);

/// Converts to a handler for the bridge, which waits up to 5 s for the component's answer.
ServiceHandler handler_of(ServiceDirectory::Serve serve);

}  // namespace panvo::runtime
