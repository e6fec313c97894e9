// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "clocks.hpp"
#include "container_implementation.hpp"
#include "node_services/parameter_events.hpp"
#include "panvo/interfaces/node_topics.hpp"
#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/graph.hpp"

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

constexpr interfaces::Topic<lifecycle_msgs::msg::TransitionEvent> kTransitionEvents{"~/transition_event"};

template <class Message>
TopicDescription described_topic(const interfaces::Topic<Message>& topic) {
  const auto& type = interfaces::message_type<Message>();
  return {std::string(topic.name), std::string(type.name), topic.qos, &type};
}

void log_to_stderr(LogLevel level, const std::string& component, const std::string& text) {
  if (level >= LogLevel::kWarning) std::fprintf(stderr, "%s: %s\n", component.c_str(), text.c_str());
}

ComponentDescription own_description(const ContainerOptions& options) {
  ComponentDescription description;
  description.name = "container";
  description.parameters = options.parameters;
  return description;
}

}  // namespace

Container::Implementation::Implementation(ContainerOptions options)
    : options_(std::move(options)),
      sink_(options_.log ? options_.log : Logger::Write(log_to_stderr)),
      time_(options_.replay && !options_.clock ? PassingTime::Pace::kTasks : PassingTime::Pace::kClock,
            options_.clock ? options_.clock : std::function<std::int64_t()>(clocks::monotonic_ns)),
      replay_order_(time_),
      bus_(
          options_.dds && !options_.replay ? make_dds_bridge(*options_.dds) : nullptr,
          [this](const std::string& text) { log(LogLevel::kWarning, "container", text); },
          [this] { return time_.now_ns(); }, options_.limits),
      host_{.bus = bus_,
            .replay_order = options_.replay ? &replay_order_ : nullptr,
            .time = time_,
            .log = [this](LogLevel level, const std::string& component,
                          const std::string& text) { log(level, component, text); },
            .seed = options_.seed,
            .progressed = [this] { progressed(); },
            .again = options_.again,
            .files_below = options_.files_below,
            .failed = [this](const ComponentDescription& description) { component_failed(description); }},
      own_(std::make_unique<Context::State>(host_, own_description(options_), nullptr)),
      diagnostics_output_(own_.open_output(described_topic(topics::kDiagnostics))) {
  rosout_.open(own_.open_output(described_topic(topics::kRosout)));
  if (!has_services()) return;
  try {
    parameter_events_ = own_.open_output(described_topic(node_services::kParameterEvents));
    if (auto problems = own_problems(); !problems.empty()) throw ConfigError(std::move(problems));
    meet_others();
  } catch (...) {
    rosout_.close();  // it would outlive the bus
    throw;
  }
}

std::vector<std::string> Container::Implementation::own_problems() {
  auto problems = own_.state().reader.problems();
  std::ranges::move(own_.state().node.problems(), std::back_inserter(problems));
  return problems;
}

/// A replay has none, as its results must not depend on requests.
bool Container::Implementation::has_services() const { return bus_.bridge() || !options_.replay; }

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

Container::Implementation::~Implementation() {
  stop_housekeeping();  // which reads the counters of the services
  services_.clear();    // no loading or unloading from now on
  host_.withdraw(own_node_.get());
  rosout_.close();
  if (runner_) runner_->stop();
  while (!entries_.empty()) take_last();  // in reverse order of loading
}

void Container::Implementation::log(LogLevel level, const std::string& component, const std::string& text) {
  sink_(level, component, text);
  rosout_.publish(level, component, text, options_.replay ? current_stamp_ns() : clocks::system_ns());
}

std::string Container::Implementation::full_name() const {
  return runtime::full_name(options_.name_space, options_.name);
}

auto Container::Implementation::find(const std::string& name) -> Entries::iterator {
  return std::find_if(entries_.begin(), entries_.end(),
                      [&](const auto& entry) { return entry->context->name() == name; });
}

auto Container::Implementation::add(Recipe recipe) -> Loaded {
  const std::lock_guard change(change_mutex_);
  recipe.id = next_id_++;
  return put(std::move(recipe));
}

/// Requires change_mutex_.
auto Container::Implementation::put(Recipe recipe) -> Loaded {
  const ComponentDescription& description = recipe.description;
  if (bus_.bridge() && runtime::full_name(description.name_space, description.name) == full_name()) {
    throw ConfigError(description.where.to_string() + ": " + full_name() +
                      " is the container's name; give the component another");
  }
  if (find(description.name) != entries_.end()) {
    throw ConfigError(description.where.to_string() + ": there already is a component " + description.name +
                      "; give this one another name");
  }
  auto entry = std::make_unique<LoadedComponent>();
  entry->recipe = std::move(recipe);
  make(*entry);
  Context::State& state = entry->context->state();
  if (started_) state.start();
  const Loaded loaded{entry->recipe.id, entry->full_name()};
  if (has_services()) {
    offer_services(*entry);
    tell_parameters(node_services::new_parameters(loaded.full_name, state.parameters(), clocks::system_ns()));
  }
  {
    const std::lock_guard lock(entries_mutex_);
    entries_.push_back(std::move(entry));
  }
  tell_nodes();
  return loaded;
}

/// Throws ConfigError with all problems.
void Container::Implementation::make(LoadedComponent& entry) {
  const ComponentDescription& description = entry.recipe.description;
  entry.context = std::make_unique<Context>(std::make_unique<Context::State>(host_, description, entry.recipe.library));
  Context::State& state = entry.context->state();
  state.restarts = entry.recipe.restarted;
  if (has_services() && options_.services != ServiceAccess::kOff)
    entry.transition_events = entry.context->open_output(described_topic(kTransitionEvents));
  if (entry.recipe.by_request) state.reader.confine_paths(options_.files_below);
  std::vector<std::string> problems;
  try {
    entry.component = entry.recipe.create(*entry.context);
  } catch (const ConfigError& error) {
    problems = error.problems();
  } catch (const std::exception& error) {
    problems.push_back(description.name + " could not be created: " + error.what());
  }
  const auto append = [&](const std::vector<std::string>& more) {
    problems.insert(problems.end(), more.begin(), more.end());
  };
  append(state.reader.problems());
  append(state.node.problems());
  append(state.problems);
  if (state.source && running_) {
    problems.push_back(description.name + " plays recorded data and must be loaded before the run starts");
  }
  if (!problems.empty()) throw ConfigError(std::move(problems));
}

auto Container::Implementation::load(const ComponentDescription& description, bool by_request) -> Loaded {
  const std::string where = description.where.file.empty() ? "" : description.where.to_string() + ": ";
  try {
    const auto library = std::make_shared<Library>(find_plugin(description.package));
    const ComponentDescriptor* descriptor = library->find(description.plugin);
    if (!descriptor) {
      std::string known;
      for (const auto* component : library->components())
        known += (known.empty() ? "" : ", ") + std::string(component->class_name);
      throw ConfigError(library->file().string() + " has no component " + description.plugin + "; it has " + known);
    }
    return add({.description = description,
                .library = library,
                .create =
                    [descriptor](Context& context) {
                      return std::unique_ptr<Component, void (*)(Component*)>(descriptor->create(context),
                                                                              descriptor->destroy);
                    },
                .by_request = by_request});
  } catch (const ConfigError& error) {
    std::vector<std::string> problems;
    for (const auto& problem : error.problems()) {
      problems.push_back(problem.starts_with(description.where.file) && !where.empty() ? problem : where + problem);
    }
    throw ConfigError(std::move(problems));
  }
}

bool Container::Implementation::unload(const std::string& name) {
  return unload_if([&](const LoadedComponent& entry) { return entry.context->name() == name; });
}

bool Container::Implementation::unload_if(const std::function<bool(const LoadedComponent&)>& is_it) {
  const std::lock_guard change(change_mutex_);
  std::unique_ptr<LoadedComponent> entry;
  {
    const std::lock_guard lock(entries_mutex_);
    const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const auto& there) { return is_it(*there); });
    if (found == entries_.end()) return false;
    if ((*found)->context->state().source && running_)
      throw ConfigError((*found)->context->name() + " plays recorded data and cannot be unloaded during the run");
    entry = std::move(*found);
    entries_.erase(found);
  }
  entry.reset();
  tell_nodes();
  return true;
}

/// Refused until the container's own components are loaded, as a request must not take their names.
auto Container::Implementation::load_component(const ComponentDescription& description) -> Loaded {
  if (!started_) throw ConfigError(full_name() + " is still loading its initial components; try again");
  return load(description, true);
}

void Container::Implementation::unload_component(std::uint64_t id) {
  if (unload_if([id](const LoadedComponent& entry) { return entry.recipe.id == id; })) return;
  throw ConfigError(fmt::format("there is no component with id {}; list_nodes shows the loaded ones", id));
}

auto Container::Implementation::loaded_components() const -> std::vector<Loaded> {
  const std::lock_guard lock(entries_mutex_);
  std::vector<Loaded> loaded;
  for (const auto& entry : entries_) loaded.push_back({entry->recipe.id, entry->full_name()});
  return loaded;
}

std::vector<std::unique_ptr<BridgeService>> Container::Implementation::serve(
    std::vector<node_services::OfferedService> offered, const void* owner) {
  std::vector<std::unique_ptr<BridgeService>> services;
  if (options_.services == ServiceAccess::kOff) return services;
  for (auto& service : offered) {
    auto guard = node_services::guard_of(service, options_.services);
    try {
      host_.services.add(service.description, owner, host_.requests.serve(owner, guarded(service.handler, guard)));
    } catch (const ConfigError&) {  // of another node of that name, which then answers in this process
    }
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

void Container::Implementation::take_last() {
  std::unique_ptr<LoadedComponent> entry;
  const std::lock_guard lock(entries_mutex_);
  entry.swap(entries_.back());
  entries_.pop_back();
}

}  // namespace panvo::runtime
