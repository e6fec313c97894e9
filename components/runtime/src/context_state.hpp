// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "bus.hpp"
#include "panvo/runtime/context.hpp"
#include "panvo/runtime/system_file.hpp"
#include "passing_time.hpp"
#include "service_caller.hpp"
#include "service_directory.hpp"
#include "stamp_guard.hpp"
#include "worker.hpp"

namespace panvo::runtime {

/// What a container lends to the contexts of its components.
struct Host {
  Bus& bus;
  ReplayOrder* replay_order;  // nullptr live
  PassingTime& time;
  Logger::Write log;
  std::uint64_t seed;
  std::function<void()> progressed;
  bool again = false;  // in the place of a process that crashed
  std::atomic<std::int64_t> in_flight = 0;
  std::filesystem::path files_below{};  // where requests by service may name files; empty: nowhere
  std::function<void(const ComponentDescription&)> failed = [](const ComponentDescription&) {};
  ServiceDirectory services{};
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

  /// Whether a message's stamp can be of its time. One that cannot is counted, and told of now and then. From any thread.
  bool admits_stamp(const TopicDescription& topic, const Sample& sample);
  /// See Context::about_to_read.
  void begin_reading(const std::filesystem::path& file);
  /// To be called now and then: what was read long enough ago has done no harm.
  void trust_files(std::int64_t now_ns);
  /// "FILE was set aside as OTHER", of each that was.
  std::vector<std::string> files_set_aside() const;

  /// What is declared, with the values in force and whether they may be set.
  std::vector<ParameterDescription> parameters() const;
  /// All or none: returns what is wrong. From any thread; the component takes them on its own, between two messages.
  std::vector<std::string> set_parameters(const WrittenValues& wanted);

  Host& host;
  const ComponentDescription description;
  const std::shared_ptr<const void> library;
  ParameterReader reader;
  Logger logger;
  StageTimes times;
  Rejections rejections;
  StampGuard stamp_guard;
  std::vector<std::string> problems;             // of topics; those of parameters are the reader's
  std::vector<std::unique_ptr<Worker>> workers;  // the component's own, then its stages
  std::vector<Channel*> inputs;
  std::vector<std::pair<ServiceDescription, ServiceDirectory::Serve>> services;  // that the component offers
  std::vector<std::shared_ptr<ComponentCaller>> callers;                         // of those that it calls
  bool taps = false;
  bool gives_way = false;
  std::uint64_t restarts = 0;  // how often it was made anew
  Source* source = nullptr;
  std::function<void()> end;        // nullptr: nothing is to be finished
  std::atomic<bool> active = true;  // messages are handed to it

  /// Reads a parameter struct that the component takes while it runs; what is returned hands it over.
  using ParameterTaker = std::function<std::function<void()>(ParameterReader&)>;
  std::vector<ParameterTaker> parameter_takers;
  Port* parameter_port = nullptr;

 private:
  std::vector<std::string> hand_over(std::vector<std::function<void()>> calls);

  std::mutex setting_mutex_;               // one request at a time
  mutable std::mutex parameters_mutex_;    // guards set_
  std::vector<ParameterDescription> set_;  // since the component was made

  struct FileOnTrial {
    std::filesystem::path file;
    std::int64_t since_ns;
  };
  mutable std::mutex files_mutex_;  // guards the two below
  std::vector<FileOnTrial> files_on_trial_;
  std::vector<std::string> files_set_aside_;
};

}  // namespace panvo::runtime
