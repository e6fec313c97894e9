// SPDX-License-Identifier: Apache-2.0
#include "parameter_access.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <stdexcept>

#include "rcl_interfaces/srv/GetParameters.h"
#include "rcl_interfaces/srv/ListParameters.h"

namespace panvo::web_view {
namespace {

using namespace rcl_interfaces::srv;  // NOLINT(google-build-using-namespace): the requests and responses of this file
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// The node "/talker" as rclcpp and rclpy have it: declared parameters may be without value, and get_parameters gives no
/// value at all if one of the requested parameters is unknown or without value.
class TopicsOfRclcppNode final : public runtime::TopicAccess {
 public:
  explicit TopicsOfRclcppNode(std::map<std::string, std::optional<std::int64_t>> declared)
      : declared_(std::move(declared)) {}

  std::vector<runtime::NodeDescription> nodes() const override {
    return {{"/", "talker", {}, {}, {"/talker/get_parameters", "/talker/list_parameters"}}};
  }
  std::optional<interfaces::Bytes> call(const runtime::ServiceDescription& service, interfaces::Bytes request,
                                        std::chrono::milliseconds) override {
    if (service.name == "/talker/list_parameters") {
      ListParameters_Response response;
      for (const auto& [name, value] : declared_) response.result().names().push_back(name);
      return runtime::to_bytes(response);
    }
    if (service.name != "/talker/get_parameters") throw std::logic_error("unexpected call of " + service.name);
    const auto asked = runtime::from_bytes<GetParameters_Request>(request);
    GetParameters_Response response;
    for (const auto& name : asked.names()) {
      const auto found = declared_.find(name);
      if (found == declared_.end() || !found->second) return runtime::to_bytes(GetParameters_Response());
      auto& value = response.values().emplace_back();
      value.type(2);  // integer
      value.integer_value(*found->second);
    }
    return runtime::to_bytes(response);
  }

  std::vector<runtime::TopicDescription> published() const override { return {}; }
  std::vector<runtime::ServiceDescription> services() const override { return {}; }
  std::shared_ptr<void> read(const runtime::TopicDescription&,
                             std::function<void(const runtime::SamplePtr&)>) override {
    return nullptr;
  }
  std::shared_ptr<runtime::UntypedOutput> write(const runtime::TopicDescription&) override { return nullptr; }

 private:
  std::map<std::string, std::optional<std::int64_t>> declared_;
};

std::vector<std::string> shown(const ParameterAccess::Result& result) {
  std::vector<std::string> texts;
  for (const auto& parameter : result.parameters)
    texts.push_back(parameter.name + "=" + std::to_string(std::get<std::int64_t>(parameter.value)));
  return texts;
}

TEST(ParameterAccess, ShowsTheOtherParametersOfANodeWithOneThatHasNoValue) {
  TopicsOfRclcppNode topics({{"a", 1}, {"b", 2}, {"c", std::nullopt}, {"d", 4}, {"e", 5}});
  const auto result = ParameterAccess(topics).get({});
  EXPECT_THAT(shown(result), ElementsAre("/talker/a=1", "/talker/b=2", "/talker/d=4", "/talker/e=5"));
  EXPECT_THAT(result.problems, IsEmpty());
}

TEST(ParameterAccess, GivesKnownParametersBesideUnknownOnes) {
  TopicsOfRclcppNode topics({{"a", 1}, {"b", 2}});
  EXPECT_THAT(shown(ParameterAccess(topics).get({"/talker/none", "/talker/b", "/talker/a"})),
              ElementsAre("/talker/b=2", "/talker/a=1"));
}

}  // namespace
}  // namespace panvo::web_view
