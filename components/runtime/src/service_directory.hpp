// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <shared_mutex>
#include <string>
#include <utility>

#include "panvo/runtime/service.hpp"

namespace panvo::runtime {

/// What a call is answered by, once. A request that is discarded unanswered is answered by nullopt, so that every call ends.
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

/// The services that components of this process offer, by resolved name. Safe to use from several threads.
class ServiceDirectory {
 public:
  /// Queues a request where it is handled. Never blocks.
  using Serve = std::function<void(interfaces::Bytes request, std::shared_ptr<Reply> reply)>;

  /// Throws ConfigError for a name that is taken. `owner` is what remove_of() knows it by.
  void add(const ServiceDescription& service, const void* owner, Serve serve);
  /// None of the owner's services is called any more when this has returned.
  void remove_of(const void* owner);

  /// False when no component of this process offers a service of that name and type; the reply is unused then.
  bool call(const ServiceDescription& service, interfaces::Bytes& request, const std::shared_ptr<Reply>& reply) const;

 private:
  struct Entry {
    std::string type_name;
    const void* owner;
    Serve serve;
  };
  mutable std::shared_mutex mutex_;
  std::map<std::string, Entry> entries_;
};

/// A handler for the bridge, which has requests of other processes: waits until the component has answered, for some seconds at most.
ServiceHandler handler_of(ServiceDirectory::Serve serve);

}  // namespace panvo::runtime
