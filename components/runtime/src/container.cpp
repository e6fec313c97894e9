// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/container.hpp"

#include <fmt/format.h>

#include <chrono>
#include <random>
#include <thread>

#include "container_implementation.hpp"
#include "panvo/runtime/errors.hpp"

namespace panvo::runtime {

std::string new_run_id() {
  std::random_device random;
  const auto first = random(), second = random(), third = random(), fourth = random();
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", first, second, third, fourth);
}

Container::Container(ContainerOptions options)
    : implementation_(std::make_unique<Implementation>(std::move(options))) {}
Container::~Container() = default;

void Container::load(const ComponentDescription& description) { implementation_->load(description, false); }

void Container::add(const ComponentDescription& description, const Factory& factory) {
  implementation_->add({.description = description, .library = nullptr, .create = [factory](Context& context) {
                          return std::unique_ptr<Component, void (*)(Component*)>(
                              factory(context).release(), [](Component* component) { delete component; });
                        }});
}

void Container::load_all(const std::vector<ComponentDescription>& descriptions) {
  std::vector<std::string> problems;
  for (const auto& description : descriptions) {
    try {
      load(description);
    } catch (const ConfigError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (problems.empty()) problems = implementation_->parameters_of_no_node();
  if (!problems.empty()) throw ConfigError(std::move(problems));
}

bool Container::unload(const std::string& name) { return implementation_->unload(name); }

std::vector<std::string> Container::components() const {
  std::vector<std::string> names;
  implementation_->for_each([&](const std::string& name, const Context::State&) { names.push_back(name); });
  return names;
}

void Container::start() { implementation_->start(); }
std::vector<std::string> Container::run() { return implementation_->run(); }
void Container::run_until_quiet() { implementation_->run_until_quiet(); }
void Container::request_stop() noexcept { implementation_->request_stop(); }
bool Container::was_interrupted() const { return implementation_->was_interrupted(); }
std::uint64_t Container::source_steps() const { return implementation_->source_steps(); }

void Container::observe(std::function<bool(const TopicDescription&)> wanted,
                        std::function<void(const TopicDescription&, const SamplePtr&)> observer) {
  implementation_->bus().observe(std::move(wanted), std::move(observer));
}

Container::Links Container::links() const {
  Links links;
  for (const Channel* channel : implementation_->bus().channels()) {
    if (channel->has_publisher_other_than(nullptr)) links.published.push_back(channel->topic().name);
    if (channel->has_readers()) links.subscribed.push_back(channel->topic().name);
  }
  implementation_->for_each([&](const std::string&, const Context::State& state) {
    links.has_source |= state.source != nullptr;
    links.reads_all |= state.taps;
  });
  return links;
}

bool Container::wait_for_peers(const std::map<std::string, Peers>& peers, std::chrono::milliseconds limit) {
  const auto give_up = std::chrono::steady_clock::now() + limit;
  const auto all_there = [&] {
    for (const Channel* channel : implementation_->bus().channels()) {
      const auto wanted = peers.find(channel->topic().name);
      if (wanted == peers.end()) continue;
      const auto there = channel->counters();
      if (there.remote_readers < wanted->second.readers || there.remote_writers < wanted->second.writers) return false;
    }
    return true;
  };
  while (!all_there()) {
    if (std::chrono::steady_clock::now() >= give_up) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

void Container::on_progress(std::function<void(Source::Progress)> callback) {
  implementation_->on_progress = std::move(callback);
}

std::vector<QueueCounters> Container::queue_counters() const {
  std::vector<QueueCounters> all;
  implementation_->for_each([&](const std::string& name, const Context::State& state) {
    for (const auto& worker : state.workers) {
      for (const auto& port : worker->counters())
        all.push_back({name, port.input, port.received, port.handled, port.dropped, port.waiting});
    }
  });
  return all;
}

ComponentTimes Container::stage_times() const {
  ComponentTimes all;
  implementation_->for_each(
      [&](const std::string& name, const Context::State& state) { all[name] = state.times.snapshot(); });
  return all;
}

std::map<std::string, std::map<std::string, std::string>> Container::changed_parameters() const {
  std::map<std::string, std::map<std::string, std::string>> all;
  implementation_->for_each([&](const std::string& name, const Context::State& state) {
    for (const auto& parameter : state.parameters()) {
      if (parameter.value != parameter.default_value) all[name][parameter.name] = parameter.value;
    }
  });
  return all;
}

std::vector<ParameterDescription> Container::parameters_of(const std::string& component) const {
  std::vector<ParameterDescription> parameters;
  implementation_->for_each([&](const std::string& name, const Context::State& state) {
    if (name == component) parameters = state.parameters();
  });
  return parameters;
}

}  // namespace panvo::runtime
