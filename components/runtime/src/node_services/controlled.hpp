// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lifecycle_msgs/msg/TransitionEvent.h"
#include "panvo/runtime/parameters.hpp"
#include "panvo/runtime/service.hpp"
#include "panvo/runtime/system_file.hpp"

namespace panvo::runtime::node_services {

/// Operations of service requests on a component.
class ControlledNode {
 public:
  virtual ~ControlledNode() = default;
  virtual std::vector<ParameterDescription> parameters() const = 0;
  /// Sets all values or none; returns the problems.
  virtual std::vector<std::string> set_parameters(const WrittenValues& wanted) = 0;

  virtual bool is_active() const = 0;
  /// Enables or disables message delivery. False if not possible.
  virtual bool set_active(bool active) = 0;
  /// Stops it for good, soon after its services have answered. False if not possible.
  virtual bool shut_down() = 0;
  virtual bool is_shut_down() const = 0;
};

/// Operations of service requests on a container.
class ControlledContainer {
 public:
  virtual ~ControlledContainer() = default;
  struct Loaded {
    std::uint64_t id = 0;  ///< never reused
    std::string full_name;
  };
  /// Loads a component on request; it may name only files that the container allows. Throws ConfigError with the
  /// problems.
  virtual Loaded load_component(const ComponentDescription& description) = 0;
  /// Throws ConfigError if not possible.
  virtual void unload_component(std::uint64_t id) = 0;
  virtual std::vector<Loaded> loaded_components() const = 0;
};

/// A service and its handler.
struct OfferedService {
  ServiceDescription description;
  ServiceHandler handler;
  /// Creates the refusal response with the reason; empty for a service that changes nothing.
  std::function<interfaces::Bytes(const interfaces::Bytes& request, const std::string& why)> refuse = {};
};

/// Converts a refusal function on messages to one on bytes.
template <class Request, class Response>
auto refusal_of(Response (*refuse)(const Request&, const std::string& why)) {
  return [refuse](const interfaces::Bytes& request, const std::string& why) {
    return to_bytes<Response>(refuse(from_bytes<Request>(request), why));
  };
}

/// Why the caller may not make changes; nullopt if allowed.
std::optional<std::string> control_problem(ServiceAccess access, const Caller& caller);

/// Guard that refuses unauthorised callers; empty for a service that changes nothing.
ServiceGuard guard_of(const OfferedService& service, ServiceAccess access);

/// Receives the transitions of a node, for `~/transition_event`.
using PublishTransition = std::function<void(const lifecycle_msgs::msg::TransitionEvent&)>;

/// Parameter and lifecycle services of a node as in ROS 2: `~/get_parameters` etc., `~/get_state` etc. `node` must
/// outlive them.
std::vector<OfferedService> parameter_services(const std::string& full_name, ControlledNode& node);
std::vector<OfferedService> lifecycle_services(const std::string& full_name, ControlledNode& node,
                                               PublishTransition publish);

/// `~/get_type_description`, for the message types of all loaded libraries.
std::vector<OfferedService> type_services(const std::string& full_name);

/// `~/_container/load_node`, `unload_node`, `list_nodes`. `container` must outlive them.
std::vector<OfferedService> component_services(const std::string& full_name, ControlledContainer& container);

}  // namespace panvo::runtime::node_services
