// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <stdexcept>
#include <string>
#include <string_view>

#include "panvo/runtime/container.hpp"

namespace panvo::recorder::test {

inline runtime::ComponentDescription description(const std::string& name) {
  runtime::ComponentDescription description;
  description.name = name;
  description.name_space = "/";
  return description;
}

/// Calls a service by its whole name and waits for the answer.
template <class Response, class Request>
Response call_service(runtime::TopicAccess& access, const std::string& service, const Request& request) {
  const std::string_view type = interfaces::message_type<Request>().name;
  const auto answer = access.call({service, std::string(type.substr(0, type.rfind("_Request")))},
                                  runtime::to_bytes(request), std::chrono::seconds(20));
  if (!answer) throw std::runtime_error("no answer from " + service);
  return runtime::from_bytes<Response>(*answer);
}

}  // namespace panvo::recorder::test
