// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "panvo/interfaces/service.hpp"
#include "panvo/runtime/client.hpp"
#include "panvo/runtime/component.hpp"
#include "panvo/runtime/context.hpp"
#include "panvo/runtime/testing.hpp"
#include "std_srvs/srv/Trigger.h"

namespace panvo::landmarks::test {

/// Calls "/landmarks/save" in a harness. Made before the component that offers it.
class SaveCaller {
 public:
  using Request = std_srvs::srv::Trigger_Request;
  using Response = std_srvs::srv::Trigger_Response;

  explicit SaveCaller(runtime::ComponentHarness& harness) : harness_(harness) {
    struct Asking final : runtime::Component {};
    runtime::ComponentDescription description;
    description.package = "panvo_asking";
    description.name = "asking";
    description.name_space = "/";
    harness.container().add(description, [this](runtime::Context& context) {
      client_.emplace(context.client(interfaces::Service<Request, Response>{"/landmarks/save"}));
      return std::make_unique<Asking>();
    });
  }

  Response save() {
    std::optional<Response> answer;
    client_->call(Request(), [&](const std::optional<Response>& response) { answer = response; });
    harness_.container().run_until_quiet();
    if (!answer) ADD_FAILURE() << "no answer";
    return answer.value_or(Response());
  }

 private:
  runtime::ComponentHarness& harness_;
  std::optional<runtime::Client<Request, Response>> client_;
};

}  // namespace panvo::landmarks::test
