// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "panvo/recorder/bag_writer.hpp"
#include "panvo/recorder/topic_filter.hpp"
#include "panvo/runtime/component.hpp"
#include "rcl_interfaces/msg/Log.h"
#include "recorder_parameters.hpp"
#include "recorder_services.hpp"
#include "rosbag2_interfaces/msg/WriteSplitEvent.h"
#include "write_queue.hpp"

namespace panvo::recorder {
namespace {

using runtime::SamplePtr;
using runtime::TopicDescription;

/// As rosbag2's recorder tells that it has started another file.
constexpr interfaces::Topic<rosbag2_interfaces::msg::WriteSplitEvent> kWriteSplit{"events/write_split",
                                                                                  interfaces::qos::kDefault};

bool is_image(const TopicDescription& topic) {
  return topic.type_name == "sensor_msgs/msg/Image" || topic.type_name == "sensor_msgs/msg/CompressedImage";
}

bool is_hidden(const TopicDescription& topic) { return topic.name.find("/_") != std::string::npos; }

/// Runs `action`; converts a BagError to a ConfigError.
template <class Action>
auto as_configuration(const std::string& component, Action action) {
  try {
    return action();
  } catch (const BagError& error) {
    throw runtime::ConfigError(component + ": " + error.what());
  }
}

/// A process that replaces a crashed one keeps the bag of that one and records to NAME_2, NAME_3 ...
std::filesystem::path folder_of(const RecorderParameters& parameters, bool is_again) {
  std::filesystem::path folder = parameters.output.empty() ? dated_bag_name() : parameters.output;
  const auto name = (folder / "").parent_path().string();  // without a slash at the end
  for (int i = 2; is_again && std::filesystem::exists(folder); ++i) folder = name + "_" + std::to_string(i);
  return folder;
}

std::unique_ptr<BagWriter> make_writer(const RecorderParameters& parameters, bool is_again) {
  const BagWriter::Options options{.overwrite = parameters.overwrite && !is_again,
                                   .max_file_bytes = static_cast<std::uint64_t>(parameters.max_file_mb * 1e6),
                                   .max_file_time = std::chrono::nanoseconds(std::llround(parameters.max_file_s * 1e9)),
                                   .max_files = static_cast<std::size_t>(parameters.max_files),
                                   .storage = storage_from_text(parameters.storage),
                                   .compression = compression_from_text(parameters.compression)};
  return std::make_unique<BagWriter>(folder_of(parameters, is_again), options);
}

/// Records topics to a bag. Messages wait in a queue of bounded size, and a second stage writes them. A short delay of
/// the disk therefore delays no publisher; a longer one drops messages, which are counted by topic.
class RecorderComponent final : public runtime::Component {
 public:
  explicit RecorderComponent(runtime::Context& context)
      : context_(context),
        parameters_(context.parameters<RecorderParameters>()),
        filter_(
            as_configuration(context.name(), [this] { return TopicFilter(parameters_.topics, parameters_.exclude); })),
        writer_(as_configuration(context.name(), [&, this] { return make_writer(parameters_, context.is_again()); })),
        splits_(context.output(kWriteSplit)),
        is_paused_(parameters_.start_paused),
        waiting_(static_cast<std::size_t>(parameters_.queue_mb) * 1'000'000, kMaxWaiting),
        writing_(context.stage<Turn>("write", kMaxWaiting, [this](Turn) { write_next(); })) {
    context.tap([this](const TopicDescription& topic) { return is_wanted(topic); }, kTapDepth,
                [this](const TopicDescription& topic, const SamplePtr& sample) { take(topic, sample); });
    context.on_end([this] {
      finish();
      if (writer_->committed_messages() + writer_->lost_messages() == 0) {
        throw BagError("nothing was recorded to " + writer_->path().string() +
                       ": no messages arrived on the selected topics");
      }
    });
    offer_recorder_services(context, {.set_paused = [this](bool paused) { set_paused(paused); },
                                      .is_paused = [this] { return is_paused_.load(); },
                                      .split = [this] { request_split(); }});
    if (parameters_.max_files > 0 && parameters_.max_file_mb <= 0.0 && parameters_.max_file_s <= 0.0) {
      context.log().warn(
          "max_files limits nothing without max_file_mb or max_file_s, unless ~/split_bagfile is called");
    }
    context.log().info("recording to {}{}{}", writer_->path().string(), is_paused_ ? ", paused" : "",
                       context.is_again() ? "; what was recorded before the crash is kept" : "");
  }

  ~RecorderComponent() override {
    try {
      finish();
    } catch (const BagError& error) {
      context_.log().error("{}", error.what());
    }
  }

 private:
  using Waiting = WriteQueue::Item;
  struct Turn {};  // tells the writing stage to write one more

  static constexpr std::size_t kTapDepth = 10'000;     // not reached, since take() is fast
  static constexpr std::size_t kMaxWaiting = 100'000;  // limit for messages too small to fill queue_mb

  static constexpr std::int64_t kRelativeTimes =
      86'400'000'000'000;  // earlier times are relative, not system time: 1 day

  static constexpr std::chrono::seconds kPatience{5};  // with a slow disk; the process is killed after 20 s

  /// Runs once, at the end of the run or when the component is unloaded; its threads have stopped.
  void finish() {
    if (std::exchange(is_finished_, true)) {
      return;
    }
    if (const auto left_out = describe_left_out(); !left_out.empty()) {
      context_.log().warn("{}", left_out);
    }
    std::optional<BagError> failure;
    try {
      write_rest();
    } catch (const BagError& error) {
      failure = error;
    }
    waiting_.close();
    count_dropped();
    writer_->close();
    if (failure) {
      throw *failure;
    }
    context_.log().info("recorded {} messages to {}, {} dropped", writer_->committed_messages(),
                        writer_->path().string(), writer_->dropped_messages());
  }

  void write_rest() {
    const auto give_up = std::chrono::steady_clock::now() + kPatience;
    while (std::chrono::steady_clock::now() < give_up && write_next()) {
    }
    store_early(0);
  }

  bool is_chosen(const TopicDescription& topic) const {
    return filter_.accepts(topic.name) && (parameters_.include_images || !is_image(topic)) &&
           (parameters_.include_hidden || !is_hidden(topic));
  }

  /// Called by the thread that creates or discovers a topic. Must not log: the caller may hold locks that logging
  /// needs.
  bool is_wanted(const TopicDescription& topic) {
    if (!is_chosen(topic)) {
      return false;
    }
    const std::lock_guard lock(topics_mutex_);
    if (wanted_topics_.contains(topic.name)) {
      return true;
    }
    if (wanted_topics_.size() < static_cast<std::size_t>(parameters_.max_topics)) {
      wanted_topics_.insert(topic.name);
      return true;
    }
    if (left_out_.insert(topic.name).second) {
      context_.rejections().add("topics beyond max_topics", topic.name);
      is_news_left_out_ = true;
    }
    return false;
  }

  std::string describe_left_out() {
    const std::lock_guard lock(topics_mutex_);
    if (left_out_.empty()) {
      return "";
    }
    return fmt::format("{} topics are skipped, e.g. {}: max_topics is {}; increase it or select topics",
                       left_out_.size(), *left_out_.begin(), parameters_.max_topics);
  }

  /// Whether this is a log message of the recorder itself. These are not recorded, since they contain the bag's path
  /// and would make two recordings of the same messages differ.
  bool is_own_log(const TopicDescription& topic, const SamplePtr& sample) const {
    if (topic.type_name != "rcl_interfaces/msg/Log") {
      return false;
    }
    try {
      const auto log = runtime::Sample::as<rcl_interfaces::msg::Log>(sample);
      return log && log->name() == context_.name();
    } catch (const interfaces::DecodeError&) {
      return false;
    }
  }

  void take(const TopicDescription& topic, const SamplePtr& sample) {
    if (is_paused_ || is_own_log(topic, sample)) {
      return;
    }
    if (is_news_left_out_.exchange(false)) {
      context_.log().warn_throttled("max_topics", "{}", describe_left_out());
    }
    if (waiting_.push(topic, sample)) {
      writing_.push({});
    } else if (!waiting_.is_closed()) {  // else the failure has been logged
      tell_dropped();
    }
  }

  void set_paused(bool paused) {
    if (is_paused_.exchange(paused) == paused) {
      return;
    }
    context_.log().info("{}", paused ? "paused" : "recording again");
  }

  /// In the order of the messages: those received before it are in the file that is closed.
  void request_split() {
    waiting_.push_split();
    writing_.push({});
  }

  void split() {
    writer_->split();
    tell_splits();
  }

  void tell_splits() {
    for (const auto& split : writer_->take_splits()) {
      rosbag2_interfaces::msg::WriteSplitEvent event;
      event.closed_file(split.closed.string());
      event.opened_file(split.opened.string());
      event.node_name(full_name());
      splits_.publish(event);
    }
  }

  /// With the namespace.
  std::string full_name() const {
    const auto below = context_.resolved_name("~/any");
    return below.substr(0, below.rfind('/'));
  }

  void tell_dropped() {
    ++all_dropped_;
    if ((all_dropped_ & (all_dropped_ - 1)) == 0) {  // log the 1st, 2nd, 4th, 8th ...
      context_.log().warn("{} messages dropped: writing to {} is too slow; record fewer topics or use a faster disk",
                          all_dropped_, writer_->path().string());
    }
  }

  /// False if nothing waits. A BagError stops the writing stage, and nothing more is written.
  bool write_next() {
    auto next = waiting_.pop();
    if (!next) {
      return false;
    }
    try {
      write(std::move(*next));
    } catch (const BagError&) {
      waiting_.close();
      throw;
    }
    return true;
  }

  void write(Waiting message) {
    if (message.topic == nullptr) {
      waiting_.release(message);
      split();
      return;
    }
    const auto time_ns = message.sample->time_ns();
    if (time_ns == 0) {
      early_.push_back(std::move(message));
      return;
    }
    store_early(time_ns);
    store(message, time_ns);
  }

  /// Stores the messages published before the replay clock was set by the first step of a source. They get the time of
  /// the first message with a time, or 0 if that is below kRelativeTimes, as in datasets with relative times.
  void store_early(std::int64_t first_ns) {
    const auto time_ns = first_ns < kRelativeTimes ? 0 : first_ns;
    for (const auto& message : std::exchange(early_, {})) {
      store(message, time_ns);
    }
  }

  void store(const Waiting& message, std::int64_t time_ns) {
    const auto& bytes = message.sample->bytes();
    const auto [place, is_new] = handles_.try_emplace(message.topic->name, -1);
    if (is_new) {
      place->second = add_topic(*message.topic);
    }
    count_dropped();
    writer_->write(place->second, time_ns, bytes);
    waiting_.release(message);
    tell_splits();
  }

  void count_dropped() {
    for (const auto& [topic, count] : waiting_.take_dropped()) {
      writer_->count_dropped(topic, count);
    }
  }

  int add_topic(const TopicDescription& topic) {
    BagTopic description;
    description.name = topic.name;
    description.type = topic.type_name;
    description.offered_qos_profiles = {offered_profile(topic.qos)};
    if (topic.type) {
      description.type_description_hash = topic.type->hash;
    }
    return writer_->add_topic(description, topic.type ? topic.type->definition : std::string_view());
  }

  runtime::Context& context_;
  const RecorderParameters parameters_;
  const TopicFilter filter_;
  const std::unique_ptr<BagWriter> writer_;
  runtime::Output<rosbag2_interfaces::msg::WriteSplitEvent> splits_;  // used by the writing stage
  std::atomic<bool> is_paused_;
  WriteQueue waiting_;
  runtime::Stage<Turn> writing_;

  std::mutex topics_mutex_;  // guards the next two
  std::set<std::string> wanted_topics_, left_out_;
  std::atomic<bool> is_news_left_out_ = false;
  std::uint64_t all_dropped_ = 0;       // used by take()
  std::map<std::string, int> handles_;  // this and the following: used by the writing stage
  std::vector<Waiting> early_;
  bool is_finished_ = false;
};

}  // namespace
}  // namespace panvo::recorder

namespace {
using panvo::recorder::RecorderComponent;
}
PANVO_REGISTER_COMPONENT(RecorderComponent)
