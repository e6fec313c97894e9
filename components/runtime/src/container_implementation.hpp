// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "diagnostics.hpp"
#include "loaded_component.hpp"
#include "node_services/controlled.hpp"
#include "panvo/runtime/container.hpp"
#include "played_clock.hpp"
#include "process_use.hpp"
#include "rcl_interfaces/msg/ParameterEvent.h"
#include "rosout.hpp"
#include "service_totals.hpp"
#include "source_runner.hpp"

namespace panvo::runtime {

/// container_components.cpp: loading, unloading and announcing components. container_run.cpp: replay and live runs.
/// container_housekeeping.cpp: periodic tasks. container_restarts.cpp: failed components.
class Container::Implementation final : public node_services::ControlledContainer {
 public:
  explicit Implementation(ContainerOptions options);
  ~Implementation() override;

  void log(LogLevel level, const std::string& component, const std::string& text);

  Loaded add(Recipe recipe);
  Loaded load(const ComponentDescription& description, bool by_request);
  bool unload(const std::string& name);
  std::vector<std::string> parameters_of_no_node();
  Loaded load_component(const ComponentDescription& description) override;
  void unload_component(std::uint64_t id) override;
  std::vector<Loaded> loaded_components() const override;

  void start();
  std::vector<std::string> run();
  void run_until_quiet();
  void request_stop() noexcept;

  /// Calls `say` for each component; none is loaded or unloaded meanwhile.
  template <class Say>
  void for_each(const Say& say) const {
    const std::lock_guard lock(entries_mutex_);
    for (const auto& entry : entries_) say(entry->context->name(), entry->context->state());
  }
  Bus& bus() { return bus_; }
  std::uint64_t source_steps() const { return source_steps_; }
  bool was_interrupted() const { return was_interrupted_; }

  std::function<void(Source::Progress)> on_progress = [](Source::Progress) {};

 private:
  using Entries = std::vector<std::unique_ptr<LoadedComponent>>;

  std::string full_name() const;
  bool has_services() const;
  void meet_others();
  Loaded put(Recipe recipe);
  void make(LoadedComponent& entry);
  Entries::iterator find(const std::string& name);
  bool unload_if(const std::function<bool(const LoadedComponent&)>& is_it);
  void take_last();
  std::vector<std::unique_ptr<BridgeService>> serve(std::vector<node_services::OfferedService> offered,
                                                    const void* owner);
  std::vector<std::string> own_problems();
  std::unique_ptr<node_services::ComponentNode> make_node(Context::State& state, const std::string& full_name,
                                                          std::function<void()> shut_down);
  static std::vector<node_services::OfferedService> services_of(const LoadedComponent& entry);
  void offer_services(LoadedComponent& entry);
  void tell_parameters(rcl_interfaces::msg::ParameterEvent event);
  void tell_nodes();

  void progressed();
  void replay(const std::vector<Source*>& sources);
  void run_live(const std::vector<Source*>& sources);
  void open_clock();
  void drain(std::chrono::seconds patience);
  bool queues_are_empty();
  void fail_source(const std::string& what);
  void publish_what_waits();
  std::vector<std::string> end_components();
  void end(Context::State& state);
  void finalize(std::uint64_t id);

  void component_failed(const ComponentDescription& description);
  void restart_failed();
  bool are_all_lost();
  Entries take_failed(std::int64_t now_ns);
  void plan_restart(Recipe& recipe, std::int64_t now_ns);
  void make_anew(Recipe recipe, std::int64_t now_ns);

  void keep_house();
  void publish_diagnostics(double interval_s);
  void stop_housekeeping();

  const ContainerOptions options_;
  const Logger::Write sink_;
  Rosout rosout_;  // before the bus, whose constructor may log a warning
  PassingTime time_;
  ReplayOrder replay_order_;
  Bus bus_;
  Host host_;
  std::unique_ptr<SourceRunner> runner_;  // outlives the workers, which wake it
  std::atomic<SourceRunner*> active_runner_ = nullptr;
  Context own_;  // the container's own outputs
  std::shared_ptr<UntypedOutput> diagnostics_output_;
  std::shared_ptr<UntypedOutput> parameter_events_;  // nullptr in a replay
  Diagnostics diagnostics_;
  ProcessUse process_use_;
  ServiceTotals service_totals_;
  std::unique_ptr<PlayedClock> clock_;  // nullptr: no /clock

  std::mutex change_mutex_;           // serialises loading and unloading; also guards unmade_
  mutable std::mutex entries_mutex_;  // guards entries_ and the lifetime of its elements
  Entries entries_;
  std::vector<Recipe> unmade_;             // failed and could not be restarted
  std::vector<std::string> end_problems_;  // of components; guarded by change_mutex_
  std::uint64_t next_id_ = 1;
  std::atomic<bool> started_ = false;
  std::atomic<bool> running_ = false;
  std::atomic<std::size_t> told_channels_ = 0;

  std::atomic<bool> stop_requested_ = false;
  std::mutex stop_mutex_;
  std::condition_variable stop_changed_;
  std::vector<std::string> source_problems_;
  std::uint64_t source_steps_ = 0;
  bool was_interrupted_ = false;

  std::mutex housekeeping_mutex_;
  std::condition_variable housekeeping_changed_;
  bool housekeeping_ended_ = false;
  std::vector<std::uint64_t> to_finalize_;
  std::thread housekeeping_;

  std::unique_ptr<node_services::ComponentNode> own_node_;
  std::vector<std::string> own_service_names_;
  std::vector<std::unique_ptr<BridgeService>> services_;  // last: the services use the members above
};

}  // namespace panvo::runtime
