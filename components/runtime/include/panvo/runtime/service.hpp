// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "panvo/interfaces/message_type.hpp"

namespace panvo::runtime {

/// A service that a process offers or calls.
struct ServiceDescription {
  std::string name;       ///< resolved: "/binocular_odometry/get_parameters"
  std::string type_name;  ///< "rcl_interfaces/srv/GetParameters"
};

/// Answers one request; both are serialised messages. Throws interfaces::DecodeError on a malformed request, which
/// stays unanswered.
using ServiceHandler = std::function<interfaces::Bytes(const interfaces::Bytes& request)>;

/// Receives the response to a call, or nullopt if there is none. Called once.
using Answer = std::function<void(std::optional<interfaces::Bytes>)>;

/// The caller, as far as the transport identifies it.
struct Caller {
  bool is_on_this_host = false;
};

/// Called before the handler. A returned response (a refusal) is sent instead of the handler's. An empty guard allows
/// all requests.
using ServiceGuard =
    std::function<std::optional<interfaces::Bytes>(const interfaces::Bytes& request, const Caller& caller)>;

struct ServiceCounters {
  std::uint64_t received = 0, answered = 0;
  std::uint64_t malformed = 0;   ///< not a request of this type
  std::uint64_t dropped = 0;     ///< queue full, rate exceeded, or too large
  std::uint64_t refused = 0;     ///< answered by the guard
  std::uint64_t unanswered = 0;  ///< the handler failed, or the client was gone
};

/// A service of this process. Its handler is not running once the destructor has returned. A handler must not destroy
/// its own service, but may destroy others.
class BridgeService {
 public:
  virtual ~BridgeService() = default;
  virtual ServiceCounters counters() const = 0;
};

/// Client of a service of another process. Thread-safe.
class BridgeClient {
 public:
  virtual ~BridgeClient() = default;
  /// Waits for a server; false if there is none within `limit`.
  virtual bool wait_for_service(std::chrono::milliseconds limit) = 0;
  /// Returns the response; nullopt if there was none within `limit`.
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

/// Converts a handler of messages to one of bytes.
template <class Request, class Response>
ServiceHandler service_handler(std::function<Response(const Request&)> answer) {
  return [answer = std::move(answer)](const interfaces::Bytes& request) {
    return to_bytes<Response>(answer(from_bytes<Request>(request)));
  };
}

}  // namespace panvo::runtime
