// SPDX-License-Identifier: Apache-2.0
// Services of components between two processes.
#include <future>

#include "bridge_fixture.hpp"
#include "panvo/runtime/container.hpp"
#include "panvo/runtime/context.hpp"
#include "service_messages.hpp"

namespace panvo::runtime::test {
namespace {

using rcl_interfaces::srv::GetParameters_Request;
using rcl_interfaces::srv::GetParameters_Response;
using TextService = interfaces::Service<GetParameters_Request, GetParameters_Response>;

ComponentDescription named(const std::string& name) {
  ComponentDescription description;
  description.name = name;
  description.name_space = "/";
  return description;
}

class ComponentsBetweenProcesses : public BetweenProcesses {
 protected:
  DdsSettings settings() const {
    DdsSettings settings;
    settings.domain = domain;
    return settings;
  }
};

TEST_F(ComponentsBetweenProcesses, AnswerTheOtherProcess) {
  const auto name = unique_topic("service");
  Container container({.dds = settings(), .name = "answering"});
  container.add(named("server"), [&](Context& context) {
    context.serve(TextService{name}, [](const GetParameters_Request& request) {
      GetParameters_Response response;
      response.values().resize(1);
      response.values()[0].string_value("component:" + request.names().at(0));
      return response;
    });
    return std::make_unique<Component>();
  });
  container.start();
  EXPECT_EQ(peer.ask("call " + name + " one"), "component:one");
  EXPECT_EQ(peer.ask("call " + name + " two"), "component:two");
}

/// Calls a service once, on request.
class Caller : public Component {
 public:
  Caller(Context& context, const std::string& name, std::promise<std::string>& answer)
      : client_(context.client(TextService{name})) {
    context.every(std::chrono::milliseconds(5), [this, &answer] {
      if (std::exchange(is_asked_, true)) return;
      GetParameters_Request request;
      request.names().push_back("one");
      client_.call(
          request,
          [&answer](const auto& response) {
            answer.set_value(response ? response->values().at(0).string_value() : "nothing");
          },
          kLimit);
    });
  }

 private:
  Client<GetParameters_Request, GetParameters_Response> client_;
  bool is_asked_ = false;
};

TEST_F(ComponentsBetweenProcesses, CallTheOtherProcess) {
  const auto name = unique_topic("service");
  peer.ask("serve " + name);
  std::promise<std::string> answer;
  Container container({.dds = settings(), .name = "calling"});
  container.add(named("caller"), [&](Context& context) { return std::make_unique<Caller>(context, name, answer); });
  container.start();
  auto answered = answer.get_future();
  ASSERT_EQ(answered.wait_for(2 * kLimit), std::future_status::ready);
  EXPECT_EQ(answered.get(), "peer:one");
}

TEST_F(ComponentsBetweenProcesses, ThatAreUnloadedDoNotWaitForAServerThatIsNotThere) {
  std::promise<std::string> answer;
  Container container({.dds = settings(), .name = "waiting"});
  container.add(named("caller"),
                [&](Context& context) { return std::make_unique<Caller>(context, unique_topic("service"), answer); });
  container.start();
  EXPECT_TRUE(container.unload("caller"));
}

}  // namespace
}  // namespace panvo::runtime::test
