// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace panvo::interfaces {

/// A service: name, request type and response type together. The name is relative; a system file may remap it.
/// "~/reset" is relative to the node's name.
///
///     inline constexpr Service<std_srvs::srv::Trigger_Request, std_srvs::srv::Trigger_Response> kReset{"~/reset"};
template <class RequestT, class ResponseT>
struct Service {
  using Request = RequestT;
  using Response = ResponseT;
  std::string_view name;
};

}  // namespace panvo::interfaces
