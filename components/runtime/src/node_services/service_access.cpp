// SPDX-License-Identifier: Apache-2.0
// The only place that decides on the rights of service requests.
#include "node_services/controlled.hpp"
#include "panvo/interfaces/message_type.hpp"

namespace panvo::runtime::node_services {

std::optional<std::string> control_problem(ServiceAccess access, const Caller& caller) {
  if (access == ServiceAccess::kSteer) return std::nullopt;
  if (access == ServiceAccess::kByHost && caller.is_on_this_host) return std::nullopt;
  if (access == ServiceAccess::kByHost) {
    return "refused: only callers on this host may make changes; \"services: steer\" in the node_container of the "
           "system file allows others to";
  }
  return "refused: the system file allows no changes by service (\"services: look\")";
}

ServiceGuard guard_of(const OfferedService& service, ServiceAccess access) {
  if (!service.refuse) return nullptr;
  return [refuse = service.refuse, access](const interfaces::Bytes& request,
                                           const Caller& caller) -> std::optional<interfaces::Bytes> {
    const auto why = control_problem(access, caller);
    return why ? std::optional(refuse(request, *why)) : std::nullopt;
  };
}

}  // namespace panvo::runtime::node_services
