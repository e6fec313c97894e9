// SPDX-License-Identifier: Apache-2.0
#include "bus.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <utility>

#include "message_check.hpp"
#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/graph.hpp"

namespace panvo::runtime {

using interfaces::Durability;

Channel::Channel(TopicDescription topic, Bridge* bridge, std::function<void(const std::string&)> warn,
                 std::function<std::int64_t()> clock, Limits limits)
    : topic_(std::move(topic)),
      bridge_(bridge),
      warn_(std::move(warn)),
      clock_(std::move(clock)),
      limits_(limits),
      offered_(topic_.qos),
      requested_(topic_.qos) {}

TopicDescription Channel::with(const interfaces::Qos& qos) const {
  TopicDescription topic = topic_;
  topic.qos = qos;
  return topic;
}

void Channel::add_publisher(const void* owner, const std::string& owner_name,
                            const std::optional<interfaces::Qos>& qos) {
  const std::unique_lock lock(mutex_);
  const interfaces::Qos wanted = qos.value_or(topic_.qos);
  if (!publishers_.empty() && offered_ != wanted) {
    throw ConfigError("topic " + topic_.name + " is also published by " + publishers_.begin()->second +
                      " in this container, with another quality of service: set the same qos_overrides." + topic_.name +
                      ".publisher parameters for both");
  }
  offered_ = wanted;
  publishers_[owner] = owner_name;
  if (bridge_ && !writer_) writer_ = bridge_->open_writer(with(offered_));
}

void Channel::remove_publisher(const void* owner) {
  std::unique_ptr<BridgeWriter> closed;
  const std::unique_lock lock(mutex_);
  publishers_.erase(owner);
  if (!publishers_.empty()) return;
  closed = std::move(writer_);
  if (topic_.qos.lifespan.count() == 0) return;
  // A latched state expires with its publisher: later readers must not get it.
  const std::lock_guard history_lock(history_mutex_);
  std::erase_if(history_, [](const Latched& latched) { return latched.is_from_here; });
}

bool Channel::has_publisher_other_than(const void* owner) const {
  const std::shared_lock lock(mutex_);
  return std::any_of(publishers_.begin(), publishers_.end(), [&](const auto& entry) { return entry.first != owner; });
}

bool Channel::is_published_by(const std::string& owner_name) const {
  const std::shared_lock lock(mutex_);
  return std::any_of(publishers_.begin(), publishers_.end(),
                     [&](const auto& entry) { return entry.second == owner_name; });
}

bool Channel::is_read_by(const void* owner) const {
  const std::shared_lock lock(mutex_);
  return std::any_of(readers_.begin(), readers_.end(), [&](const auto& entry) { return entry.owner == owner; });
}

bool Channel::has_readers() const {
  const std::shared_lock lock(mutex_);
  return !readers_.empty();
}

bool Channel::has_observers() const {
  const std::shared_lock lock(mutex_);
  return !observers_.empty();
}

void Channel::agree_on_reading(const std::optional<interfaces::Qos>& qos, Wants wants) {
  const interfaces::Qos wanted = qos.value_or(topic_.qos);
  if (readers_.empty()) {
    requested_ = wanted;
  } else if (wants == Wants::kValid &&
             (requested_.requested != wanted.requested || requested_.durability != wanted.durability)) {
    throw ConfigError("topic " + topic_.name +
                      " is also read by another component of this container, with another reliability or durability: "
                      "set the same qos_overrides." +
                      topic_.name + ".subscription parameters for both");
  }
}

void Channel::add_reader(const void* owner, Reader reader, Wants wants, const std::optional<interfaces::Qos>& qos) {
  {
    const std::unique_lock lock(mutex_);
    agree_on_reading(qos, wants);
    const bool is_volatile = qos && qos->durability == Durability::kVolatile;
    for (const auto& latched : history_) {
      if (is_volatile || is_old(latched)) continue;
      if (wants == Wants::kAll || !topic_.type || !is_rejected(latched.sample)) reader(topic_, latched.sample);
    }
    readers_.push_back({owner, std::move(reader), wants});
  }
  const std::lock_guard lock(bridge_reader_mutex_);
  if (bridge_ && !bridge_reader_)
    bridge_reader_ = bridge_->open_reader(with(requested_), [this](const SamplePtr& sample) {
      deliver(sample, !(is_to_be_checked(*sample) && is_rejected(sample)), false);
    });
}

void Channel::remove_reader(const void* owner) {
  bool last = false;
  {
    const std::unique_lock lock(mutex_);
    std::erase_if(readers_, [&](const auto& entry) { return entry.owner == owner; });
    last = readers_.empty();
  }
  const std::lock_guard lock(bridge_reader_mutex_);
  if (last) bridge_reader_.reset();
}

void Channel::add_observer(Reader observer) {
  const std::unique_lock lock(mutex_);
  observers_.push_back(std::move(observer));
}

void Channel::publish(const SamplePtr& sample) {
  ++published_;
  const bool is_valid = !(is_to_be_checked(*sample) && is_rejected(sample));
  deliver(sample, is_valid, true);
  if (!is_valid) return;
  const std::shared_lock lock(mutex_);
  for (const auto& observer : observers_) observer(topic_, sample);
  if (writer_ && !writer_->write(sample)) ++not_sent_;
}

/// Received bytes that only recorders and other processes read are not decoded here; their readers check them.
bool Channel::is_to_be_checked(const Sample& sample) const {
  if (!topic_.type) return false;
  if (sample.received_size() == 0) return true;
  const std::shared_lock lock(mutex_);
  return std::ranges::any_of(readers_, [](const Member& member) { return member.wants == Wants::kValid; });
}

bool Channel::is_rejected(const SamplePtr& sample) {
  const auto problem = problem_of(*sample, limits_.max_message_bytes);
  if (!problem || !rejections_.add(topic_.name, *problem, sample->sender())) return problem.has_value();
  const std::lock_guard lock(untold_mutex_);
  untold_.emplace_back(sample->sender(), *problem);
  return true;
}

void Channel::deliver(const SamplePtr& sample, bool is_valid, bool is_from_here) {
  if (!is_valid && !bridge_) tell_rejected();  // no bridge, so no sender lookup
  const std::shared_lock lock(mutex_);
  const auto& qos = is_from_here ? offered_ : requested_;
  if (is_valid && qos.durability == Durability::kTransientLocal) remember(sample, is_from_here);
  for (const auto& [owner, reader, wants] : readers_) {
    if (is_valid || wants == Wants::kAll) reader(topic_, sample);
  }
}

RejectedMessages::Count Channel::rejected() const {
  auto rejected = rejections_.snapshot()[topic_.name];
  for (auto causes = std::exchange(rejected.causes, {}); const auto& [cause, count] : causes) {
    rejected.causes[{shown_sender(cause.first), cause.second}] += count;
  }
  return rejected;
}

void Channel::tell_rejected() {
  std::vector<RejectedMessages::Cause> causes;
  {
    const std::lock_guard lock(untold_mutex_);
    causes.swap(untold_);
  }
  for (const auto& [sender, reason] : causes) {
    warn_(fmt::format("{}: a message from {} was dropped: {}", topic_.name, shown_sender(sender), reason));
  }
}

/// The node that owns the writer, if known; otherwise the sender itself.
std::string Channel::shown_sender(const std::string& sender) const {
  if (sender.empty()) return "an unknown sender";
  if (!bridge_) return sender;
  for (const auto& node : bridge_->graph().nodes) {
    if (std::ranges::find(node.writers, sender) == node.writers.end()) continue;
    return node.name_space + (node.name_space.ends_with('/') ? "" : "/") + node.name;
  }
  return sender;
}

bool Channel::is_old(const Latched& latched) const {
  const std::int64_t lifespan_ns = std::chrono::nanoseconds(topic_.qos.lifespan).count();
  return lifespan_ns > 0 && clock_() - latched.since_ns > lifespan_ns;
}

void Channel::remember(const SamplePtr& sample, bool is_from_here) {
  const std::lock_guard lock(history_mutex_);
  history_.push_back({sample, is_from_here, clock_()});
  if (history_.size() > std::max<std::size_t>(topic_.qos.depth, 1)) history_.pop_front();
}

bool Channel::wait_for_acknowledgments(std::chrono::milliseconds limit) {
  const std::shared_lock lock(mutex_);
  return !writer_ || writer_->wait_for_acknowledgments(limit);
}

Channel::Counters Channel::counters() const {
  Counters counters{.published = published_, .not_sent = not_sent_};
  {
    const std::shared_lock lock(mutex_);
    if (writer_) counters.remote_readers = writer_->matched_readers();
  }
  const std::lock_guard lock(bridge_reader_mutex_);
  if (bridge_reader_) {
    counters.remote_writers = bridge_reader_->matched_writers();
    const auto of_bridge = bridge_reader_->counters();
    counters.lost = of_bridge.lost;
    counters.overwritten = of_bridge.overwritten;
    counters.too_large = of_bridge.too_large;
    counters.too_fast = of_bridge.too_fast;
  }
  return counters;
}

Bus::Bus(std::unique_ptr<Bridge> bridge, std::function<void(const std::string&)> warn,
         std::function<std::int64_t()> clock, Limits limits)
    : warn_(std::move(warn)), clock_(std::move(clock)), limits_(limits), bridge_(std::move(bridge)) {
  if (bridge_) bridge_->on_warning(warn_);
}

Bus::~Bus() {
  {
    const std::lock_guard lock(mutex_);
    channels_.clear();
  }
  bridge_.reset();
}

Channel& Bus::channel(const TopicDescription& topic) {
  const std::lock_guard lock(mutex_);
  if (const auto found = channels_.find(topic.name); found != channels_.end()) {
    const auto& there = found->second->topic();
    if (there.type_name != topic.type_name) {
      throw ConfigError("topic " + topic.name + " has type " + there.type_name + " here, not " + topic.type_name +
                        ": remap one of the two topics in the system file");
    }
    return *found->second;
  }
  auto& channel =
      *channels_.emplace(topic.name, std::make_unique<Channel>(topic, bridge_.get(), warn_, clock_, limits_))
           .first->second;
  for (const auto& observer : observers_) {
    if (observer.wanted(topic)) channel.add_observer(observer.reader);
  }
  for (const auto& tap : taps_) {
    if (tap.wanted(topic)) channel.add_reader(tap.owner, tap.reader, Channel::Wants::kAll);
  }
  return channel;
}

std::vector<Channel*> Bus::channels() const {
  const std::lock_guard lock(mutex_);
  std::vector<Channel*> channels;
  for (const auto& [name, channel] : channels_) channels.push_back(channel.get());
  return channels;
}

void Bus::observe(std::function<bool(const TopicDescription&)> wanted, Channel::Reader observer) {
  const std::lock_guard lock(mutex_);
  for (const auto& [name, channel] : channels_) {
    if (wanted(channel->topic())) channel->add_observer(observer);
  }
  observers_.push_back({nullptr, std::move(wanted), std::move(observer)});
}

void Bus::tap(const void* owner, std::function<bool(const TopicDescription&)> wanted, Channel::Reader reader) {
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [name, channel] : channels_) {
      if (wanted(channel->topic())) channel->add_reader(owner, reader, Channel::Wants::kAll);
    }
    taps_.push_back({owner, std::move(wanted), std::move(reader)});
  }
  if (!bridge_ || watching_) return;
  watching_ = true;
  // The bridge calls back while holding its locks: the topic is only stored here and opened by join_discovered().
  bridge_->watch_topics([this](const TopicDescription& topic) {
    const std::lock_guard discovered_lock(discovered_mutex_);
    discovered_.push_back(topic);
  });
}

void Bus::join_discovered() {
  std::vector<TopicDescription> discovered;
  {
    const std::lock_guard lock(discovered_mutex_);
    discovered.swap(discovered_);
  }
  for (const auto& topic : discovered) {
    try {
      const std::lock_guard lock(mutex_);
      const bool is_wanted = std::any_of(taps_.begin(), taps_.end(), [&](const Tap& tap) { return tap.wanted(topic); });
      if (is_wanted) channel(topic);
    } catch (const ConfigError& error) {
      warn_(error.what());
    }
  }
}

void Bus::tell_rejected() {
  for (Channel* channel : channels()) channel->tell_rejected();
}

void Bus::remove_tap(const void* owner) {
  const std::lock_guard lock(mutex_);
  std::erase_if(taps_, [&](const Tap& tap) { return tap.owner == owner; });
  for (const auto& [name, channel] : channels_) channel->remove_reader(owner);
}

bool Bus::wait_for_acknowledgments(std::chrono::milliseconds limit) {
  const auto deadline = std::chrono::steady_clock::now() + limit;
  bool all = true;
  for (Channel* channel : channels()) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    all = channel->wait_for_acknowledgments(std::max(left, std::chrono::milliseconds(0))) && all;
  }
  return all;
}

}  // namespace panvo::runtime
