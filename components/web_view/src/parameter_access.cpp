// SPDX-License-Identifier: Apache-2.0
#include "parameter_access.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "panvo/runtime/names.hpp"
#include "protocol_error.hpp"
#include "rcl_interfaces/srv/GetParameters.h"
#include "rcl_interfaces/srv/ListParameters.h"
#include "rcl_interfaces/srv/SetParameters.h"
#include "ros_parameter.hpp"

namespace panvo::web_view {
namespace {

using namespace rcl_interfaces::srv;  // NOLINT(google-build-using-namespace): the requests and responses of this file

constexpr std::chrono::milliseconds kLimit{2000};  // for one answer
constexpr std::chrono::seconds kLimitOfAll{5};
constexpr const char* kListService = "list_parameters";

/// "rcl_interfaces/srv/GetParameters" of GetParameters_Request.
template <class Request>
std::string service_type() {
  const std::string_view name = interfaces::message_type<Request>().name;
  return std::string(name.substr(0, name.rfind("_Request")));
}

/// One request for parameters.
class Inquiry {
 public:
  explicit Inquiry(runtime::TopicAccess& topics) : topics_(topics) {}

  /// Adds the names of all parameters of all nodes.
  void add_all() {
    for (const auto& node : nodes_) {
      with(node, [&] {
        const auto list = call<ListParameters_Response>(node, kListService, ListParameters_Request());
        for (const auto& name : list.result().names()) wanted_[node].push_back({name, {}});
      });
    }
  }

  void add(const Parameter& parameter) {
    std::string owner;  // the longest, as names of nodes and of parameters may contain slashes
    for (const auto& node : nodes_) {
      if (parameter.name.starts_with(node + "/") && node.size() > owner.size()) owner = node;
    }
    if (owner.empty()) {
      result_.problems.push_back("parameter " + parameter.name + ": there is no such node; names are /NODE/PARAMETER");
    } else {
      wanted_[owner].push_back({parameter.name.substr(owner.size() + 1), parameter.value});
    }
  }

  void set() {
    for (const auto& entry : wanted_) with(entry.first, [&] { set(entry.first, entry.second); });
  }

  ParameterAccess::Result get() {
    for (const auto& entry : wanted_) with(entry.first, [&] { get(entry.first, entry.second); });
    return std::move(result_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  std::set<std::string> nodes_with_parameters() const {
    std::set<std::string> names;
    for (const auto& node : topics_.nodes()) {
      const std::string name = runtime::full_name(node.name_space, node.name);
      if (std::ranges::find(node.serves, name + "/" + kListService) != node.serves.end()) names.insert(name);
    }
    return names;
  }

  /// A node that fails does not keep others from answering.
  void with(const std::string& node, const std::function<void()>& ask) {
    try {
      ask();
    } catch (const std::exception& error) {
      result_.problems.push_back("node " + node + ": " + error.what());
    }
  }

  template <class Response, class Request>
  Response call(const std::string& node, const char* service, const Request& request) const {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end_ - Clock::now());
    const auto answer = topics_.call({node + "/" + service, service_type<Request>()}, runtime::to_bytes(request),
                                     std::clamp(left, std::chrono::milliseconds(1), kLimit));
    if (!answer) throw ProtocolError("does not answer about its parameters");
    return runtime::from_bytes<Response>(*answer);
  }

  void set(const std::string& node, const std::vector<Parameter>& parameters) {
    SetParameters_Request request;
    for (const auto& parameter : parameters) {
      auto& entry = request.parameters().emplace_back();
      entry.name(parameter.name);
      entry.value(ros_value_of(parameter.value));
    }
    const auto response = call<SetParameters_Response>(node, "set_parameters", request);
    for (std::size_t i = 0; i < std::min(parameters.size(), response.results().size()); ++i) {
      const auto& result = response.results()[i];
      if (!result.successful())
        result_.problems.push_back("parameter " + node + "/" + parameters[i].name + " was not set: " + result.reason());
    }
  }

  void get(const std::string& node, std::span<const Parameter> parameters) {
    GetParameters_Request request;
    for (const auto& parameter : parameters) request.names().push_back(parameter.name);
    const auto response = call<GetParameters_Response>(node, "get_parameters", request);
    // Nodes of rclcpp and rclpy answer with nothing if one of the parameters is unknown or declared without a value.
    if (response.values().empty() && parameters.size() > 1) {
      const std::size_t half = parameters.size() / 2;
      get(node, parameters.first(half));
      get(node, parameters.subspan(half));
      return;
    }
    for (std::size_t i = 0; i < std::min(parameters.size(), response.values().size()); ++i) {
      auto value = value_of(response.values()[i]);
      if (!std::holds_alternative<std::monostate>(value))
        result_.parameters.push_back({node + "/" + parameters[i].name, std::move(value)});
    }
  }

  runtime::TopicAccess& topics_;
  const Clock::time_point end_ = Clock::now() + kLimitOfAll;
  const std::set<std::string> nodes_ = nodes_with_parameters();
  std::map<std::string, std::vector<Parameter>> wanted_;  // by node; names without it
  ParameterAccess::Result result_;
};

}  // namespace

auto ParameterAccess::get(const std::vector<std::string>& names) const -> Result {
  Inquiry inquiry(topics_);
  if (names.empty()) inquiry.add_all();
  for (const auto& name : names) inquiry.add({name, {}});
  return inquiry.get();
}

auto ParameterAccess::set(const std::vector<Parameter>& parameters) const -> Result {
  Inquiry inquiry(topics_);
  for (const auto& parameter : parameters) inquiry.add(parameter);
  inquiry.set();
  return inquiry.get();
}

std::vector<Parameter> parameters_of(const rcl_interfaces::msg::ParameterEvent& event) {
  std::vector<Parameter> parameters;
  for (const auto* list : {&event.new_parameters(), &event.changed_parameters()}) {
    for (const auto& entry : *list) parameters.push_back({event.node() + "/" + entry.name(), value_of(entry.value())});
  }
  for (const auto& entry : event.deleted_parameters()) parameters.push_back({event.node() + "/" + entry.name(), {}});
  return parameters;
}

}  // namespace panvo::web_view
