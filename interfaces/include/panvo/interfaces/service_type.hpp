// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace panvo::interfaces {

/// A service type. Its request and response are messages: NAME_Request and NAME_Response.
struct ServiceType {
  std::string_view name;  ///< "rcl_interfaces/srv/GetParameters"
  std::string_view hash;  ///< ROS 2 type description hash
};

/// Registers the services of a message library. Defined by the generated sources.
class ServiceTable {
 public:
  explicit ServiceTable(std::span<const ServiceType> types);
};

/// The hash of a service type; empty if the type is unknown. Loads the library of the package if necessary.
std::string_view service_hash(std::string_view name);

}  // namespace panvo::interfaces
