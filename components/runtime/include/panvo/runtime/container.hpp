// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "panvo/runtime/component.hpp"
#include "panvo/runtime/stage_times.hpp"
#include "panvo/runtime/system_file.hpp"

namespace panvo::runtime {

struct ContainerOptions {
  bool replay = false;  ///< deterministic: one thread, stamp order, no bridge, no wall clock
  double rate =
      0;  ///< playback rate, live: 1 as recorded, 2 twice as fast; 0: as fast as the components allow, without drops
  std::uint64_t seed = 1;            ///< for all random numbers
  std::optional<DdsSettings> dds{};  ///< absent: no DDS
  Limits limits{};                   ///< for messages of sources and other processes
  Logger::Write log{};               ///< absent: stderr
  /// Clock without a source, ns. Absent: the monotonic clock (live), or the stamps of the handled messages (replay).
  std::function<std::int64_t()> clock{};
  bool again = false;  ///< this process replaces one that crashed
  /// The same for all processes of a run, and for those that replace them. Empty: a new one (live), or none (replay).
  std::string run_id{};
  /// Name and namespace of the container's ROS 2 node; must differ from those of all components.
  std::string name = "container";
  std::string name_space = "/";
  WrittenValues parameters{};  ///< of that node: use_sim_time, qos_overrides
  /// Other containers belong to the system, and may have the parameters that no component here has.
  bool is_part_of_system = false;
  ServiceAccess services = ServiceAccess::kByHost;
  std::filesystem::path files_below{};  ///< folder for files named by service requests; empty: none allowed
};

/// A random one. Not for a replay, which gives the same results each time.
std::string new_run_id();

/// Message counts of one input of a component.
struct QueueCounters {
  std::string component;
  std::string input;  ///< resolved topic name
  std::uint64_t received = 0, handled = 0, dropped = 0;
  std::size_t waiting = 0;  ///< in the queue now, without the message that is being handled
};

/// Runs the components of one process. With a bridge, other processes see each component as a ROS 2 node with services
/// for parameters and states, and the container as a node with services to load and unload components. Loading,
/// unloading, request_stop() and queue_counters() are thread-safe; call the other methods from one thread.
class Container {
 public:
  explicit Container(ContainerOptions options);
  ~Container();
  Container(const Container&) = delete;
  Container& operator=(const Container&) = delete;

  /// Loads a component from its plugin. Throws ConfigError with all problems; the container is then unchanged.
  void load(const ComponentDescription& description);

  using Factory = std::function<std::unique_ptr<Component>(Context&)>;
  /// Adds a component that is linked into the executable. Throws like load().
  void add(const ComponentDescription& description, const Factory& factory);

  /// Loads all components, then throws one ConfigError with all problems, if any. A value for several nodes whose
  /// parameter none of them has is a problem, too, or a warning if the container is a part of a system.
  void load_all(const std::vector<ComponentDescription>& descriptions);

  /// Destroys a component and releases its plugin. Returns false if there is no such component. Throws ConfigError if
  /// it is a source and run() is active.
  bool unload(const std::string& name);
  std::vector<std::string> components() const;

  /// Starts the components' threads. Components loaded later start immediately. Called by run().
  void start();

  /// Runs until all sources have ended and all messages are handled, or until request_stop(). Live without a source:
  /// until request_stop(). Returns the problems; empty on success.
  std::vector<std::string> run();

  /// Replay: handles all queued messages and everything they trigger.
  void run_until_quiet();

  /// Whether run() was stopped before all sources had ended.
  bool was_interrupted() const;

  /// Makes run() return soon. Callable from any thread.
  void request_stop() noexcept;

  /// Calls `observer` for each message published on topics that `wanted` accepts, on the publisher's thread. For result
  /// files and tests.
  void observe(std::function<bool(const TopicDescription&)> wanted,
               std::function<void(const TopicDescription&, const SamplePtr&)> observer);

  /// Topics that connect this container with others: resolved names, sorted.
  struct Links {
    std::vector<std::string> published, subscribed;
    bool has_source = false;
    bool reads_all = false;  ///< reads all topics, including later ones (a recorder)
  };
  Links links() const;
  /// Required number of readers and writers of a topic in other processes.
  struct Peers {
    std::size_t readers = 0, writers = 0;
  };
  /// Waits until the topics have the required peers; false if `limit` has passed. Needed before the first message: a
  /// best-effort reader misses messages that are sent before it has discovered the writer.
  bool wait_for_peers(const std::map<std::string, Peers>& peers, std::chrono::milliseconds limit);

  /// Called about 4 times a second while sources run.
  void on_progress(std::function<void(Source::Progress)> callback);

  std::vector<QueueCounters> queue_counters() const;
  ComponentTimes stage_times() const;
  /// Parameters that differ from their defaults, by component.
  std::map<std::string, std::map<std::string, std::string>> changed_parameters() const;
  /// All parameters that a component declares.
  std::vector<ParameterDescription> parameters_of(const std::string& component) const;
  std::uint64_t source_steps() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace panvo::runtime
