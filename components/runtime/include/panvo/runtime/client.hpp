// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "panvo/runtime/service.hpp"

namespace panvo::runtime {

/// Type-erased client of one service.
class ServiceCaller {
 public:
  virtual ~ServiceCaller() = default;
  /// Calls `answer` once, on the component's message thread.
  virtual void call(interfaces::Bytes request, std::chrono::milliseconds limit, Answer answer) = 0;
};

/// A service that a component calls, see Context::client.
template <class Request, class Response>
class Client {
 public:
  explicit Client(std::shared_ptr<ServiceCaller> caller) : caller_(std::move(caller)) {}

  /// Sends a request without blocking. `callback(std::optional<Response>)` runs later on the component's message
  /// thread, between two messages; nullopt if there is no server or no answer. `limit` bounds the wait for a server in
  /// another process.
  template <class Callback>
  void call(const Request& request, Callback callback, std::chrono::milliseconds limit = std::chrono::seconds(5)) {
    caller_->call(to_bytes(request), limit,
                  [callback = std::move(callback)](const std::optional<interfaces::Bytes>& bytes) mutable {
                    callback(response_from(bytes));
                  });
  }

 private:
  static std::optional<Response> response_from(const std::optional<interfaces::Bytes>& bytes) {
    if (!bytes) return std::nullopt;
    try {
      return from_bytes<Response>(*bytes);
    } catch (const interfaces::DecodeError&) {
      return std::nullopt;  // the server has another type
    }
  }

  std::shared_ptr<ServiceCaller> caller_;
};

}  // namespace panvo::runtime
