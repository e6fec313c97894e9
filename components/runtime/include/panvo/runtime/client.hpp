// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "panvo/runtime/service.hpp"

namespace panvo::runtime {

/// Calls one service, whatever its type.
class ServiceCaller {
 public:
  virtual ~ServiceCaller() = default;
  /// `answer` is called once, on the thread of the component's messages.
  virtual void call(interfaces::Bytes request, std::chrono::milliseconds limit, Answer answer) = 0;
};

/// A service that a component calls, see Context::client.
template <class Request, class Response>
class Client {
 public:
  explicit Client(std::shared_ptr<ServiceCaller> caller) : caller_(std::move(caller)) {}

  /// Sends a request and returns. `callback(std::optional<Response>)` follows on the thread of the component's messages, between two of them: nullopt
  /// when no server is there or it did not answer. `limit` bounds the wait for a server in another process.
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
      return std::nullopt;  // the server is of another type
    }
  }

  std::shared_ptr<ServiceCaller> caller_;
};

}  // namespace panvo::runtime
