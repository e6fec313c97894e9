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
#include "config/node_parameters.hpp"
#include "node_list.hpp"
#include "pacer.hpp"
#include "panvo/runtime/context.hpp"
#include "panvo/runtime/system_file.hpp"
#include "passing_time.hpp"
#include "request_thread.hpp"
#include "service_caller.hpp"
#include "service_directory.hpp"
#include "stamp_guard.hpp"
#include "worker.hpp"

namespace panvo::runtime {

class StampGate;

/// Shared objects of a container that its components' contexts use.
struct Host {
  Bus& bus;
  ReplayOrder* replay_order;  // nullptr live
  PassingTime& time;
  Logger::Write log;
  std::uint64_t seed;
  std::function<void()> progressed;
  bool again = false;  // replaces a process that crashed
  const std::string run_id{};
  std::atomic<std::int64_t> in_flight = 0;
  std::filesystem::path files_below{};  // folder for files named by service requests; empty: none
  std::function<void(const ComponentDescription&)> failed = [](const ComponentDescription&) {};
  Pacer pacer{};
  ServiceDirectory services{};
  RequestThread requests{};  // after `services`, which use it no more once it ends
  NodeList nodes{};

  /// Ends the services of an owner; none of their requests is being answered once this has returned. nullptr: has none.
  void withdraw(const void* owner) {
    if (!owner) return;
    services.remove_of(owner);
    requests.remove_of(owner);
  }
};

/// Internals of a Context: everything a component holds of the container, released at unload.
struct Context::State {
  State(Host& host, const ComponentDescription& description, std::shared_ptr<const void> library);

  Worker& main_worker() { return *workers.front(); }
  std::unique_ptr<Worker> make_worker(const std::string& worker_name);
  TopicDescription resolve(TopicDescription topic) const;
  /// Passes the messages of a channel to an input while the component is active, unless their stamps are wrong.
  void open_reader(Channel& channel, const std::optional<interfaces::Qos>& qos,
                   std::function<void(const SamplePtr&)> take);

  void start();
  /// Whether the component receives messages from now on. None of before a pause is received after it.
  void set_active(bool is_active);
  /// No callback is running once this has returned.
  void stop();
  bool failed() const;

  /// See Context::about_to_read.
  void begin_reading(const std::filesystem::path& file);
  /// Call periodically: files that were read long enough ago without a failure are no longer on trial.
  void trust_files(std::int64_t now_ns);
  /// "FILE was set aside as OTHER" for each file set aside.
  std::vector<std::string> files_set_aside() const;

  /// Stamp of a timer's callback: the time of the clock, or of /clock with use_sim_time (0 before its first message).
  std::int64_t timer_stamp_ns() const;
  bool follows_clock() const { return follows_clock_; }

  /// Declared parameters with current values and whether they can be set.
  std::vector<ParameterDescription> parameters() const;
  /// Sets all values or none; returns the problems. Thread-safe; the component receives them on its own thread, between
  /// two messages.
  std::vector<std::string> set_parameters(const WrittenValues& wanted);

  Host& host;
  const ComponentDescription description;
  const std::shared_ptr<const void> library;
  NodeParameters node;
  ParameterReader reader;
  Logger logger;
  StageTimes times;
  RejectedMessages rejections;
  StampGuard stamp_guard;
  std::vector<std::string> problems;             // of topics; `reader` has those of parameters
  std::vector<std::unique_ptr<Worker>> workers;  // the component's own, then its stages
  std::vector<Channel*> inputs;
  std::vector<std::shared_ptr<StampGate>> gates;                                 // of the inputs
  std::vector<std::pair<ServiceDescription, ServiceDirectory::Serve>> services;  // offered by the component
  std::vector<std::shared_ptr<ComponentCaller>> callers;                         // called by the component
  bool taps = false;
  bool gives_way = false;
  std::uint64_t restarts = 0;  // number of restarts
  Source* source = nullptr;
  Port* last_port = nullptr;  // takes a task after all messages; nullptr: nothing is held back
  std::function<void()> end;  // nullptr: nothing to finish
  std::function<DiagnosticValues()> diagnose = [] { return DiagnosticValues{}; };
  std::atomic<bool> active = true;      // receives messages
  std::atomic<bool> finalized = false;  // shut down by a service request: never active again

  /// Reads a parameter struct that the component accepts at run time; the returned function passes it on.
  using ParameterTaker = std::function<std::function<void()>(ParameterReader&)>;
  std::vector<ParameterTaker> parameter_takers;
  Port* parameter_port = nullptr;

 private:
  std::vector<ParameterDescription> own_parameters() const;
  std::vector<std::string> set_own_parameters(const WrittenValues& wanted);
  std::vector<std::string> hand_over(std::vector<std::function<void()>> calls);
  /// Reads /clock, or no longer. No effect in replay.
  void follow_clock(bool follow);

  std::mutex setting_mutex_;               // one request at a time
  mutable std::mutex parameters_mutex_;    // guards set_
  std::vector<ParameterDescription> set_;  // set since construction
  std::atomic<bool> follows_clock_ = false;
  std::atomic<std::int64_t> clock_ns_ = 0;  // newest message of /clock

  struct FileOnTrial {
    std::filesystem::path file;
    std::int64_t since_ns;
  };
  mutable std::mutex files_mutex_;  // guards the two below
  std::vector<FileOnTrial> files_on_trial_;
  std::vector<std::string> files_set_aside_;
};

}  // namespace panvo::runtime
