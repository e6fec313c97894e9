// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

#include "node_services/controlled.hpp"
#include "panvo/runtime/errors.hpp"

namespace panvo::runtime::node_services {

/// A node with parameters of every type; `tracker.gain` and `mode` are settable.
class FakeNode final : public ControlledNode {
 public:
  FakeNode() {
    all.push_back(parameter("tracker.max_features", "integer", {{"500"}, false, {}}, 1, 5000));
    all.push_back(parameter("tracker.gain", "number", {{"0.5"}, false, {}}, 0, 1));
    all.push_back(parameter("tracker.patch.size", "integer", {{"7"}, false, {}}, 3, 31));
    all.push_back(parameter("mode", "text", {{"fast"}, false, {}}));
    all.push_back(parameter("enabled", "bool", {{"true"}, false, {}}));
    all.push_back(parameter("weights", "numbers", {{"1", "2.5"}, true, {}}));
    all.push_back(parameter("topics", "texts", {{"a, b", "c"}, true, {}}));
    all[1].settable = all[3].settable = true;
    all[3].choices = {"fast", "exact"};
    all[1].unit = "px";
  }

  std::vector<ParameterDescription> parameters() const override { return all; }
  std::vector<std::string> set_parameters(const WrittenValues& wanted) override {
    asked.push_back(wanted);
    if (!refusal.empty()) return {refusal};
    for (auto& one : all) {
      if (const auto found = wanted.find(one.name); found != wanted.end()) one.written = found->second;
    }
    return {};
  }
  bool is_active() const override { return active; }
  bool set_active(bool wanted) override {
    if (!refusal.empty()) return false;
    active = wanted;
    return true;
  }
  bool shut_down() override {
    is_over = true;
    return true;
  }

  bool is_shut_down() const override { return is_over; }

  std::vector<ParameterDescription> all;
  std::vector<WrittenValues> asked;
  std::string refusal;
  bool active = true, is_over = false;

 private:
  static ParameterDescription parameter(const std::string& name, const std::string& type, WrittenValue written,
                                        std::optional<double> min = {}, std::optional<double> max = {}) {
    ParameterDescription description;
    description.name = name;
    description.type = type;
    description.written = std::move(written);
    description.min = min;
    description.max = max;
    description.description = "of the test";
    return description;
  }
};

/// Calls the service with this name ending.
template <class Response, class Request>
Response ask(const std::vector<OfferedService>& services, const std::string& end, const Request& request) {
  for (const auto& service : services) {
    if (service.description.name.ends_with("/" + end)) return from_bytes<Response>(service.handler(to_bytes(request)));
  }
  throw std::runtime_error("there is no service " + end);
}

}  // namespace panvo::runtime::node_services
