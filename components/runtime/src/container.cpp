// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/container.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "clocks.hpp"
#include "context_state.hpp"
#include "diagnostics.hpp"
#include "library.hpp"
#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/graph.hpp"
#include "panvo/runtime/names.hpp"
#include "played_clock.hpp"
#include "rosout.hpp"
#include "source_runner.hpp"
#include "steering/component_node.hpp"
#include "steering/parameter_events.hpp"
#include "steering/steered.hpp"

namespace panvo::runtime {
namespace {

void log_to_stderr(LogLevel level, const std::string& component, const std::string& text) {
  if (level >= LogLevel::kWarning) std::fprintf(stderr, "%s: %s\n", component.c_str(), text.c_str());
}

/// A loaded component. Its members go in the order that keeps all code mapped that may still run: first the component, then what the
/// runtime holds of it (callbacks are the plugin's code), then the plugin.
struct Entry {
  std::uint64_t id = 0;
  std::shared_ptr<Library> library;
  std::unique_ptr<Context> context;
  std::unique_ptr<Component, void (*)(Component*)> component{nullptr, nullptr};
  std::unique_ptr<steering::ComponentNode> node;
  std::vector<std::unique_ptr<BridgeService>> services;  // answer from the node

  ~Entry() {
    services.clear();
    if (context) context->state().stop();
  }

  std::string full_name() const {
    const auto& description = context->state().description;
    return runtime::full_name(description.name_space, description.name);
  }
};

std::vector<std::string> names_of(const std::vector<steering::OfferedService>& services) {
  std::vector<std::string> names;
  for (const auto& service : services) names.push_back(service.description.name);
  return names;
}

}  // namespace

class Container::Implementation final : public steering::SteeredContainer {
 public:
  explicit Implementation(ContainerOptions options)
      : options_(std::move(options)),
        sink_(options_.log ? options_.log : Logger::Write(log_to_stderr)),
        bus_(options_.dds && !options_.replay ? make_dds_bridge(*options_.dds) : nullptr,
             [this](const std::string& text) { log(LogLevel::kWarning, "container", text); }),
        host_{.bus = bus_,
              .replay_order = options_.replay ? &replay_order_ : nullptr,
              .log = [this](LogLevel level, const std::string& component,
                            const std::string& text) { log(level, component, text); },
              .seed = options_.seed,
              .progressed = [this] { progressed(); }},
        own_(std::make_unique<Context::State>(host_, own_description(), nullptr)),
        diagnostics_output_(own_.open_output(describe(topics::kDiagnostics))) {
    rosout_.open(own_.open_output(describe(topics::kRosout)));
    if (!bus_.bridge()) return;
    parameter_events_ = own_.open_output(describe(steering::kParameterEvents));
    auto offered = steering::component_services(full_name(), *this);
    own_service_names_ = names_of(offered);
    services_ = serve(std::move(offered));
    tell_nodes();
  }

  ~Implementation() override {
    services_.clear();  // from now on nobody loads or unloads
    rosout_.close();
    if (runner_) runner_->stop();
    stop_housekeeping();
    while (!entries_.empty()) take_last();  // the last loaded first: it may use what the others publish
  }

  void log(LogLevel level, const std::string& component, const std::string& text) {
    sink_(level, component, text);
    rosout_.publish(level, component, text, options_.replay ? current_stamp_ns() : clocks::system_ns());
  }

  using Create = std::function<std::unique_ptr<Component, void (*)(Component*)>(Context&)>;
  Loaded add(const ComponentDescription& description, std::shared_ptr<Library> library, const Create& create) {
    const std::lock_guard change(change_mutex_);
    if (bus_.bridge() && runtime::full_name(description.name_space, description.name) == full_name()) {
      throw ConfigError(description.where.to_string() + ": " + full_name() +
                        " is the container's name; give the component another");
    }
    if (find(description.name) != entries_.end()) {
      throw ConfigError(description.where.to_string() + ": there already is a component " + description.name +
                        "; give this one another name");
    }
    auto entry = std::make_unique<Entry>();
    entry->library = library;
    entry->context = std::make_unique<Context>(std::make_unique<Context::State>(host_, description, library));
    Context::State& state = entry->context->state();
    std::vector<std::string> problems;
    try {
      entry->component = create(*entry->context);
    } catch (const ConfigError& error) {
      problems = error.problems();
    } catch (const std::exception& error) {
      problems.push_back(description.name + " could not be made: " + error.what());
    }
    const auto append = [&](const std::vector<std::string>& more) {
      problems.insert(problems.end(), more.begin(), more.end());
    };
    append(state.reader.problems());
    append(state.problems);
    if (state.source && running_) {
      problems.push_back(description.name + " plays recorded data, which can only begin with the run: load it before");
    }
    if (!problems.empty()) throw ConfigError(std::move(problems));
    if (started_) state.start();
    entry->id = next_id_++;
    const Loaded loaded{entry->id, entry->full_name()};
    if (bus_.bridge()) {
      offer_services(*entry);
      tell_parameters(steering::new_parameters(loaded.full_name, state.parameters(), clocks::system_ns()));
    }
    {
      const std::lock_guard lock(entries_mutex_);
      entries_.push_back(std::move(entry));
    }
    tell_nodes();
    return loaded;
  }

  bool unload(const std::string& name) {
    return unload_if([&](const Entry& entry) { return entry.context->name() == name; });
  }

  Loaded load_component(const ComponentDescription& description) override;
  void unload_component(std::uint64_t id) override {
    if (unload_if([id](const Entry& entry) { return entry.id == id; })) return;
    throw ConfigError(fmt::format("there is no component of the id {}; list_nodes tells which there are", id));
  }
  std::vector<Loaded> loaded_components() const override {
    const std::lock_guard lock(entries_mutex_);
    std::vector<Loaded> loaded;
    for (const auto& entry : entries_) loaded.push_back({entry->id, entry->full_name()});
    return loaded;
  }

  void start() {
    const std::lock_guard change(change_mutex_);
    if (started_) return;
    started_ = true;
    for (const auto& entry : entries_) entry->context->state().start();
    if (!options_.replay) housekeeping_ = std::thread([this] { keep_house(); });
  }

  std::vector<std::string> run() {
    start();
    std::vector<Source*> sources;
    {
      const std::lock_guard change(change_mutex_);
      running_ = true;
      for (const auto& entry : entries_) {
        if (Source* source = entry->context->state().source) sources.push_back(source);
      }
    }
    if (options_.replay) {
      replay(sources);
    } else {
      run_live(sources);
    }
    running_ = false;
    std::vector<std::string> problems = source_problems_;
    const std::lock_guard lock(entries_mutex_);
    for (const auto& entry : entries_) {
      if (entry->context->state().failed())
        problems.push_back(entry->context->name() + " stopped by an error, see the log");
    }
    return problems;
  }

  void run_until_quiet() {
    while (replay_order_.run_one()) {
    }
  }

  void request_stop() noexcept {
    stop_requested_ = true;
    stop_changed_.notify_all();
  }

  std::vector<std::unique_ptr<Entry>>::iterator find(const std::string& name) {
    return std::find_if(entries_.begin(), entries_.end(),
                        [&](const auto& entry) { return entry->context->name() == name; });
  }

  /// What each of the components says, while none comes or goes.
  template <class Say>
  void for_each(const Say& say) const {
    const std::lock_guard lock(entries_mutex_);
    for (const auto& entry : entries_) say(entry->context->name(), entry->context->state());
  }
  Bus& bus() { return bus_; }
  std::uint64_t source_steps() const { return source_steps_; }

  std::function<void(Source::Progress)> on_progress = [](Source::Progress) {};

 private:
  static ComponentDescription own_description() {
    ComponentDescription description;
    description.name = "container";
    return description;
  }

  template <class Message>
  static TopicDescription describe(const interfaces::Topic<Message>& topic) {
    const auto& type = interfaces::message_type<Message>();
    return {std::string(topic.name), std::string(type.name), topic.qos, &type};
  }

  std::string full_name() const { return runtime::full_name(options_.name_space, options_.name); }

  std::vector<std::unique_ptr<BridgeService>> serve(std::vector<steering::OfferedService> offered) {
    std::vector<std::unique_ptr<BridgeService>> services;
    for (auto& [description, handler] : offered)
      services.push_back(bus_.bridge()->serve(description, std::move(handler)));
    return services;
  }

  void offer_services(Entry& entry) {
    Context::State& state = entry.context->state();
    const auto shut_down = [this, id = entry.id] {
      const std::lock_guard lock(housekeeping_mutex_);
      to_unload_.push_back(id);
    };
    const auto parameters_set = [this, &state, name = entry.full_name()](const WrittenValues& set) {
      tell_parameters(steering::changed_parameters(name, state.parameters(), set, clocks::system_ns()));
    };
    entry.node = std::make_unique<steering::ComponentNode>(state, shut_down, parameters_set);
    entry.services = serve(steering::parameter_services(entry.full_name(), *entry.node));
    for (auto& service : serve(steering::lifecycle_services(entry.full_name(), *entry.node)))
      entry.services.push_back(std::move(service));
  }

  void tell_parameters(rcl_interfaces::msg::ParameterEvent event) {
    parameter_events_->publish(std::make_shared<const rcl_interfaces::msg::ParameterEvent>(std::move(event)));
  }

  /// Has the bridge tell other processes which nodes there are and what each has.
  void tell_nodes() {
    if (!bus_.bridge()) return;
    const auto channels = bus_.channels();
    std::vector<NodeDescription> nodes{{options_.name_space, options_.name, {}, {}, own_service_names_}};
    const auto add_topics = [&](NodeDescription& node, const std::string& owner_name, const void* reader) {
      for (const Channel* channel : channels) {
        if (channel->is_published_by(owner_name)) node.publishes.push_back(channel->topic().name);
        if (channel->is_read_by(reader)) node.subscribes.push_back(channel->topic().name);
      }
    };
    const std::lock_guard lock(entries_mutex_);
    add_topics(nodes.front(), own_.name(), &own_.state());
    if (clock_) nodes.front().publishes.emplace_back(topics::kClock.name);
    for (const auto& entry : entries_) {
      Context::State& state = entry->context->state();
      NodeDescription node{state.description.name_space, state.description.name, {}, {}, {}};
      add_topics(node, state.description.name, &state);
      node.serves = names_of(steering::parameter_services(entry->full_name(), *entry->node));
      for (auto& name : names_of(steering::lifecycle_services(entry->full_name(), *entry->node)))
        node.serves.push_back(std::move(name));
      nodes.push_back(std::move(node));
    }
    told_channels_ = channels.size();
    bus_.bridge()->set_nodes(std::move(nodes));
  }

  template <class IsIt>
  bool unload_if(const IsIt& is_it) {
    const std::lock_guard change(change_mutex_);
    std::unique_ptr<Entry> entry;
    {
      const std::lock_guard lock(entries_mutex_);
      const auto found =
          std::find_if(entries_.begin(), entries_.end(), [&](const auto& there) { return is_it(*there); });
      if (found == entries_.end()) return false;
      if ((*found)->context->state().source && running_)
        throw ConfigError((*found)->context->name() + " plays recorded data and goes with the end of the run");
      entry = std::move(*found);
      entries_.erase(found);
    }
    entry.reset();
    tell_nodes();
    return true;
  }

  void take_last() {
    std::unique_ptr<Entry> entry;
    const std::lock_guard lock(entries_mutex_);
    entry.swap(entries_.back());
    entries_.pop_back();
  }

  void progressed() {
    if (SourceRunner* runner = active_runner_.load()) runner->wake();
    stop_changed_.notify_all();
  }

  /// The source with the earliest stamp steps, then all that comes of it is handled, in the order in which it came.
  void replay(const std::vector<Source*>& sources) {
    std::int64_t shown_ns = 0;
    run_until_quiet();
    while (!stop_requested_) {
      Source* earliest = nullptr;
      std::int64_t earliest_ns = 0;
      for (Source* source : sources) {
        const auto stamp_ns = source->next_stamp_ns();
        if (stamp_ns && (!earliest || *stamp_ns < earliest_ns)) {
          earliest = source;
          earliest_ns = *stamp_ns;
        }
      }
      if (!earliest) break;
      set_current_stamp_ns(earliest_ns);
      try {
        earliest->emit();
      } catch (const std::exception& error) {
        fail_source(error.what());
        break;
      }
      ++source_steps_;
      run_until_quiet();
      if (const std::int64_t now_ns = clocks::monotonic_ns(); now_ns - shown_ns > 250'000'000) {
        shown_ns = now_ns;
        on_progress(earliest->progress());
      }
    }
  }

  void run_live(const std::vector<Source*>& sources) {
    if (!sources.empty()) open_clock();
    runner_ = std::make_unique<SourceRunner>(
        sources, SourceRunner::Settings{
                     .rate = options_.rate,
                     .queues_are_empty = [this] { return queues_are_empty(); },
                     .reached =
                         [this](std::int64_t stamp_ns) {
                           if (clock_) clock_->reach(stamp_ns);
                         },
                     .failed = [this](const std::string& what) { fail_source(what); },
                     .warn = [this](const std::string& text) { log(LogLevel::kWarning, "container", text); }});
    active_runner_ = runner_.get();
    runner_->start();
    if (sources.empty()) {
      std::unique_lock lock(stop_mutex_);
      while (!stop_requested_) stop_changed_.wait_for(lock, std::chrono::milliseconds(100));
    }
    while (!sources.empty() && !stop_requested_ && !runner_->wait(250)) on_progress(runner_->progress());
    runner_->stop();
    drain();
    source_steps_ += runner_->steps();
    if (!sources.empty()) on_progress(runner_->progress());
  }

  /// What is played at its pace brings its time along, unless a clock is played too.
  void open_clock() {
    if (!bus_.bridge() || options_.rate <= 0) return;
    for (const Channel* channel : bus_.channels()) {
      if (channel->topic().name == topics::kClock.name && channel->has_publisher_other_than(nullptr)) return;
    }
    {
      const std::lock_guard lock(entries_mutex_);
      clock_ = std::make_unique<PlayedClock>(*bus_.bridge());
    }
    tell_nodes();
  }

  /// Lets what is under way be handled, then what was sent be received. Gives up after 10 s without progress; after 10 s in all when it was
  /// asked to stop, for other processes may go on sending.
  void drain() {
    using std::chrono::steady_clock;
    constexpr auto kPatience = std::chrono::seconds(10);
    std::unique_lock lock(stop_mutex_);
    std::int64_t before = host_.in_flight;
    auto give_up = steady_clock::now() + kPatience;
    while (host_.in_flight != 0 && steady_clock::now() < give_up) {
      stop_changed_.wait_for(lock, std::chrono::milliseconds(20));
      if (host_.in_flight != before && !stop_requested_) give_up = steady_clock::now() + kPatience;
      before = host_.in_flight;
    }
    lock.unlock();
    if (before != 0)
      log(LogLevel::kWarning, "container", fmt::format("{} messages were still waiting at the end", before));
    if (!bus_.wait_for_acknowledgments(std::chrono::seconds(3))) {
      log(LogLevel::kWarning, "container", "another process has not acknowledged all that was sent to it");
    }
  }

  bool queues_are_empty() {
    const std::lock_guard lock(entries_mutex_);
    for (const auto& entry : entries_) {
      for (const auto& worker : entry->context->state().workers) {
        if (!worker->queue_is_empty()) return false;
      }
    }
    return true;
  }

  void fail_source(const std::string& what) {
    log(LogLevel::kError, "container", what);
    const std::lock_guard lock(stop_mutex_);
    source_problems_.push_back(what);
  }

  void keep_house() {
    std::int64_t last_ns = clocks::monotonic_ns();
    std::unique_lock lock(housekeeping_mutex_);
    while (
        !housekeeping_changed_.wait_for(lock, std::chrono::milliseconds(50), [this] { return housekeeping_ended_; })) {
      const auto to_unload = std::exchange(to_unload_, {});
      lock.unlock();
      bus_.join_discovered();
      for (const std::uint64_t id : to_unload) {
        unload_if([id](const Entry& entry) { return entry.id == id; });
      }
      if (bus_.channels().size() != told_channels_) tell_nodes();  // a recorder has found topics
      lock.lock();
      const std::int64_t now_ns = clocks::monotonic_ns();
      if (now_ns - last_ns < 1'000'000'000) continue;
      publish_diagnostics(static_cast<double>(now_ns - last_ns) * 1e-9);
      last_ns = now_ns;
    }
  }

  void publish_diagnostics(double interval_s) {
    diagnostic_msgs::msg::DiagnosticArray array;
    {
      const std::lock_guard lock(entries_mutex_);
      std::vector<const Context::State*> states;
      for (const auto& entry : entries_) states.push_back(&entry->context->state());
      array = diagnostics_.collect(states, clocks::system_ns(), interval_s);
    }
    diagnostics_output_->publish(std::make_shared<const diagnostic_msgs::msg::DiagnosticArray>(std::move(array)));
  }

  void stop_housekeeping() {
    {
      const std::lock_guard lock(housekeeping_mutex_);
      housekeeping_ended_ = true;
    }
    housekeeping_changed_.notify_all();
    if (housekeeping_.joinable()) housekeeping_.join();
  }

  const ContainerOptions options_;
  const Logger::Write sink_;
  Rosout rosout_;  // before the bus, which may have a warning to log while it is made
  ReplayOrder replay_order_;
  Bus bus_;
  Host host_;
  std::unique_ptr<SourceRunner> runner_;  // outlives the workers, which wake it
  std::atomic<SourceRunner*> active_runner_ = nullptr;
  Context own_;  // the container's own outputs
  std::shared_ptr<UntypedOutput> diagnostics_output_;
  std::shared_ptr<UntypedOutput> parameter_events_;  // nullptr without a bridge
  Diagnostics diagnostics_;
  std::unique_ptr<PlayedClock> clock_;  // nullptr: none is to be told

  std::mutex change_mutex_;           // one component comes or goes at a time
  mutable std::mutex entries_mutex_;  // guards entries_, and that what is in it stays meanwhile
  std::vector<std::unique_ptr<Entry>> entries_;
  std::uint64_t next_id_ = 1;
  bool started_ = false;
  std::atomic<bool> running_ = false;
  std::atomic<std::size_t> told_channels_ = 0;

  std::atomic<bool> stop_requested_ = false;
  std::mutex stop_mutex_;
  std::condition_variable stop_changed_;
  std::vector<std::string> source_problems_;
  std::uint64_t source_steps_ = 0;

  std::mutex housekeeping_mutex_;
  std::condition_variable housekeeping_changed_;
  bool housekeeping_ended_ = false;
  std::vector<std::uint64_t> to_unload_;
  std::thread housekeeping_;

  std::vector<std::string> own_service_names_;
  std::vector<std::unique_ptr<BridgeService>> services_;  // last: they use all of the above
};

Container::Container(ContainerOptions options)
    : implementation_(std::make_unique<Implementation>(std::move(options))) {}
Container::~Container() = default;

Container::Implementation::Loaded Container::Implementation::load_component(const ComponentDescription& description) {
  const std::string where = description.where.file.empty() ? "" : description.where.to_string() + ": ";
  try {
    const auto library = std::make_shared<Library>(find_plugin(description.package));
    const ComponentDescriptor* descriptor = library->find(description.plugin);
    if (!descriptor) {
      std::string known;
      for (const auto* component : library->components())
        known += (known.empty() ? "" : ", ") + std::string(component->class_name);
      throw ConfigError(library->file().string() + " has no component " + description.plugin + "; it has " + known);
    }
    return add(description, library, [descriptor](Context& context) {
      return std::unique_ptr<Component, void (*)(Component*)>(descriptor->create(context), descriptor->destroy);
    });
  } catch (const ConfigError& error) {
    std::vector<std::string> problems;
    for (const auto& problem : error.problems()) {
      problems.push_back(problem.starts_with(description.where.file) && !where.empty() ? problem : where + problem);
    }
    throw ConfigError(std::move(problems));
  }
}

void Container::load(const ComponentDescription& description) { implementation_->load_component(description); }

void Container::add(const ComponentDescription& description, const Factory& factory) {
  implementation_->add(description, nullptr, [&](Context& context) {
    return std::unique_ptr<Component, void (*)(Component*)>(factory(context).release(),
                                                            [](Component* component) { delete component; });
  });
}

void Container::load_all(const std::vector<ComponentDescription>& descriptions) {
  std::vector<std::string> problems;
  for (const auto& description : descriptions) {
    try {
      load(description);
    } catch (const ConfigError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) throw ConfigError(std::move(problems));
}

bool Container::unload(const std::string& name) { return implementation_->unload(name); }

std::vector<std::string> Container::components() const {
  std::vector<std::string> names;
  implementation_->for_each([&](const std::string& name, const Context::State&) { names.push_back(name); });
  return names;
}

void Container::start() { implementation_->start(); }
std::vector<std::string> Container::run() { return implementation_->run(); }
void Container::run_until_quiet() { implementation_->run_until_quiet(); }
void Container::request_stop() noexcept { implementation_->request_stop(); }
std::uint64_t Container::source_steps() const { return implementation_->source_steps(); }

void Container::observe(std::function<bool(const TopicDescription&)> wanted,
                        std::function<void(const TopicDescription&, const SamplePtr&)> observer) {
  implementation_->bus().observe(std::move(wanted), std::move(observer));
}

Container::Links Container::links() const {
  Links links;
  for (const Channel* channel : implementation_->bus().channels()) {
    if (channel->has_publisher_other_than(nullptr)) links.published.push_back(channel->topic().name);
    if (channel->has_readers()) links.subscribed.push_back(channel->topic().name);
  }
  implementation_->for_each(
      [&](const std::string&, const Context::State& state) { links.has_source |= state.source != nullptr; });
  return links;
}

bool Container::wait_for_peers(const std::map<std::string, Peers>& peers, std::chrono::milliseconds limit) {
  const auto give_up = std::chrono::steady_clock::now() + limit;
  const auto all_there = [&] {
    for (const Channel* channel : implementation_->bus().channels()) {
      const auto wanted = peers.find(channel->topic().name);
      if (wanted == peers.end()) continue;
      const auto there = channel->counters();
      if (there.remote_readers < wanted->second.readers || there.remote_writers < wanted->second.writers) return false;
    }
    return true;
  };
  while (!all_there()) {
    if (std::chrono::steady_clock::now() >= give_up) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

void Container::on_progress(std::function<void(Source::Progress)> callback) {
  implementation_->on_progress = std::move(callback);
}

std::vector<QueueCounters> Container::queue_counters() const {
  std::vector<QueueCounters> all;
  implementation_->for_each([&](const std::string& name, const Context::State& state) {
    for (const auto& worker : state.workers) {
      for (const auto& port : worker->counters())
        all.push_back({name, port.input, port.received, port.handled, port.dropped});
    }
  });
  return all;
}

ComponentTimes Container::stage_times() const {
  ComponentTimes all;
  implementation_->for_each(
      [&](const std::string& name, const Context::State& state) { all[name] = state.times.snapshot(); });
  return all;
}

std::map<std::string, std::map<std::string, std::string>> Container::changed_parameters() const {
  std::map<std::string, std::map<std::string, std::string>> all;
  implementation_->for_each([&](const std::string& name, const Context::State& state) {
    for (const auto& parameter : state.parameters()) {
      if (parameter.value != parameter.default_value) all[name][parameter.name] = parameter.value;
    }
  });
  return all;
}

std::vector<ParameterDescription> Container::parameters_of(const std::string& component) const {
  std::vector<ParameterDescription> parameters;
  implementation_->for_each([&](const std::string& name, const Context::State& state) {
    if (name == component) parameters = state.parameters();
  });
  return parameters;
}

}  // namespace panvo::runtime
