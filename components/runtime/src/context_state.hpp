// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bus.hpp"
#include "panvo/runtime/context.hpp"
#include "panvo/runtime/system_file.hpp"
#include "worker.hpp"

namespace panvo::runtime {

/// What a container lends to the contexts of its components.
struct Host {
  Bus& bus;
  ReplayOrder* replay_order;  // nullptr live
  Logger::Write log;
  std::uint64_t seed;
  std::function<void()> progressed;
  std::atomic<std::int64_t> in_flight = 0;
};

/// The runtime's side of a Context: everything that a component holds of the container, and that goes when it is unloaded.
struct Context::State {
  State(Host& host, const ComponentDescription& description, std::shared_ptr<const void> library);

  Worker& main_worker() { return *workers.front(); }
  std::unique_ptr<Worker> make_worker(const std::string& worker_name);
  TopicDescription resolve(TopicDescription topic) const;

  void start();
  /// No callback runs any more when this has returned.
  void stop();
  bool failed() const;

  Host& host;
  const ComponentDescription description;
  const std::shared_ptr<const void> library;
  ParameterReader reader;
  Logger logger;
  StageTimes times;
  std::vector<std::string> problems;             // of topics; those of parameters are the reader's
  std::vector<std::unique_ptr<Worker>> workers;  // the component's own, then its stages
  std::vector<Channel*> inputs;
  bool taps = false;
  Source* source = nullptr;
};

}  // namespace panvo::runtime
