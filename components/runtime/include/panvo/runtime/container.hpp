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
#include "panvo/runtime/run_files.hpp"
#include "panvo/runtime/system_file.hpp"

namespace panvo::runtime {

struct ContainerOptions {
  bool replay = false;  ///< one thread, order of stamp, no bridge, no wall clock: the same result bit for bit
  double rate =
      0;  ///< of sources, live: 1 as recorded, 2 twice as fast; 0: as fast as the components here take it, none dropped
  std::uint64_t seed = 1;            ///< of all random numbers
  std::optional<DdsSettings> dds{};  ///< absent: the container keeps to itself
  Limits limits{};                   ///< of what sources and other processes send
  Logger::Write log{};               ///< absent: stderr
  /// What time passes by where nothing is played, ns; absent: live the monotonic clock, in replay the stamps of what is handled.
  std::function<std::int64_t()> clock{};
  bool again = false;  ///< this process takes the place of one that crashed
  /// Its own node's name and namespace as ROS 2 sees it; no component may have the same.
  std::string name = "container";
  std::string name_space = "/";
  ServiceAccess services = ServiceAccess::kByHost;
  std::filesystem::path files_below{};  ///< where requests by service may name files; empty: nowhere
};

/// One process's components, and what runs them. With a bridge, other processes see each component as a ROS 2 node, with services for its parameters
/// and states, and the container as one more, with services to load and unload. Loading and unloading may be done from any thread, and
/// request_stop(); the rest is for one.
class Container {
 public:
  explicit Container(ContainerOptions options);
  ~Container();
  Container(const Container&) = delete;
  Container& operator=(const Container&) = delete;

  /// Loads a component from its plugin. Throws ConfigError with every problem; the container is then as it was before.
  void load(const ComponentDescription& description);

  using Factory = std::function<std::unique_ptr<Component>(Context&)>;
  /// Adds a component that is linked in. Throws as load().
  void add(const ComponentDescription& description, const Factory& factory);

  /// Loads all, then throws one ConfigError with the problems of all, if there are any.
  void load_all(const std::vector<ComponentDescription>& descriptions);

  /// Ends a component and lets go of its plugin. False if there is none of that name. Throws ConfigError while it plays something in run().
  bool unload(const std::string& name);
  std::vector<std::string> components() const;

  /// Starts the components' threads; what is loaded later starts at once. run() and start() imply it.
  void start();

  /// Runs until every source is at its end and all is handled, or until request_stop(). Without a source live: until request_stop().
  /// Returns what went wrong, empty when all went well.
  std::vector<std::string> run();

  /// Replay: handles what is queued, and what comes of it, until all is quiet.
  void run_until_quiet();

  /// Whether run() was asked to stop while something was still to be played.
  bool was_interrupted() const;

  /// From any thread or a signal-handling one; run() then returns soon.
  void request_stop() noexcept;

  /// Sees every published message of the topics that `wanted` accepts, on the publisher's thread: for result files and tests.
  void observe(std::function<bool(const TopicDescription&)> wanted,
               std::function<void(const TopicDescription&, const SamplePtr&)> observer);

  /// The topics by which this container meets others, resolved and sorted.
  struct Links {
    std::vector<std::string> published, subscribed;
    bool has_source = false;
    bool reads_all = false;  ///< a recorder does: topics that it does not know yet
  };
  Links links() const;
  /// How many readers and writers in other processes a topic is to have.
  struct Peers {
    std::size_t readers = 0, writers = 0;
  };
  /// Waits until these topics have them; false when `limit` has passed. Both ends must know of each other before a first message is sent: what
  /// reaches a best-effort reader that does not know the writer yet is lost.
  bool wait_for_peers(const std::map<std::string, Peers>& peers, std::chrono::milliseconds limit);

  /// Called about 4 times a second while sources run.
  void on_progress(std::function<void(Source::Progress)> callback);

  std::vector<QueueCounters> queue_counters() const;
  ComponentTimes stage_times() const;
  /// Per component, the parameters that differ from their defaults.
  std::map<std::string, std::map<std::string, std::string>> changed_parameters() const;
  /// Every parameter a component declares.
  std::vector<ParameterDescription> parameters_of(const std::string& component) const;
  std::uint64_t source_steps() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace panvo::runtime
