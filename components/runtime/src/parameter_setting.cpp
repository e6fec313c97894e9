// SPDX-License-Identifier: Apache-2.0
// Setting parameters of a running component.
#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <iterator>
#include <optional>

#include "config/paths_below.hpp"
#include "config/suggestion.hpp"
#include "context_state.hpp"
#include "panvo/runtime/errors.hpp"

namespace panvo::runtime {
namespace {

// After this time the request fails and the caller may retry.
constexpr std::chrono::seconds kLimit{5};

/// Result of a call on the component's thread.
struct Outcome {
  std::mutex mutex;
  std::condition_variable changed;
  bool done = false;
  bool given_up = false;
  std::vector<std::string> problems;
};

std::vector<ParameterDescription>::const_iterator find_parameter(const std::vector<ParameterDescription>& parameters,
                                                                 const std::string& name) {
  return std::ranges::find(parameters, name, &ParameterDescription::name);
}

/// Problems that do not depend on the values' contents.
std::vector<std::string> not_settable(const std::vector<ParameterDescription>& known, const WrittenValues& wanted,
                                      const std::filesystem::path& files_below) {
  std::vector<std::string> names, problems;
  for (const auto& parameter : known) names.push_back(parameter.name);
  for (const auto& [name, value] : wanted) {
    const auto parameter = find_parameter(known, name);
    if (parameter == known.end()) {
      problems.push_back("there is no parameter \"" + name + "\"" + suggestion(name, names));
    } else if (!parameter->settable) {
      problems.push_back(name +
                         " is read-only at run time: reload the component with the new value, or set it in the system "
                         "file");
    } else if (parameter->is_path && !value.items.empty()) {
      if (const auto wrong = path_problem(value.items.front(), files_below)) problems.push_back(name + " " + *wrong);
    }
  }
  return problems;
}

void run(const std::vector<std::function<void()>>& calls, Outcome& outcome) {
  try {
    for (const auto& call : calls) call();
  } catch (const ConfigError& error) {
    outcome.problems = error.problems();
  } catch (...) {
    outcome.problems = {"the component was stopped by an error, see its log"};
    outcome.done = true;
    outcome.changed.notify_all();
    throw;  // handled like that of any other callback
  }
  outcome.done = true;
  outcome.changed.notify_all();
}

}  // namespace

std::vector<ParameterDescription> Context::State::own_parameters() const {
  std::vector<ParameterDescription> parameters = reader.declared();
  ParameterReader settable(description.name, {});
  for (const auto& take : parameter_takers) take(settable);
  const std::lock_guard lock(parameters_mutex_);
  for (auto& parameter : parameters) {
    if (const auto set = find_parameter(set_, parameter.name); set != set_.end()) parameter = *set;
    parameter.settable = find_parameter(settable.declared(), parameter.name) != settable.declared().end();
  }
  return parameters;
}

std::vector<ParameterDescription> Context::State::parameters() const {
  auto parameters = own_parameters();
  std::ranges::move(node.declared(), std::back_inserter(parameters));
  return parameters;
}

std::vector<std::string> Context::State::set_parameters(const WrittenValues& wanted) {
  const std::lock_guard one_at_a_time(setting_mutex_);
  if (auto wrong = not_settable(parameters(), wanted, host.files_below); !wrong.empty()) return wrong;
  const auto own = node.others(wanted);
  const auto sim_time = node.wanted_sim_time(wanted);
  if (const auto* problem = std::get_if<std::string>(&sim_time)) return {*problem};
  if (!own.empty()) {
    if (auto wrong = set_own_parameters(own); !wrong.empty()) return wrong;
  }
  if (const auto* follow = std::get_if<bool>(&sim_time)) {
    try {
      follow_clock(*follow);
    } catch (const ConfigError& error) {  // such as missing rights
      return error.problems();
    }
    node.use_sim_time(*follow);
  }
  return {};
}

std::vector<std::string> Context::State::set_own_parameters(const WrittenValues& wanted) {
  WrittenValues values = wanted;
  for (const auto& parameter : own_parameters()) {
    if (parameter.settable) values.try_emplace(parameter.name, parameter.written);
  }
  ParameterReader trial(description.name, values);
  std::vector<std::function<void()>> calls;
  for (const auto& take : parameter_takers) calls.push_back(take(trial));
  if (auto wrong = trial.problems(); !wrong.empty()) return wrong;
  if (auto wrong = hand_over(std::move(calls)); !wrong.empty()) return wrong;
  const std::lock_guard lock(parameters_mutex_);
  set_ = trial.declared();
  return {};
}

std::vector<std::string> Context::State::hand_over(std::vector<std::function<void()>> calls) {
  const auto outcome = std::make_shared<Outcome>();
  if (host.replay_order) {  // this is the only thread
    run(calls, *outcome);
    return outcome->problems;
  }
  if (failed()) return {"the component was stopped by an error, see its log"};
  if (finalized) return {"the component is shut down"};
  std::function<void()> task = [outcome, calls = std::move(calls)] {
    const std::lock_guard lock(outcome->mutex);
    if (!outcome->given_up) run(calls, *outcome);
  };
  main_worker().push(*parameter_port, {.item = std::move(task)});
  std::unique_lock lock(outcome->mutex);
  if (outcome->changed.wait_for(lock, kLimit, [&] { return outcome->done; })) return outcome->problems;
  outcome->given_up = true;
  return {"the component is busy with one message and did not accept the values; try again"};
}

}  // namespace panvo::runtime
