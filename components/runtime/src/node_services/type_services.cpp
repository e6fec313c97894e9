// SPDX-License-Identifier: Apache-2.0
// Descriptions of message types, compatible with rclcpp. They let tools read messages of types that they do not know.
#include "node_services/controlled.hpp"
#include "node_services/type_description.hpp"
#include "panvo/interfaces/message_type.hpp"
#include "type_description_interfaces/srv/GetTypeDescription.h"

namespace panvo::runtime::node_services {
namespace {

using type_description_interfaces::srv::GetTypeDescription_Request;
using type_description_interfaces::srv::GetTypeDescription_Response;

GetTypeDescription_Response described_type(const GetTypeDescription_Request& request) {
  GetTypeDescription_Response response;
  const auto* type = interfaces::find_message_type(request.type_name());
  if (!type) {
    response.failure_reason("the type " + request.type_name() + " " + interfaces::why_unknown(request.type_name()));
  } else if (!request.type_hash().empty() && request.type_hash() != type->hash) {
    response.failure_reason("the type " + request.type_name() + " has the hash " + std::string(type->hash) + " here");
  } else {
    response.successful(true);
    response.type_description(describe_type(*type));
    if (request.include_type_sources()) response.type_sources(sources_of(*type));
  }
  return response;
}

}  // namespace

std::vector<OfferedService> type_services(const std::string& full_name) {
  return {{{full_name + "/get_type_description", "type_description_interfaces/srv/GetTypeDescription"},
           service_handler<GetTypeDescription_Request, GetTypeDescription_Response>(described_type)}};
}

}  // namespace panvo::runtime::node_services
