// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "panvo/interfaces/message_type.hpp"

namespace panvo::runtime {

/// A service as a process offers or calls it.
struct ServiceDescription {
  std::string name;       ///< resolved: "/binocular_odometry/get_parameters"
  std::string type_name;  ///< "rcl_interfaces/srv/GetParameters"
};

/// Answers one request; both are serialised messages. Throws interfaces::DecodeError for bytes that are no request: they get no answer.
using ServiceHandler = std::function<interfaces::Bytes(const interfaces::Bytes& request)>;

/// Takes the response to a call, or nullopt when there is none. Called once.
using Answer = std::function<void(std::optional<interfaces::Bytes>)>;

/// Who asks, as far as the transport tells.
struct Caller {
  bool is_on_this_host = false;
};

/// Is asked before the handler. What it returns is sent instead of the handler's answer: a refusal that says so. An empty one lets all pass.
using ServiceGuard =
    std::function<std::optional<interfaces::Bytes>(const interfaces::Bytes& request, const Caller& caller)>;

struct ServiceCounters {
  std::uint64_t received = 0, answered = 0;
  std::uint64_t malformed = 0;   ///< were no request of the type
  std::uint64_t dropped = 0;     ///< came while too many waited, or faster than allowed, or were too large
  std::uint64_t refused = 0;     ///< were answered by the guard
  std::uint64_t unanswered = 0;  ///< the handler failed, or who asked was gone
};

/// A service that this process offers. Its handler is not running any more when the destructor has returned; it must not
/// destroy its own service, but may others.
class BridgeService {
 public:
  virtual ~BridgeService() = default;
  virtual ServiceCounters counters() const = 0;
};

/// A service of another process, to be called. Safe to use from several threads.
class BridgeClient {
 public:
  virtual ~BridgeClient() = default;
  /// Whether there is somebody to ask, before the limit.
  virtual bool wait_for_service(std::chrono::milliseconds limit) = 0;
  /// The answer; nullopt when there was none before the limit.
  virtual std::optional<interfaces::Bytes> call(const interfaces::Bytes& request, std::chrono::milliseconds limit) = 0;
};

template <class Message>
interfaces::Bytes to_bytes(const Message& message) {
  const auto& type = interfaces::message_type<Message>();
  interfaces::Bytes bytes(type.serialized_size(&message));
  type.serialize(&message, bytes);
  return bytes;
}

/// Throws interfaces::DecodeError.
template <class Message>
Message from_bytes(const interfaces::Bytes& bytes) {
  return *static_cast<const Message*>(interfaces::message_type<Message>().deserialize(bytes).get());
}

/// A handler of messages as one of bytes.
template <class Request, class Response>
ServiceHandler service_handler(std::function<Response(const Request&)> answer) {
  return [answer = std::move(answer)](const interfaces::Bytes& request) {
    return to_bytes<Response>(answer(from_bytes<Request>(request)));
  };
}

}  // namespace panvo::runtime
