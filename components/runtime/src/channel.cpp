// SPDX-License-Identifier: Apache-2.0
#include "channel.hpp"

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
    : opened_(std::move(topic)),
      bridge_(bridge),
      warn_(std::move(warn)),
      limits_(limits),
      offered_(opened_.qos),
      requested_(opened_.qos),
      history_(opened_, std::move(clock), history_folder(), warn_) {}

void Channel::learn_type(const interfaces::MessageType& type) {
  const std::unique_lock lock(mutex_);
  if (topic().type) return;
  learnt_ = opened_;
  learnt_.type = &type;
  topic_ = &learnt_;
}

/// The message with the topic's type, if it came as bytes before that was known.
SamplePtr Channel::typed(const SamplePtr& sample) const {
  const auto* type = topic().type;
  if (sample->type() || !type) return sample;
  auto sender = std::make_shared<const std::string>(sample->sender());
  return Sample::from_bytes(type, sample->type_name(), sample->bytes(), sample->time_ns(), std::move(sender));
}

TopicDescription Channel::with(const interfaces::Qos& qos) const {
  TopicDescription described = topic();
  described.qos = qos;
  return described;
}

void Channel::add_publisher(const void* owner, const std::string& owner_name,
                            const std::optional<interfaces::Qos>& qos) {
  const std::lock_guard writer_lock(bridge_writer_mutex_);
  const interfaces::Qos wanted = qos.value_or(topic().qos);
  if (!publishers_.empty() && offered_ != wanted) {
    throw ConfigError("topic " + topic().name + " is also published by " + publishers_.begin()->second +
                      " in this container, with another quality of service: set the same qos_overrides." +
                      topic().name + ".publisher parameters for both");
  }
  std::unique_ptr<BridgeWriter> opened;
  if (bridge_ && !writer_) opened = bridge_->open_writer(with(wanted));
  {
    const std::unique_lock lock(mutex_);
    offered_ = wanted;
    publishers_[owner] = owner_name;
  }
  if (!opened) return;
  const std::unique_lock writing_lock(writing_mutex_);
  writer_ = std::move(opened);
  sends_history_ = history_.keeps_all() && wanted.durability == Durability::kTransientLocal;
  sent_ = 0;
  has_sent_all_ = false;
}

void Channel::remove_publisher(const void* owner) {
  send_history();
  const std::lock_guard writer_lock(bridge_writer_mutex_);
  {
    const std::unique_lock lock(mutex_);
    publishers_.erase(owner);
    if (!publishers_.empty()) return;
    // A latched state expires with its publisher: later readers must not get it.
    if (topic().qos.lifespan.count() != 0) history_.forget_those_from_here();
  }
  std::unique_ptr<BridgeWriter> closed;  // after writing_mutex_ is released
  const std::unique_lock writing_lock(writing_mutex_);
  closed = std::move(writer_);
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

bool Channel::has_readers_of_valid() const {
  return std::ranges::any_of(readers_, [](const Member& member) { return member.wants == Wants::kValid; });
}

/// What is to be requested with a further reader.
interfaces::Qos Channel::agreed_on_reading(const std::optional<interfaces::Qos>& qos, Wants wants) const {
  const interfaces::Qos wanted = qos.value_or(topic().qos);
  if (readers_.empty()) return wanted;
  const bool is_same = requested_.requested == wanted.requested && requested_.durability == wanted.durability;
  if (is_same || wants == Wants::kAll) return requested_;
  if (has_readers_of_valid()) {
    throw ConfigError("topic " + topic().name +
                      " is also read by another component of this container, with another reliability or durability: "
                      "set the same qos_overrides." +
                      topic().name + ".subscription parameters for both");
  }
  return wanted;
}

void Channel::add_reader(const void* owner, Reader reader, Wants wants, const std::optional<interfaces::Qos>& qos) {
  const std::lock_guard reader_lock(bridge_reader_mutex_);
  const interfaces::Qos agreed = agreed_on_reading(qos, wants);
  if (agreed != requested_) close_bridge_reader();
  {
    const std::unique_lock lock(mutex_);
    requested_ = agreed;
    const Member member{owner, std::move(reader), wants};
    if (!qos || qos->durability != Durability::kVolatile) pass_history_to(member);
    readers_.push_back(member);
  }
  if (bridge_ && !bridge_reader_)
    bridge_reader_ = bridge_->open_reader(with(requested_), [this](const SamplePtr& sample) {
      const auto message = typed(sample);
      deliver(message, check(message), false);
    });
}

void Channel::pass_history_to(const Member& member) {
  for (const auto& entry : history_.current()) {
    const bool is_to_be_checked = member.wants == Wants::kValid && topic().type && !entry.is_checked;
    const auto sample = typed(Sample::unread(entry.sample));
    if (is_to_be_checked && is_rejected(sample)) continue;
    member.reader(topic(), sample);
  }
}

void Channel::remove_reader(const void* owner) {
  const std::lock_guard reader_lock(bridge_reader_mutex_);
  {
    const std::unique_lock lock(mutex_);
    std::erase_if(readers_, [&](const auto& entry) { return entry.owner == owner; });
  }
  if (readers_.empty()) close_bridge_reader();
}

/// Forgets what it received: those writers that still exist send their latched messages again to the next one.
void Channel::close_bridge_reader() {
  bridge_reader_.reset();
  history_.forget_those_of_others();
}

void Channel::add_observer(Reader observer) {
  const std::unique_lock lock(mutex_);
  observers_.push_back(std::move(observer));
}

void Channel::publish(const SamplePtr& published) {
  ++published_;
  const SamplePtr sample = typed(published);
  const Verdict verdict = check(sample);
  deliver(sample, verdict, true);
  if (verdict == Verdict::kInvalid) return;
  {
    const std::shared_lock lock(mutex_);
    for (const auto& observer : observers_) observer(topic(), sample);
  }
  const std::shared_lock writing_lock(writing_mutex_);
  if (!writer_) return;
  if (!sends_history_) {
    if (!writer_->write(sample)) ++not_sent_;
    return;
  }
  const std::lock_guard sending_lock(sending_mutex_);
  if (!has_sent_all_) return;
  while (send_next()) {
  }
}

/// Most systems have no other process that reads such a topic: its messages then need no memory in the writer. One that
/// reads without asking for earlier messages gets them, too, if it is the first.
void Channel::send_history() {
  for (bool is_left = true; is_left;) {
    const std::shared_lock writing_lock(writing_mutex_);
    if (!writer_ || !sends_history_) return;
    const std::lock_guard sending_lock(sending_mutex_);
    if (has_sent_all_ || writer_->matched_readers() == 0) return;
    is_left = send_next();
    has_sent_all_ = !is_left;
  }
}

/// Writes the next messages of the history; false if there are none left.
bool Channel::send_next() {
  constexpr std::size_t kAtOnce = 20;  // a new reader waits so long
  const auto next = history_.after(sent_, kAtOnce);
  for (const auto& entry : next) {
    sent_ = entry.number;
    if (entry.is_from_here && !writer_->write(Sample::unread(entry.sample))) ++not_sent_;
  }
  return !next.empty();
}

/// Received bytes that only recorders and other processes read are not decoded here; their readers check them.
bool Channel::is_to_be_checked(const Sample& sample) const {
  if (!topic().type) return false;
  if (sample.received_size() == 0) return true;
  const std::shared_lock lock(mutex_);
  return has_readers_of_valid();
}

Channel::Verdict Channel::check(const SamplePtr& sample) {
  if (!is_to_be_checked(*sample)) return Verdict::kNotChecked;
  return is_rejected(sample) ? Verdict::kInvalid : Verdict::kValid;
}

bool Channel::is_rejected(const SamplePtr& sample) {
  const auto problem = problem_of(*sample, limits_.max_message_bytes);
  if (!problem || !rejections_.add(topic().name, *problem, sample->sender())) return problem.has_value();
  const std::lock_guard lock(untold_mutex_);
  untold_.emplace_back(sample->sender(), *problem);
  return true;
}

void Channel::deliver(const SamplePtr& sample, Verdict verdict, bool is_from_here) {
  const bool is_valid = verdict != Verdict::kInvalid;
  if (!is_valid && !bridge_) tell_rejected();  // no bridge, so no sender lookup
  const std::shared_lock lock(mutex_);
  const auto& qos = is_from_here ? offered_ : requested_;
  const bool is_latched = is_valid && qos.durability == Durability::kTransientLocal;
  const SamplePtr passed = is_latched ? history_.add(sample, is_from_here, verdict == Verdict::kValid) : sample;
  for (const auto& [owner, reader, wants] : readers_) {
    // A reader that knows the type may have come since the message was made.
    if (is_valid || wants == Wants::kAll) reader(topic(), typed(Sample::unread(passed)));
  }
}

RejectedMessages::Count Channel::rejected() const {
  auto rejected = rejections_.snapshot()[topic().name];
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
    warn_(fmt::format("{}: a message from {} was dropped: {}", topic().name, shown_sender(sender), reason));
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

bool Channel::wait_for_acknowledgments(std::chrono::milliseconds limit) {
  send_history();
  const std::shared_lock writing_lock(writing_mutex_);
  return !writer_ || writer_->wait_for_acknowledgments(limit);
}

Channel::Counters Channel::counters() const {
  Counters counters{.published = published_, .not_sent = not_sent_};
  {
    const std::shared_lock writing_lock(writing_mutex_);
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

}  // namespace panvo::runtime
