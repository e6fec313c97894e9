// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/runtime/service.hpp"
#include "rcl_interfaces/srv/GetParameters.h"

namespace panvo::runtime::test {

/// The tests' service: a text as request and response.
inline constexpr const char* kServiceType = "rcl_interfaces/srv/GetParameters";

inline interfaces::Bytes request(const std::string& text) {
  rcl_interfaces::srv::GetParameters_Request message;
  message.names().push_back(text);
  return to_bytes(message);
}

inline std::string text_of_request(const interfaces::Bytes& bytes) {
  return from_bytes<rcl_interfaces::srv::GetParameters_Request>(bytes).names().at(0);
}

inline interfaces::Bytes response(const std::string& text) {
  rcl_interfaces::srv::GetParameters_Response message;
  message.values().resize(1);
  message.values()[0].string_value(text);
  return to_bytes(message);
}

inline std::string text_of_response(const interfaces::Bytes& bytes) {
  return from_bytes<rcl_interfaces::srv::GetParameters_Response>(bytes).values().at(0).string_value();
}

}  // namespace panvo::runtime::test
