// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <any>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "panvo/interfaces/service.hpp"
#include "panvo/interfaces/topic.hpp"
#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/client.hpp"
#include "panvo/runtime/compiled_type.hpp"
#include "panvo/runtime/logger.hpp"
#include "panvo/runtime/output.hpp"
#include "panvo/runtime/parameters.hpp"
#include "panvo/runtime/rejected_messages.hpp"
#include "panvo/runtime/sample.hpp"
#include "panvo/runtime/source.hpp"
#include "panvo/runtime/stage.hpp"
#include "panvo/runtime/stage_times.hpp"
#include "panvo/runtime/topic_access.hpp"

namespace panvo::runtime {

/// Names and values for /diagnostics.
using DiagnosticValues = std::vector<std::pair<std::string, std::string>>;

/// A component's access to its parameters, topics, log and time. The same component code runs live (own thread and
/// bounded queue) and in replay (one thread, messages in stamp order). Use it in the component's constructor; use time,
/// log and outputs also in the callbacks.
class Context {
 public:
  /// Name of the component in the system: "binocular_odometry".
  const std::string& name() const noexcept;

  /// Reads the parameters: defaults overridden by the configuration. For an invalid value the default is returned; once
  /// constructed, the component is rejected with all problems.
  template <class Parameters>
  Parameters parameters() {
    return parameter_reader().read<Parameters>();
  }

  /// Accepts new values of a parameter struct at run time. `callback(Parameters)` gets the complete struct, checked as
  /// at start-up, on the component's message thread, between two messages. A ConfigError thrown by it rejects the
  /// values. Without this, the parameters are read-only after construction.
  template <class Parameters, class Callback>
  void on_parameters(Callback callback) {
    take_parameters([callback = std::move(callback)](ParameterReader& reader) -> std::function<void()> {
      return [callback, parameters = reader.read<Parameters>()]() mutable { callback(std::move(parameters)); };
    });
  }

  template <class Message>
  Output<Message> output(const interfaces::Topic<Message>& topic) {
    return Output<Message>(open_output(describe(topic)));
  }

  /// Parameters declared so far by parameters().
  const std::vector<ParameterDescription>& declared_parameters() const noexcept;

  /// Calls `callback(std::shared_ptr<const Message>)` for each message. The queue keeps the newest `topic.qos.depth`
  /// messages.
  template <class Message, class Callback>
  void input(const interfaces::Topic<Message>& topic, Callback callback) {
    open_input(describe(topic), [callback = std::move(callback)](const SamplePtr& sample) mutable {
      callback(Sample::as<Message>(sample));
    });
  }

  /// Calls `callback(first, second)` for each pair of messages with equal header stamps (a stereo pair), or with stamps
  /// that differ by at most `tolerance`, which should be below half the period of both topics: a message is paired as
  /// soon as a partner is there. Messages without a partner are dropped and counted.
  template <class First, class Second, class Callback>
  void input_pair(const interfaces::Topic<First>& first, const interfaces::Topic<Second>& second, Callback callback,
                  std::chrono::nanoseconds tolerance = std::chrono::nanoseconds(0)) {
    open_input_pair(describe(first), describe(second), tolerance,
                    [callback = std::move(callback)](const SamplePtr& a, const SamplePtr& b) mutable {
                      callback(Sample::as<First>(a), Sample::as<Second>(b));
                    });
  }

  /// Offers a service: `callback(const Request&) -> Response` runs on the component's message thread, between two
  /// messages. Components of this container call it directly, other processes over DDS. If 32 requests are waiting, a
  /// further one stays unanswered and counts as dropped.
  template <class Request, class Response, class Callback>
  void serve(const interfaces::Service<Request, Response>& service, Callback callback) {
    open_service(describe(service), service_handler<Request, Response>(std::move(callback)));
  }

  /// A client of a service of another component, in this container or another process.
  template <class Request, class Response>
  Client<Request, Response> client(const interfaces::Service<Request, Response>& service) {
    return Client<Request, Response>(open_client(describe(service)));
  }

  /// Adds a second processing stage. Live, it has its own thread behind a queue of `capacity` items; push blocks while
  /// the queue is full. In replay it runs sequentially. `callback(Item)` gets the same items in the same order in both
  /// cases.
  template <class Item, class Callback>
  Stage<Item> stage(const std::string& stage_name, std::size_t capacity, Callback callback) {
    return Stage<Item>(open_stage(stage_name, capacity, [callback = std::move(callback)](std::any& item) mutable {
      callback(std::move(*std::any_cast<std::shared_ptr<Item>&>(item)));
    }));
  }

  /// Calls `callback()` at the end of the run on the component's message thread, after all messages of the run, to publish
  /// what waited for later ones: the other components of the container still receive it, before any on_end(). Other
  /// processes may have ended. Not called for a component that is unloaded earlier.
  void before_end(std::function<void()> callback);

  /// Calls `callback()` at the end of the run, when no other callback of the component is running, to finish its
  /// results. An exception counts as a problem of the run and affects the exit status. Not called for a component that
  /// is unloaded earlier.
  void on_end(std::function<void()> callback);

  /// Calls `callback()` every `period` on the component's message thread, between two messages. Live, it follows the
  /// monotonic clock and skips missed ticks; in replay it follows the played stamps.
  void every(std::chrono::nanoseconds period, std::function<void()> callback);

  /// Marks the component as low priority: live, its threads run at nice +10.
  void set_background();

  /// Lets the runtime play `source`, which must live as long as the component.
  void source(Source& source);

  /// Controls playing.
  Playback& playback();

  /// Subscribes to all topics that `wanted` accepts, including those of other processes, and gets the messages as
  /// samples. For recorders. Drops messages only if more than `depth` are waiting.
  void tap(std::function<bool(const TopicDescription&)> wanted, std::size_t depth,
           std::function<void(const TopicDescription&, const SamplePtr&)> callback);

  /// Access to all topics by name, opened and closed at any time. For viewers.
  std::unique_ptr<TopicAccess> topic_access();

  /// Opens an output for a type known only by name. For bag players.
  std::shared_ptr<UntypedOutput> open_output(const TopicDescription& topic);

  /// Whether another component of this container publishes the topic (resolved name, as recorded:
  /// "/odometry/binocular").
  bool is_published(const std::string& resolved_name) const;
  /// Whether the topic currently has a publisher, in this or another process.
  template <class Message>
  bool has_publisher(const interfaces::Topic<Message>& topic) const {
    return has_publisher(describe(topic));
  }

  /// Whether anybody in this or another process reads the topic, so that messages for viewers only need not be made.
  template <class Message>
  bool has_reader(const interfaces::Topic<Message>& topic) const {
    return has_reader(describe(topic));
  }

  /// Name of a topic after namespace and remaps ("/robot/odometry/binocular"), for use in messages to users.
  template <class Message>
  std::string resolved_name(const interfaces::Topic<Message>& topic) const {
    return resolved_name(topic.name);
  }
  std::string resolved_name(std::string_view topic) const;

  /// Adds what `values` returns to the component's entry in /diagnostics, once a second. Called on another thread, not
  /// after the component is destroyed.
  void on_diagnostics(std::function<DiagnosticValues()> values);

  const Logger& log() const noexcept;
  StageTimes& times() noexcept;

  /// Records messages that the component cannot use.
  RejectedMessages& rejections() noexcept;

  /// Whether the component was restarted after a crash of itself or its process: its previous state is lost.
  bool is_again() const noexcept;

  /// Tells this component in this run from all others: after a restart of itself or its process, it is the same. Empty in
  /// a replay, where nothing is restarted.
  std::string run_id() const;

  /// Call before reading a file of an earlier run. If the last three attempts to read it made the component or process
  /// fail, the file is first renamed, so the component does not find it. No effect in replay.
  void about_to_read(const std::filesystem::path& file);

  /// Stamp of the message being processed, ns: its header stamp, if any. 0 before the first message.
  std::int64_t now_ns() const noexcept;

  /// A monotonic time for measuring silence, ns: of the monotonic clock or of the played data. Its absolute value has
  /// no meaning.
  std::int64_t passing_ns() const;

  /// The host's clock, ns, if messages are of now; nullopt in replay, while sources play, and with use_sim_time.
  std::optional<std::int64_t> host_ns() const;

  /// Seed for the component's random numbers, derived from the system's seed and the component's name.
  std::uint64_t seed() const noexcept;

  struct State;  // used by the runtime
  explicit Context(std::unique_ptr<State> state);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  State& state() noexcept { return *state_; }

 private:
  template <class Message>
  static TopicDescription describe(const interfaces::Topic<Message>& topic) {
    const auto& type = compiled_type<Message>();
    return {std::string(topic.name), std::string(type.name), topic.qos, &type};
  }

  template <class Request, class Response>
  static ServiceDescription describe(const interfaces::Service<Request, Response>& service) {
    compiled_type<Response>();
    std::string type(compiled_type<Request>().name);
    return {std::string(service.name), type.substr(0, type.rfind("_Request"))};
  }

  bool has_publisher(const TopicDescription& topic) const;
  bool has_reader(const TopicDescription& topic) const;
  void open_service(ServiceDescription service, ServiceHandler handler);
  std::shared_ptr<ServiceCaller> open_client(ServiceDescription service);
  ParameterReader& parameter_reader();
  void take_parameters(std::function<std::function<void()>(ParameterReader&)> take);
  void open_input(const TopicDescription& topic, std::function<void(const SamplePtr&)> callback);
  void open_input_pair(const TopicDescription& first, const TopicDescription& second,
                       std::chrono::nanoseconds tolerance,
                       std::function<void(const SamplePtr&, const SamplePtr&)> callback);
  std::shared_ptr<StageQueue> open_stage(const std::string& stage_name, std::size_t capacity,
                                         std::function<void(std::any&)> callback);

  std::unique_ptr<State> state_;
};

}  // namespace panvo::runtime
