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

#include "panvo/interfaces/service.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/client.hpp"
#include "panvo/runtime/logger.hpp"
#include "panvo/runtime/output.hpp"
#include "panvo/runtime/parameters.hpp"
#include "panvo/runtime/rejections.hpp"
#include "panvo/runtime/sample.hpp"
#include "panvo/runtime/source.hpp"
#include "panvo/runtime/stage.hpp"
#include "panvo/runtime/stage_times.hpp"

namespace panvo::runtime {

/// All that a component knows of the world: its parameters, topics, log and time. The same component runs live (a thread and a bounded queue of
/// its own) and in replay (one thread for all, messages in order of stamp) without knowing which. To be used in the component's constructor
/// and, for time, log and outputs, in what it registered there.
class Context {
 public:
  /// The component's name in the system: "binocular_odometry".
  const std::string& name() const noexcept;

  /// The component's parameters: defaults overridden by the configuration. A bad value is remembered, its default used, and the component
  /// refused once constructed, with all that is wrong.
  template <class Parameters>
  Parameters parameters() {
    return parameter_reader().read<Parameters>();
  }

  /// Has the component take new values of a parameter struct while it runs: `callback(Parameters)` gets all of the struct, checked as at the start,
  /// between two messages and on the thread that handles them. A ConfigError that it throws refuses them. Without this, parameters are fixed once
  /// the component is made.
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

  /// What parameters() has declared so far.
  const std::vector<ParameterDescription>& declared_parameters() const noexcept;

  /// `callback(std::shared_ptr<const Message>)` runs to completion for each message; of those that wait, the newest `topic.qos.depth` are kept.
  template <class Message, class Callback>
  void input(const interfaces::Topic<Message>& topic, Callback callback) {
    open_input(describe(topic), [callback = std::move(callback)](const SamplePtr& sample) mutable {
      callback(Sample::as<Message>(sample));
    });
  }

  /// `callback(first, second)` for each two messages of equal header stamp (the two images of a stereo pair). Those that stay without a partner
  /// are dropped and counted.
  template <class First, class Second, class Callback>
  void input_pair(const interfaces::Topic<First>& first, const interfaces::Topic<Second>& second, Callback callback) {
    open_input_pair(describe(first), describe(second),
                    [callback = std::move(callback)](const SamplePtr& a, const SamplePtr& b) mutable {
                      callback(Sample::as<First>(a), Sample::as<Second>(b));
                    });
  }

  /// Offers a service: `callback(const Request&) -> Response`, on the thread of the component's messages and between two of them. Components of this
  /// container call it directly, other processes over DDS. Requests that come while 32 wait get no answer and are counted as dropped.
  template <class Request, class Response, class Callback>
  void serve(const interfaces::Service<Request, Response>& service, Callback callback) {
    open_service(describe(service), service_handler<Request, Response>(std::move(callback)));
  }

  /// A service of another component, of this container or of another process.
  template <class Request, class Response>
  Client<Request, Response> client(const interfaces::Service<Request, Response>& service) {
    return Client<Request, Response>(open_client(describe(service)));
  }

  /// A second stage of the component: live on a thread of its own behind a queue of `capacity` items (push waits when it is full), in replay in
  /// sequence; both call it with the same items in the same order. `callback(Item)`.
  template <class Item, class Callback>
  Stage<Item> stage(const std::string& stage_name, std::size_t capacity, Callback callback) {
    return Stage<Item>(open_stage(stage_name, capacity, [callback = std::move(callback)](std::any& item) mutable {
      callback(std::move(*std::any_cast<std::shared_ptr<Item>&>(item)));
    }));
  }

  /// `callback()` finishes what the component made, when the run is over and none of its other callbacks runs any more. What it throws is a
  /// problem of the run, and in its exit status. A component that is unloaded before the run ends has its destructor only.
  void on_end(std::function<void()> callback);

  /// `callback()` every `period`, on the thread of the component's messages and between two of them: live whatever arrives, by the monotonic clock,
  /// and once for all that was missed; in replay when the time of what is played passes it.
  void every(std::chrono::nanoseconds period, std::function<void()> callback);

  /// Nobody waits for what this component does: live, its threads give way to those of others where cores are short (10 nicer).
  void give_way();

  /// Has the runtime play `source`, which must live as long as the component.
  void source(Source& source);

  /// Every message of every topic that `wanted` accepts, those of other processes included, as samples: for recorders. Never dropped
  /// before `depth` wait.
  void tap(std::function<bool(const TopicDescription&)> wanted, std::size_t depth,
           std::function<void(const TopicDescription&, const SamplePtr&)> callback);

  /// Publishes samples of a type known by name only: for bag players.
  std::shared_ptr<UntypedOutput> open_output(const TopicDescription& topic);

  /// Whether another component of this container publishes the topic (name as recorded: "/odometry/binocular").
  bool is_published(const std::string& resolved_name) const;
  /// Whether anybody publishes the topic by now, here or in another process.
  template <class Message>
  bool has_publisher(const interfaces::Topic<Message>& topic) const {
    return has_publisher(describe(topic));
  }

  /// The name a topic of this component goes by, after namespace and remaps ("/robot/odometry/binocular"): what messages to people name.
  template <class Message>
  std::string resolved_name(const interfaces::Topic<Message>& topic) const {
    return resolved_name(topic.name);
  }
  std::string resolved_name(std::string_view topic) const;

  const Logger& log() const noexcept;
  StageTimes& times() noexcept;

  /// Where the component tells of messages that it cannot use.
  Rejections& rejections() noexcept;

  /// Whether the component was there before and crashed, by itself or with its process: what it knew is gone, and the world went on.
  bool is_again() const noexcept;

  /// To be called before a file is read that an earlier run left. One that has made this component or its process fail three times in a row is set
  /// aside first, under another name, and the component finds no file. Nothing is done in replay.
  void about_to_read(const std::filesystem::path& file);

  /// The stamp of what is being processed, ns: header stamp where the message has one. 0 before the first.
  std::int64_t now_ns() const noexcept;

  /// A time that only goes on, ns, to tell how long something has been silent: of the monotonic clock, or of what is played. Means nothing by
  /// itself.
  std::int64_t passing_ns() const;

  /// A seed for this component's random numbers: from the system's seed and the component's name.
  std::uint64_t seed() const noexcept;

  struct State;  // the runtime's side
  explicit Context(std::unique_ptr<State> state);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  State& state() noexcept { return *state_; }

 private:
  template <class Message>
  static TopicDescription describe(const interfaces::Topic<Message>& topic) {
    const auto& type = interfaces::message_type<Message>();
    return {std::string(topic.name), std::string(type.name), topic.qos, &type};
  }

  template <class Request, class Response>
  static ServiceDescription describe(const interfaces::Service<Request, Response>& service) {
    std::string type(interfaces::message_type<Request>().name);
    return {std::string(service.name), type.substr(0, type.rfind("_Request"))};
  }

  bool has_publisher(const TopicDescription& topic) const;
  void open_service(ServiceDescription service, ServiceHandler handler);
  std::shared_ptr<ServiceCaller> open_client(ServiceDescription service);
  ParameterReader& parameter_reader();
  void take_parameters(std::function<std::function<void()>(ParameterReader&)> take);
  void open_input(const TopicDescription& topic, std::function<void(const SamplePtr&)> callback);
  void open_input_pair(const TopicDescription& first, const TopicDescription& second,
                       std::function<void(const SamplePtr&, const SamplePtr&)> callback);
  std::shared_ptr<StageQueue> open_stage(const std::string& stage_name, std::size_t capacity,
                                         std::function<void(std::any&)> callback);

  std::unique_ptr<State> state_;
};

}  // namespace panvo::runtime
