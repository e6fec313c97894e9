// SPDX-License-Identifier: Apache-2.0
#include "node_parameters.hpp"

#include <algorithm>
#include <utility>

namespace panvo::runtime {
namespace {

using interfaces::Durability;
using interfaces::Qos;
using interfaces::Reliability;

constexpr std::string_view kQosOverrides = "qos_overrides.";

constexpr const char* kReliable = "reliable";
constexpr const char* kBestEffort = "best_effort";
constexpr const char* kTransientLocal = "transient_local";
constexpr const char* kVolatile = "volatile";
constexpr const char* kKeepAll = "keep_all";
constexpr const char* kKeepLast = "keep_last";

struct SimTime {
  bool use_sim_time = false;
  template <class Field>
  static void describe(Field&& field) {
    field(&SimTime::use_sim_time, "use_sim_time", "",
          "stamp what no message causes by /clock; results have the stamps of their messages in any case");
  }
};

struct QosPolicies {
  std::string reliability, durability, history;
  std::int64_t depth = 10;
  template <class Field>
  static void describe(Field&& field) {
    using P = QosPolicies;
    field(&P::reliability, "reliability", "", "of this topic", {kReliable, kBestEffort});
    field(&P::durability, "durability", "", "transient_local: also for late joiners", {kVolatile, kTransientLocal});
    field(&P::depth, "depth", "1", "messages kept", 1, 1'000'000);
    field(&P::history, "history", "", "keep_all: a writer waits for slow readers", {kKeepLast, kKeepAll});
  }
};

bool is_of_node(const std::string& name) {
  return name == NodeParameters::kUseSimTime || name.starts_with(kQosOverrides);
}

WrittenValues of_node(const WrittenValues& written) {
  WrittenValues values = written;
  std::erase_if(values, [](const auto& value) { return !is_of_node(value.first); });
  return values;
}

QosPolicies policies_of(const Qos& qos, Reliability reliability) {
  return {.reliability = reliability == Reliability::kReliable ? kReliable : kBestEffort,
          .durability = qos.durability == Durability::kTransientLocal ? kTransientLocal : kVolatile,
          .history = qos.keep_all ? kKeepAll : kKeepLast,
          .depth = static_cast<std::int64_t>(qos.depth)};
}

}  // namespace

NodeParameters::NodeParameters(std::string owner, const WrittenValues& written)
    : owner_(std::move(owner)),
      reader_(owner_, of_node(written)),
      uses_sim_time_(reader_.read<SimTime>().use_sim_time) {}

WrittenValues NodeParameters::others(const WrittenValues& written) {
  WrittenValues values = written;
  std::erase_if(values, [](const auto& value) { return is_of_node(value.first); });
  return values;
}

bool NodeParameters::uses_sim_time() const {
  const std::lock_guard lock(mutex_);
  return uses_sim_time_;
}

void NodeParameters::use_sim_time(bool use) {
  const std::lock_guard lock(mutex_);
  uses_sim_time_ = use;
}

std::variant<std::monostate, bool, std::string> NodeParameters::wanted_sim_time(const WrittenValues& wanted) const {
  const auto found = wanted.find(std::string(kUseSimTime));
  if (found == wanted.end()) return {};
  bool use = false;
  if (const auto wrong = parse(found->second, use)) return owner_ + "." + found->first + ": " + *wrong;
  return use;
}

std::optional<Qos> NodeParameters::overriding(const std::string& topic, Side side, const Qos& qos) {
  const bool is_publisher = side == Side::kPublisher;
  const auto defaults = policies_of(qos, is_publisher ? qos.offered : qos.requested);
  const std::lock_guard lock(mutex_);
  const auto wanted =
      reader_.read(defaults, std::string(kQosOverrides) + topic + (is_publisher ? ".publisher." : ".subscription."));
  Qos overridden = qos;
  (is_publisher ? overridden.offered : overridden.requested) =
      wanted.reliability == kReliable ? Reliability::kReliable : Reliability::kBestEffort;
  overridden.durability = wanted.durability == kTransientLocal ? Durability::kTransientLocal : Durability::kVolatile;
  overridden.depth = static_cast<std::size_t>(wanted.depth);
  overridden.keep_all = wanted.history == kKeepAll;
  return overridden == qos ? std::nullopt : std::optional(overridden);
}

std::vector<ParameterDescription> NodeParameters::declared() const {
  const std::lock_guard lock(mutex_);
  auto parameters = reader_.declared();
  const auto sim_time = std::ranges::find(parameters, kUseSimTime, &ParameterDescription::name);
  sim_time->settable = true;
  sim_time->value = to_text(uses_sim_time_);
  sim_time->written.items = {sim_time->value};
  return parameters;
}

std::vector<std::string> NodeParameters::problems() const {
  const std::lock_guard lock(mutex_);
  return reader_.problems();
}

}  // namespace panvo::runtime
