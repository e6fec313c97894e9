// SPDX-License-Identifier: Apache-2.0
// Restarting of components that throw in a live run.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "clocks.hpp"
#include "container_implementation.hpp"
#include "panvo/runtime/errors.hpp"

namespace panvo::runtime {
namespace {

std::string name_of(const Recipe& recipe) { return recipe.description.name; }

/// Whether a failure is followed by a restart. A source has lost its position. A recorder (`taps`) has lost messages: the
/// run reports that, and a new one might replace the bag.
bool is_restartable(const Context::State& state) {
  return state.description.on_error == OnError::kRestart && !state.finalized && !state.source && !state.taps;
}

}  // namespace

void Container::Implementation::component_failed(const ComponentDescription& description) {
  if (description.on_error != OnError::kStop) return;
  log(LogLevel::kError, "container", description.name + " failed: stopping the container (on_error: stop)");
  request_stop();
}

void Container::Implementation::restart_failed() {
  const std::lock_guard change(change_mutex_);
  const std::int64_t now_ns = clocks::monotonic_ns();
  const auto is_due = [now_ns](const Recipe& recipe) { return recipe.restart_ns && *recipe.restart_ns <= now_ns; };
  std::vector<Recipe> due;
  for (auto& entry : take_failed(now_ns)) {
    due.push_back(entry->recipe);
    entry.reset();
  }
  for (const auto& recipe : unmade_) {
    if (is_due(recipe)) due.push_back(recipe);
  }
  std::erase_if(unmade_, is_due);
  for (auto& recipe : due) make_anew(std::move(recipe), now_ns);
  if (!due.empty()) tell_nodes();
}

/// Returns the components due for a restart; plans restarts, and trusts files that have been read without a failure.
auto Container::Implementation::take_failed(std::int64_t now_ns) -> Entries {
  Entries due;
  const std::lock_guard lock(entries_mutex_);
  for (auto& entry : entries_) {
    auto& state = entry->context->state();
    state.trust_files(now_ns);
    if (!state.failed() || !is_restartable(state)) continue;
    auto& recipe = entry->recipe;
    if (!recipe.restart_ns && !recipe.given_up) plan_restart(recipe, now_ns);
    if (recipe.restart_ns && *recipe.restart_ns <= now_ns) due.push_back(std::move(entry));
  }
  std::erase(entries_, nullptr);
  return due;
}

/// Whether all components have failed for good. False during a change: a component that is being restarted is in
/// neither list.
bool Container::Implementation::are_all_lost() {
  const std::unique_lock change(change_mutex_, std::try_to_lock);
  if (!change || (entries_.empty() && unmade_.empty())) return false;
  return std::ranges::all_of(unmade_, &Recipe::given_up) && std::ranges::all_of(entries_, [](const auto& entry) {
           const auto& state = entry->context->state();
           return state.failed() && (entry->recipe.given_up || !is_restartable(state));
         });
}

void Container::Implementation::plan_restart(Recipe& recipe, std::int64_t now_ns) {
  recipe.restart_ns = recipe.restarts.failed(now_ns);
  recipe.given_up = !recipe.restart_ns;
  if (recipe.given_up) {
    log(LogLevel::kError, name_of(recipe),
        fmt::format("failed {} times within {} s and stays stopped; any others continue",
                    RestartPlan::kMaxWithinWindow + 1, RestartPlan::kWindow_ns / 1'000'000'000));
  } else {
    log(LogLevel::kWarning, name_of(recipe),
        fmt::format("restarting in {:.1f} s", static_cast<double>(*recipe.restart_ns - now_ns) * 1e-9));
  }
}

void Container::Implementation::make_anew(Recipe recipe, std::int64_t now_ns) {
  recipe.restart_ns.reset();
  ++recipe.restarted;
  std::vector<std::string> problems;
  try {
    put(recipe);
    return log(LogLevel::kInfo, name_of(recipe), "restarted");
  } catch (const ConfigError& error) {
    problems = error.problems();
  } catch (const std::exception& error) {  // e.g. the system has no thread for it
    problems.emplace_back(error.what());
  }
  for (const auto& problem : problems) log(LogLevel::kError, name_of(recipe), "could not be restarted: " + problem);
  plan_restart(recipe, now_ns);
  unmade_.push_back(std::move(recipe));
}

}  // namespace panvo::runtime
