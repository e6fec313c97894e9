// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "panvo/runtime/parameters.hpp"
#include "panvo/runtime/service.hpp"
#include "panvo/runtime/system_file.hpp"

namespace panvo::runtime::steering {

/// What requests from other processes may do to a component.
class SteeredNode {
 public:
  virtual ~SteeredNode() = default;
  virtual std::vector<ParameterDescription> parameters() const = 0;
  /// All or none; returns what is wrong.
  virtual std::vector<std::string> set_parameters(const WrittenValues& wanted) = 0;

  virtual bool is_active() const = 0;
  /// Whether messages are handed to it. False: it cannot be.
  virtual bool set_active(bool active) = 0;
  /// Unloads it soon, when its services have answered. False: it cannot be.
  virtual bool shut_down() = 0;
};

/// What they may do to a container.
class SteeredContainer {
 public:
  virtual ~SteeredContainer() = default;
  struct Loaded {
    std::uint64_t id = 0;  ///< never used again
    std::string full_name;
  };
  /// As another process asks for it: it may name no files but those that the container allows. Throws ConfigError with what is wrong.
  virtual Loaded load_component(const ComponentDescription& description) = 0;
  /// Throws ConfigError when it cannot be.
  virtual void unload_component(std::uint64_t id) = 0;
  virtual std::vector<Loaded> loaded_components() const = 0;
};

/// A service and what answers it.
struct OfferedService {
  ServiceDescription description;
  ServiceHandler handler;
  /// The answer that tells who asked why nothing was done; empty for a service that changes nothing.
  std::function<interfaces::Bytes(const interfaces::Bytes& request, const std::string& why)> refuse = {};
};

/// A way to refuse messages as one of bytes.
template <class Request, class Response>
auto refusal_of(Response (*refuse)(const Request&, const std::string& why)) {
  return [refuse](const interfaces::Bytes& request, const std::string& why) {
    return to_bytes<Response>(refuse(from_bytes<Request>(request), why));
  };
}

/// Why who asks may not change anything; nullopt: he may.
std::optional<std::string> steering_problem(ServiceAccess access, const Caller& caller);

/// Lets pass who may, and refuses the others; empty for a service that changes nothing.
ServiceGuard guard_of(const OfferedService& service, ServiceAccess access);

/// The services of a node, as ROS 2's have them: `~/get_parameters` and the like, `~/get_state` and the like. `node` must outlive them.
std::vector<OfferedService> parameter_services(const std::string& full_name, SteeredNode& node);
std::vector<OfferedService> lifecycle_services(const std::string& full_name, SteeredNode& node);

/// `~/_container/load_node`, `unload_node`, `list_nodes`. `container` must outlive them.
std::vector<OfferedService> component_services(const std::string& full_name, SteeredContainer& container);

}  // namespace panvo::runtime::steering
