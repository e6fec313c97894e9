// SPDX-License-Identifier: Apache-2.0
// Who may do what by service: the one place that decides it.
#include "steering/steered.hpp"

namespace panvo::runtime::steering {

std::optional<std::string> steering_problem(ServiceAccess access, const Caller& caller) {
  if (access == ServiceAccess::kSteer) return std::nullopt;
  if (access == ServiceAccess::kByHost && caller.is_on_this_host) return std::nullopt;
  if (access == ServiceAccess::kByHost) {
    return "refused: who is not known to be on this host may look and change nothing; \"services: steer\" in the "
           "node_container of the system file allows it";
  }
  return "refused: the system file says \"services: look\": nothing may be changed by service";
}

ServiceGuard guard_of(const OfferedService& service, ServiceAccess access) {
  if (!service.refuse) return nullptr;
  return [refuse = service.refuse, access](const interfaces::Bytes& request,
                                           const Caller& caller) -> std::optional<interfaces::Bytes> {
    const auto why = steering_problem(access, caller);
    return why ? std::optional(refuse(request, *why)) : std::nullopt;
  };
}

}  // namespace panvo::runtime::steering
