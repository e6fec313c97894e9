// SPDX-License-Identifier: Apache-2.0
// The container and its components as nodes: their services, and what other processes are told of them.
#include <algorithm>
#include <iterator>

#include "clocks.hpp"
#include "container_implementation.hpp"
#include "node_services/parameter_events.hpp"
#include "panvo/interfaces/node_topics.hpp"

namespace panvo::runtime {
namespace {

std::vector<std::string> names_of(const std::vector<node_services::OfferedService>& services, ServiceAccess access) {
  std::vector<std::string> names;
  if (access == ServiceAccess::kOff) return names;
  for (const auto& service : services) names.push_back(service.description.name);
  return names;
}

/// The handler for callers in this process.
ServiceHandler guarded(ServiceHandler handler, ServiceGuard guard) {
  if (!guard) return handler;
  return [handler = std::move(handler), guard = std::move(guard)](const interfaces::Bytes& request) {
    auto refusal = guard(request, Caller{.is_on_this_host = true});
    return refusal ? std::move(*refusal) : handler(request);
  };
}

}  // namespace

void Container::Implementation::meet_others() {
  own_node_ = make_node(own_.state(), full_name(), [] {});
  auto offered = node_services::component_services(full_name(), *this);
  std::ranges::move(node_services::parameter_services(full_name(), *own_node_), std::back_inserter(offered));
  std::ranges::move(node_services::type_services(full_name()), std::back_inserter(offered));
  own_service_names_ = names_of(offered, options_.services);
  services_ = serve(std::move(offered), own_node_.get());
  tell_parameters(node_services::new_parameters(full_name(), own_.state().parameters(), clocks::system_ns()));
  tell_nodes();
}

std::vector<std::unique_ptr<BridgeService>> Container::Implementation::serve(
    std::vector<node_services::OfferedService> offered, const void* owner) {
  std::vector<std::unique_ptr<BridgeService>> services;
  if (options_.services == ServiceAccess::kOff) return services;
  for (auto& service : offered) {
    auto guard = node_services::guard_of(service, options_.services);
    // If it is of another node of that name, that one answers in this process.
    host_.services.add(service.description, owner, host_.requests.serve(owner, guarded(service.handler, guard)));
    if (bus_.bridge())
      services.push_back(bus_.bridge()->serve(service.description, std::move(service.handler), std::move(guard)));
  }
  return services;
}

std::unique_ptr<node_services::ComponentNode> Container::Implementation::make_node(Context::State& state,
                                                                                   const std::string& full_name,
                                                                                   std::function<void()> shut_down) {
  const auto parameters_set = [this, &state, full_name](const WrittenValues& set) {
    tell_parameters(node_services::changed_parameters(full_name, state.parameters(), set, clocks::system_ns()));
    if (set.contains(std::string(NodeParameters::kUseSimTime))) tell_nodes();
  };
  return std::make_unique<node_services::ComponentNode>(state, std::move(shut_down), parameters_set);
}

std::vector<node_services::OfferedService> Container::Implementation::services_of(const LoadedComponent& entry) {
  auto services = node_services::parameter_services(entry.full_name(), *entry.node);
  const auto tell = [events = entry.transition_events](const lifecycle_msgs::msg::TransitionEvent& event) {
    events->publish(std::make_shared<const lifecycle_msgs::msg::TransitionEvent>(event));
  };
  std::ranges::move(node_services::lifecycle_services(entry.full_name(), *entry.node, tell),
                    std::back_inserter(services));
  std::ranges::move(node_services::type_services(entry.full_name()), std::back_inserter(services));
  return services;
}

void Container::Implementation::offer_services(LoadedComponent& entry) {
  Context::State& state = entry.context->state();
  entry.node = make_node(state, entry.full_name(), [this, id = entry.recipe.id] {
    const std::lock_guard lock(housekeeping_mutex_);
    to_finalize_.push_back(id);
  });
  entry.services = serve(services_of(entry), entry.node.get());
  // Services of the component itself are not guarded: "services" covers only the standard ones.
  if (!bus_.bridge()) return;
  for (const auto& [description, serve_here] : state.services)
    entry.services.push_back(bus_.bridge()->serve(description, handler_of(serve_here)));
}

void Container::Implementation::tell_parameters(rcl_interfaces::msg::ParameterEvent event) {
  parameter_events_->publish(std::make_shared<const rcl_interfaces::msg::ParameterEvent>(std::move(event)));
}

/// Announces the nodes of this process and their endpoints through the bridge.
void Container::Implementation::tell_nodes() {
  if (!has_services()) return;
  const auto channels = bus_.channels();
  std::vector<NodeDescription> nodes{{options_.name_space, options_.name, {}, {}, own_service_names_}};
  const auto add_topics = [&](NodeDescription& node, const std::string& owner_name, const void* reader) {
    for (const Channel* channel : channels) {
      if (channel->is_published_by(owner_name)) node.publishes.push_back(channel->topic().name);
      if (channel->is_read_by(reader)) node.subscribes.push_back(channel->topic().name);
    }
  };
  const std::lock_guard lock(entries_mutex_);
  add_topics(nodes.front(), own_.name(), &own_.state());
  if (own_.state().follows_clock()) nodes.front().subscribes.emplace_back(topics::kClock.name);
  if (clock_) nodes.front().publishes.emplace_back(topics::kClock.name);
  for (const auto& entry : entries_) {
    Context::State& state = entry->context->state();
    NodeDescription node{state.description.name_space, state.description.name, {}, {}, {}};
    add_topics(node, state.description.name, &state);
    // All nodes of the process share the writers of these topics.
    node.publishes.emplace_back(topics::kRosout.name);
    node.publishes.emplace_back(node_services::kParameterEvents.name);
    if (state.follows_clock()) node.subscribes.emplace_back(topics::kClock.name);
    node.serves = names_of(services_of(*entry), options_.services);
    for (const auto& [service, serve_here] : state.services) node.serves.push_back(service.name);
    nodes.push_back(std::move(node));
  }
  told_channels_ = channels.size();
  host_.nodes.set(nodes);
  if (bus_.bridge()) bus_.bridge()->set_nodes(std::move(nodes));
}

}  // namespace panvo::runtime
