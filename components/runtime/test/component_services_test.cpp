// SPDX-License-Identifier: Apache-2.0
// Services between components of one container.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <thread>

#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/testing.hpp"
#include "rcl_interfaces/srv/GetParameters.h"
#include "service_directory.hpp"
#include "std_msgs/msg/String.h"

namespace panvo::runtime {
namespace {

using rcl_interfaces::srv::GetParameters_Request;
using rcl_interfaces::srv::GetParameters_Response;
using std_msgs::msg::String;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr interfaces::Service<GetParameters_Request, GetParameters_Response> kEcho{"echo"};
constexpr interfaces::Topic<String> kAsk{"ask", {.depth = 100}};

/// Echoes the request's text.
struct Server : Component {
  explicit Server(Context& context) {
    context.serve(kEcho, [this](const GetParameters_Request& request) {
      thread = std::this_thread::get_id();
      if (request.names().at(0) == "break") throw std::runtime_error("broken");
      GetParameters_Response response;
      response.values().resize(1);
      response.values()[0].string_value("echo of " + request.names()[0]);
      return response;
    });
  }
  std::thread::id thread;
};

/// Sends the texts received on a topic as requests and records the answers.
struct Asker : Component {
  explicit Asker(Context& context) : client(context.client(kEcho)) {
    context.input(kAsk, [this](std::shared_ptr<const String> text) {
      GetParameters_Request request;
      request.names().push_back(text->data());
      client.call(request, [this](const std::optional<GetParameters_Response>& response) {
        answers.push_back(response ? response->values()[0].string_value() : "nothing");
      });
    });
  }
  Client<GetParameters_Request, GetParameters_Response> client;
  std::vector<std::string> answers;
};

ComponentDescription named(const std::string& name) {
  ComponentDescription description;
  description.name = name;
  description.name_space = "/";
  return description;
}

String text(const std::string& data) {
  String message;
  message.data(data);
  return message;
}

class ServicesOfComponents : public testing::Test {
 protected:
  void add_server(const std::string& name = "server") {
    harness.container().add(named(name), [this](Context& context) {
      auto made = std::make_unique<Server>(context);
      server = made.get();
      return made;
    });
  }
  void add_asker() {
    harness.container().add(named("asker"), [this](Context& context) {
      auto made = std::make_unique<Asker>(context);
      asker = made.get();
      return made;
    });
  }
  void ask(const std::string& what) { harness.publish(kAsk, text(what)); }

  ComponentHarness harness;
  Server* server = nullptr;
  Asker* asker = nullptr;
};

TEST_F(ServicesOfComponents, AnswerInOrder) {
  add_server();
  add_asker();
  ask("one");
  ask("two");
  EXPECT_THAT(asker->answers, ElementsAre("echo of one", "echo of two"));
}

TEST_F(ServicesOfComponents, MayBeLoadedAfterTheirClients) {
  add_asker();
  ask("too early");
  add_server();
  ask("in time");
  EXPECT_THAT(asker->answers, ElementsAre("nothing", "echo of in time"));
}

TEST_F(ServicesOfComponents, ThatAreUnloadedAnswerNothing) {
  add_server();
  add_asker();
  ask("one");
  harness.container().unload("server");
  ask("two");
  EXPECT_THAT(asker->answers, ElementsAre("echo of one", "nothing"));
}

TEST_F(ServicesOfComponents, OfAComponentThatFailsAnswerNothing) {
  add_server();
  add_asker();
  ask("break");
  ask("one");
  EXPECT_THAT(asker->answers, ElementsAre("nothing", "nothing"));
  EXPECT_TRUE(harness.log_contains("server: stopped by an error: broken"));
}

TEST_F(ServicesOfComponents, OfOneNameAreAnsweredByTheFirst) {
  add_server("first");
  add_server("second");
  EXPECT_TRUE(harness.log_contains("service /echo already exists in this container"));
  add_asker();
  ask("one");
  harness.container().unload("second");
  ask("two");
  EXPECT_THAT(asker->answers, ElementsAre("echo of one", "echo of two"));
}

TEST_F(ServicesOfComponents, AreRemappedAsTopicsAre) {
  auto description = named("server");
  description.remaps = {{"echo", "/deep/well"}};
  harness.container().add(description, [](Context& context) { return std::make_unique<Server>(context); });
  add_asker();
  ask("one");
  EXPECT_THAT(asker->answers, ElementsAre("nothing")) << "nobody is called /echo";
}

TEST(ServiceHandler, OfAComponentThatDiscardsARequestThrowsAtOnce) {
  const auto handler = handler_of([](const interfaces::Bytes&, const std::shared_ptr<Reply>&) {});
  EXPECT_THROW(handler({}), std::runtime_error);
}

TEST(ServiceHandler, ReturnsTheAnswerOfAnotherThread) {
  std::thread answering;
  const auto handler = handler_of([&answering](interfaces::Bytes bytes, std::shared_ptr<Reply> reply) {
    answering = std::thread([bytes, reply = std::move(reply)] { reply->send(bytes); });
  });
  EXPECT_THAT(handler({1, 2}), ElementsAre(1, 2));
  answering.join();
}

TEST(ServicesOfComponentsLive, AnswerOnTheThreadOfTheirComponent) {
  Container container({});
  Server* server = nullptr;
  std::promise<std::string> answer;
  std::promise<std::thread::id> asked_on;
  container.add(named("server"), [&](Context& context) {
    auto made = std::make_unique<Server>(context);
    server = made.get();
    return made;
  });
  struct Once : Component {
    Once(Context& context, std::promise<std::string>& answer, std::promise<std::thread::id>& asked_on)
        : client(context.client(kEcho)) {
      context.every(std::chrono::milliseconds(1), [this, &answer, &asked_on] {
        if (std::exchange(is_asked, true)) return;
        asked_on.set_value(std::this_thread::get_id());
        GetParameters_Request request;
        request.names().push_back("live");
        client.call(request, [&answer, thread = std::this_thread::get_id()](const auto& response) {
          const bool is_same_thread = thread == std::this_thread::get_id();
          answer.set_value(response && is_same_thread ? response->values()[0].string_value() : "wrong");
        });
      });
    }
    Client<GetParameters_Request, GetParameters_Response> client;
    bool is_asked = false;
  };
  container.add(named("once"), [&](Context& context) { return std::make_unique<Once>(context, answer, asked_on); });
  container.start();
  auto answered = answer.get_future();
  ASSERT_EQ(answered.wait_for(std::chrono::seconds(10)), std::future_status::ready);
  EXPECT_EQ(answered.get(), "echo of live");
  EXPECT_NE(server->thread, asked_on.get_future().get());
}

/// Asks once, with an answer that holds something of the component.
struct Holder : Component {
  Holder(Context& context, std::shared_ptr<int> something) : client(context.client(kEcho)) {
    context.every(std::chrono::milliseconds(1), [this, something = std::move(something)] {
      if (std::exchange(is_asked, true)) return;
      client.call(GetParameters_Request(), [something](const auto&) {});
    });
  }
  Client<GetParameters_Request, GetParameters_Response> client;
  bool is_asked = false;
};

TEST(ServicesOfComponentsLive, ThatAreBusyHoldNothingOfAnUnloadedClient) {
  std::promise<void> asked, answered;
  Container container({});
  container.add(named("server"), [&](Context& context) {
    context.serve(kEcho, [&](const GetParameters_Request&) {
      asked.set_value();
      answered.get_future().wait();
      return GetParameters_Response();
    });
    return std::make_unique<Component>();
  });
  auto something = std::make_shared<int>();
  const std::weak_ptr<int> held = something;
  container.add(named("client"), [&](Context& context) { return std::make_unique<Holder>(context, something); });
  container.start();
  asked.get_future().wait();
  ASSERT_TRUE(container.unload("client"));
  something.reset();
  EXPECT_TRUE(held.expired()) << "its destructor may be in a plugin that is gone";
  answered.set_value();
}

}  // namespace
}  // namespace panvo::runtime
