// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/context.hpp"

#include <fmt/format.h>

#include <limits>
#include <optional>

#include "clocks.hpp"
#include "context_state.hpp"
#include "fnv1a.hpp"
#include "pairing.hpp"
#include "panvo/interfaces/node_topics.hpp"
#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/names.hpp"
#include "stamp_gate.hpp"
#include "topic_access.hpp"

namespace panvo::runtime {
namespace {

class ChannelOutput final : public UntypedOutput {
 public:
  ChannelOutput(Channel& channel, Host& host, std::shared_ptr<const void> library, const std::string& owner,
                const std::optional<interfaces::Qos>& qos)
      : channel_(channel),
        host_(host),
        library_(std::move(library)),
        sender_(std::make_shared<const std::string>(owner)) {
    channel_.add_publisher(this, owner, qos);
  }
  ~ChannelOutput() override { channel_.remove_publisher(this); }

  void publish(std::shared_ptr<const void> message) override {
    channel_.publish(Sample::of(*channel_.topic().type, std::move(message), time_ns(), library_, sender_));
  }
  void publish(interfaces::Bytes bytes) override {
    channel_.publish(
        Sample::from_bytes(channel_.topic().type, channel_.topic().type_name, std::move(bytes), time_ns(), sender_));
  }

 private:
  std::int64_t time_ns() const { return host_.replay_order ? current_stamp_ns() : clocks::system_ns(); }

  Channel& channel_;
  Host& host_;
  std::shared_ptr<const void> library_;
  Sample::Sender sender_;
};

/// Discards messages. Given to a component that will be rejected, so its constructor continues and finds further
/// problems.
class NoOutput final : public UntypedOutput {
 public:
  void publish(std::shared_ptr<const void>) override {}
  void publish(interfaces::Bytes) override {}
};

class WorkerStage final : public StageQueue {
 public:
  WorkerStage(Worker& worker, Port& port) : worker_(worker), port_(port) {}
  void push(std::any item) override { worker_.push(port_, {.item = std::move(item), .stamp_ns = current_stamp_ns()}); }

 private:
  Worker& worker_;
  Port& port_;
};

}  // namespace

Context::State::State(Host& a_host, const ComponentDescription& a_description, std::shared_ptr<const void> a_library)
    : host(a_host),
      description(a_description),
      library(std::move(a_library)),
      node(a_description.name, a_description.parameters),
      reader(a_description.name, node.others(a_description.parameters)),
      logger(a_description.name, a_host.log, a_host.replay_order ? current_stamp_ns : clocks::monotonic_ns) {
  workers.push_back(make_worker(description.name));
}

std::unique_ptr<Worker> Context::State::make_worker(const std::string& worker_name) {
  return std::make_unique<Worker>(worker_name, times, host.replay_order,
                                  Worker::Hooks{.failed =
                                                    [this](const std::string& what) {
                                                      logger.error("stopped by an error: {}", what);
                                                      host.failed(description);
                                                    },
                                                .progressed = host.progressed,
                                                .in_flight = &host.in_flight});
}

TopicDescription Context::State::resolve(TopicDescription topic) const {
  topic.name = resolve_topic(description.name_space, description.name, description.remaps, topic.name);
  return topic;
}

void Context::State::follow_clock(bool follow) {
  if (host.replay_order || follow == follows_clock_) return;
  const auto& type = interfaces::message_type<rosgraph_msgs::msg::Clock>();
  Channel& channel =
      host.bus.channel({std::string(topics::kClock.name), std::string(type.name), topics::kClock.qos, &type});
  follows_clock_ = follow;
  if (!follow) return channel.remove_reader(&clock_ns_);
  try {
    channel.add_reader(&clock_ns_, [this, &type](const TopicDescription&, const SamplePtr& sample) {
      if (const void* clock = sample->message()) clock_ns_ = type.stamp_ns(clock).value_or(0);
    });
  } catch (const ConfigError&) {
    follow_clock(false);
    throw;
  }
}

std::int64_t Context::State::timer_stamp_ns() const {
  const bool is_live = host.time.pace() == PassingTime::Pace::kClock && !host.replay_order;
  if (!is_live) return host.time.now_ns();
  return follows_clock_ ? clock_ns_.load() : clocks::system_ns();
}

void Context::State::open_reader(Channel& channel, const std::optional<interfaces::Qos>& qos,
                                 std::function<void(const SamplePtr&)> take) {
  inputs.push_back(&channel);
  // A component may read a topic by several inputs, each of which gets all messages.
  std::string input = fmt::format("{} {}", inputs.size(), channel.topic().name);
  const auto gate = gates.emplace_back(std::make_shared<StampGate>(*this, std::move(input), std::move(take)));
  channel.add_reader(
      this,
      [this, gate](const TopicDescription& there, const SamplePtr& sample) {
        if (active) gate->add(there, sample);
      },
      Channel::Wants::kValid, qos);
}

void Context::State::start() {
  follow_clock(node.uses_sim_time());
  for (const auto& worker : workers) worker->start(gives_way);
}

void Context::State::set_active(bool is_active) {
  active = is_active;
  if (is_active) return;
  for (const auto& gate : gates) gate->drop_waiting();
}

void Context::State::stop() {
  if (source) host.pacer.remove(*source);
  follow_clock(false);
  for (Channel* channel : inputs) channel->remove_reader(this);
  inputs.clear();
  for (const auto& gate : gates) gate->drop_waiting();
  if (taps) host.bus.remove_tap(this);
  taps = false;
  host.services.remove_of(this);
  // Stages first: the component's own thread may be blocked on a full stage.
  for (auto worker = workers.rbegin(); worker != workers.rend(); ++worker) (*worker)->stop();
  for (const auto& caller : callers) caller->close();     // no callback of the component can call any more
  trust_files(std::numeric_limits<std::int64_t>::max());  // a regular end counts as success, however short the run
}

bool Context::State::failed() const {
  for (const auto& worker : workers) {
    if (worker->failed()) return true;
  }
  return false;
}

Context::Context(std::unique_ptr<State> state) : state_(std::move(state)) {}
Context::~Context() { state_->stop(); }

const std::string& Context::name() const noexcept { return state_->description.name; }
const Logger& Context::log() const noexcept { return state_->logger; }
StageTimes& Context::times() noexcept { return state_->times; }
RejectedMessages& Context::rejections() noexcept { return state_->rejections; }
ParameterReader& Context::parameter_reader() { return state_->reader; }
const std::vector<ParameterDescription>& Context::declared_parameters() const noexcept {
  return state_->reader.declared();
}
std::string Context::resolved_name(std::string_view topic) const {
  return resolve_topic(state_->description.name_space, name(), state_->description.remaps, topic);
}

bool Context::is_again() const noexcept { return state_->host.again || state_->restarts > 0; }
std::string Context::run_id() const {
  if (state_->host.run_id.empty()) return "";
  return state_->host.run_id + full_name(state_->description.name_space, state_->description.name);
}
std::int64_t Context::passing_ns() const { return state_->host.time.now_ns(); }
std::optional<std::int64_t> Context::host_ns() const {
  const auto& time = state_->host.time;
  if (time.pace() != PassingTime::Pace::kClock || state_->follows_clock()) return std::nullopt;
  return state_->host.replay_order ? time.now_ns() : clocks::system_ns();
}
std::int64_t Context::now_ns() const noexcept { return current_stamp_ns(); }

std::uint64_t Context::seed() const noexcept {
  return fnv1a(state_->description.name, kFnv1aStart ^ state_->host.seed);
}

std::shared_ptr<UntypedOutput> Context::open_output(const TopicDescription& topic) {
  try {
    const TopicDescription resolved = state_->resolve(topic);
    const auto qos = state_->node.overriding(resolved.name, NodeParameters::Side::kPublisher, resolved.qos);
    return std::make_shared<ChannelOutput>(state_->host.bus.channel(resolved), state_->host, state_->library, name(),
                                           qos);
  } catch (const ConfigError& error) {
    state_->problems.push_back(name() + ": " + error.what());
    return std::make_shared<NoOutput>();
  }
}

void Context::open_input(const TopicDescription& topic, std::function<void(const SamplePtr&)> callback) {
  try {
    const TopicDescription resolved = state_->resolve(topic);
    Channel& channel = state_->host.bus.channel(resolved);
    const auto qos = state_->node.overriding(resolved.name, NodeParameters::Side::kSubscription, resolved.qos);
    Worker& worker = state_->main_worker();
    Port& port = worker.add_port(topic.name, qos.value_or(topic.qos).depth, false,
                                 [callback = std::move(callback)](Task& task) { callback(task.first); });
    state_->open_reader(channel, qos, [&worker, &port](const SamplePtr& sample) {
      worker.push(port, {.first = sample, .stamp_ns = sample->stamp_ns()});
    });
  } catch (const ConfigError& error) {
    state_->problems.push_back(name() + ": " + error.what());
  }
}

void Context::open_input_pair(const TopicDescription& first, const TopicDescription& second,
                              std::chrono::nanoseconds tolerance,
                              std::function<void(const SamplePtr&, const SamplePtr&)> callback) {
  try {
    if (tolerance.count() < 0) throw ConfigError("the tolerance of a pair of inputs is negative");
    const TopicDescription resolved[2] = {state_->resolve(first), state_->resolve(second)};
    Channel* channels[2] = {&state_->host.bus.channel(resolved[0]), &state_->host.bus.channel(resolved[1])};
    std::optional<interfaces::Qos> qos[2];
    for (int side = 0; side < 2; ++side) {
      qos[side] = state_->node.overriding(resolved[side].name, NodeParameters::Side::kSubscription, resolved[side].qos);
    }
    Worker& worker = state_->main_worker();
    Port& port = worker.add_port(first.name + ", " + second.name, qos[0].value_or(first.qos).depth, false,
                                 [callback = std::move(callback)](Task& task) { callback(task.first, task.second); });
    const auto pairing = std::make_shared<Pairing>(worker, port, tolerance.count());
    for (int side = 0; side < 2; ++side) {
      state_->open_reader(*channels[side], qos[side], [pairing, side](const SamplePtr& sample) {
        pairing->take(side, sample->stamp_ns(), sample);
      });
    }
  } catch (const ConfigError& error) {
    state_->problems.push_back(name() + ": " + error.what());
  }
}

std::shared_ptr<StageQueue> Context::open_stage(const std::string& stage_name, std::size_t capacity,
                                                std::function<void(std::any&)> callback) {
  Worker& worker = *state_->workers.emplace_back(state_->make_worker(stage_name));
  Port& port = worker.add_port(stage_name, capacity, true,
                               [callback = std::move(callback)](Task& task) { callback(task.item); });
  return std::make_shared<WorkerStage>(worker, port);
}

void Context::take_parameters(std::function<std::function<void()>(ParameterReader&)> take) {
  if (!state_->parameter_port) {
    state_->parameter_port = &state_->main_worker().add_port(
        "parameters", 1, false, [](Task& task) { std::any_cast<std::function<void()>&>(task.item)(); });
  }
  state_->parameter_takers.push_back(std::move(take));
}

void Context::before_end(std::function<void()> callback) {
  state_->last_port =
      &state_->main_worker().add_port("end", 1, true, [callback = std::move(callback)](Task&) { callback(); });
}

void Context::on_end(std::function<void()> callback) { state_->end = std::move(callback); }

void Context::every(std::chrono::nanoseconds period, std::function<void()> callback) {
  state_->main_worker().add_timer(period.count(), [state = state_.get(), callback = std::move(callback)] {
    if (!state->active) return;
    set_current_stamp_ns(state->timer_stamp_ns());
    callback();
  });
}

void Context::set_background() { state_->gives_way = true; }

void Context::source(Source& source) { state_->source = &source; }

Playback& Context::playback() { return state_->host.pacer; }

void Context::on_diagnostics(std::function<DiagnosticValues()> values) { state_->diagnose = std::move(values); }

void Context::tap(std::function<bool(const TopicDescription&)> wanted, std::size_t depth,
                  std::function<void(const TopicDescription&, const SamplePtr&)> callback) {
  Worker& worker = state_->main_worker();
  Port& port = worker.add_port("tap", depth, false,
                               [callback = std::move(callback)](Task& task) { callback(*task.topic, task.first); });
  port.completes = true;  // a recorder accounts for all messages
  state_->taps = true;
  state_->host.bus.tap(state_.get(), std::move(wanted),
                       [state = state_.get(), &worker, &port](const TopicDescription& topic, const SamplePtr& sample) {
                         if (!state->active) return;
                         worker.push(port, {.topic = &topic, .first = sample, .stamp_ns = sample->time_ns()});
                       });
}

std::unique_ptr<TopicAccess> Context::topic_access() {
  return make_topic_access(state_->host, [this](const TopicDescription& topic) -> std::shared_ptr<UntypedOutput> {
    return std::make_shared<ChannelOutput>(state_->host.bus.channel(topic), state_->host, state_->library, name(),
                                           std::nullopt);
  });
}

bool Context::is_published(const std::string& resolved_name) const {
  for (const Channel* channel : state_->host.bus.channels()) {
    if (channel->topic().name == resolved_name) return channel->has_publisher_other_than(nullptr);
  }
  return false;
}

bool Context::has_publisher(const TopicDescription& topic) const {
  const Channel& channel = state_->host.bus.channel(state_->resolve(topic));
  return channel.has_publisher_other_than(nullptr) || channel.counters().remote_writers > 0;
}

bool Context::has_reader(const TopicDescription& topic) const {
  const Channel& channel = state_->host.bus.channel(state_->resolve(topic));
  return channel.has_readers() || channel.has_observers() || channel.counters().remote_readers > 0;
}

}  // namespace panvo::runtime
