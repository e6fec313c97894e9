// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "clocks.hpp"
#include "config/suggestion.hpp"
#include "container_implementation.hpp"
#include "node_services/parameter_events.hpp"
#include "panvo/interfaces/node_topics.hpp"
#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/graph.hpp"
#include "panvo/runtime/problems.hpp"

namespace panvo::runtime {
namespace {

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
            options_.clock ? options_.clock : std::function<std::int64_t()>(clocks::elapsed_ns)),
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
            .run_id = options_.run_id.empty() && !options_.replay ? new_run_id() : options_.run_id,
            .files_below = options_.files_below,
            .failed = [this](const ComponentDescription& description) { component_failed(description); },
            .pacer = Pacer(options_.rate)},
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
  if (state.source && !host_.replay_order) host_.pacer.add(*state.source);
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

/// Values for several nodes whose parameter none of them has: problems, unless another container may have it.
std::vector<std::string> Container::Implementation::parameters_of_no_node() {
  struct Value {
    const WrittenValue* written;
    std::string name;
    bool is_known = false;
    std::set<std::string> known;  // to those for which it is
  };
  std::map<std::pair<std::string, std::string>, Value> values;  // by place and name
  const auto look = [&](const WrittenValues& written, const Context::State& state) {
    const auto parameters = state.parameters();
    for (const auto& [name, one] : written) {
      if (!one.is_for_several) continue;
      auto& value = values.try_emplace({one.where.to_string(), name}, Value{&one, name, false, {}}).first->second;
      value.is_known |= std::ranges::find(parameters, name, &ParameterDescription::name) != parameters.end();
      for (const auto& parameter : parameters) value.known.insert(parameter.name);
    }
  };
  look(options_.parameters, own_.state());
  for_each([&](const std::string&, const Context::State& state) { look(state.description.parameters, state); });
  Problems problems;
  for (const auto& [place, value] : values) {
    if (value.is_known) continue;
    problems.add(value.written->where, fmt::format("no node has a parameter \"{}\"{}", value.name,
                                                   suggestion(value.name, {value.known.begin(), value.known.end()})));
  }
  auto sorted = problems.sorted();
  if (!options_.is_part_of_system) return sorted;
  for (const auto& problem : sorted)
    log(LogLevel::kWarning, "container", problem + ", unless another container has it");
  return {};
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

void Container::Implementation::take_last() {
  std::unique_ptr<LoadedComponent> entry;
  const std::lock_guard lock(entries_mutex_);
  entry.swap(entries_.back());
  entries_.pop_back();
}

}  // namespace panvo::runtime
