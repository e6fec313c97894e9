// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "latched_messages.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/recorder/bag_reader.hpp"
#include "panvo/recorder/topic_filter.hpp"
#include "panvo/runtime/component.hpp"
#include "player_services.hpp"

namespace panvo::recorder {
namespace {

struct PlayerParameters {
  std::string directory;
  std::vector<std::string> topics;
  std::vector<std::string> exclude;
  bool wait_at_end = false;
  bool start_paused = false;

  template <class Field>
  static void describe(Field&& field) {
    using P = PlayerParameters;
    field.path(&P::directory, "directory", "folder of the bag, or one .db3 or .mcap file");
    field(&P::topics, "topics", "", "topics to play: names or regular expressions for whole names; empty: all");
    field(&P::exclude, "exclude", "", "topics not to play: names or regular expressions for whole names");
    field(&P::wait_at_end, "wait_at_end", "", "live, the run does not end with the bag, so that seek can go back");
    field(&P::start_paused, "start_paused", "", "live, nothing is played before ~/resume is called");
  }
};

std::string absolute_name(const std::string& name) {
  return name.starts_with('/') ? name : std::string("/").append(name);
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

/// Plays the messages of a bag, unchanged, at their recorded times. Topics that this container publishes itself are not
/// played, so that recorded and newly computed messages do not mix. Live, services as those of rosbag2's player pause it
/// and move it to another time.
class BagPlayerComponent final : public runtime::Component, public runtime::Source {
 public:
  explicit BagPlayerComponent(runtime::Context& context) : context_(context) {
    const auto parameters = context.parameters<PlayerParameters>();
    if (parameters.directory.empty()) {
      throw runtime::ConfigError(context.name() + ": parameter directory is empty; set directory: FOLDER");
    }
    try {
      open(parameters);
    } catch (const BagError& error) {
      throw runtime::ConfigError(context.name() + ": " + error.what());
    }
    waits_at_end_ = parameters.wait_at_end;
    if (parameters.start_paused) context.playback().pause();
    context.source(*this);
    offer_player_services(context);
  }

  std::optional<std::int64_t> next_stamp_ns() override {
    const std::lock_guard lock(seek_mutex_);
    if (const auto time_ns = std::exchange(sought_ns_, std::nullopt)) move_to(*time_ns);
    return message_ ? std::optional(message_->timestamp_ns) : std::nullopt;
  }

  std::optional<runtime::StampRange> range() const override {
    const auto& metadata = bag_->metadata();
    return runtime::StampRange{metadata.start_ns, metadata.start_ns + metadata.duration_ns};
  }

  /// The player's thread moves the bag when it asks for the next stamp.
  void seek(std::int64_t stamp_ns) override {
    const std::lock_guard lock(seek_mutex_);
    sought_ns_ = stamp_ns;
  }

  void emit() override {
    if (!message_) return;
    const LatchedMessages before = std::exchange(latched_, LatchedMessages(kMaxLatchedBytes));
    for (const auto& latched : before.all()) {
      outputs_[static_cast<std::size_t>(latched.topic)]->publish(latched.data);
    }
    const auto stamp_ns = message_->timestamp_ns;
    while (message_ && message_->timestamp_ns == stamp_ns) {
      outputs_[message_->topic]->publish(std::move(message_->data));
      if (progress_.done < progress_.total) ++progress_.done;  // not after it was moved back
      advance();
    }
  }

  Progress progress() const override { return progress_; }
  bool waits_at_end() const override { return waits_at_end_; }

 private:
  void open(const PlayerParameters& parameters) {
    bag_ = std::make_unique<BagReader>(parameters.directory);
    for (const auto& warning : bag_->warnings()) {
      context_.log().warn("{}", warning);
    }
    warnings_told_ = bag_->warnings().size();
    const auto& metadata = bag_->metadata();
    if (metadata.message_count == 0) {
      throw BagError(bag_->path().string() + ": contains no messages; `panvo bag info` shows the contents of a bag");
    }
    const TopicFilter filter(parameters.topics, parameters.exclude);
    refuse_unmatched(filter);
    std::vector<std::string> computed_here;
    for (const auto& topic : metadata.topics) {
      outputs_.push_back(filter.accepts(topic.name) ? open_output(topic, computed_here) : nullptr);
      if (outputs_.back()) {
        progress_.total += topic.message_count;
      }
    }
    if (!computed_here.empty()) {
      context_.log().info("not played because this system publishes them itself: {}", listed(computed_here));
    }
    if (progress_.total == 0) {
      throw BagError(bag_->path().string() + ": no messages selected to play; check the parameters topics and exclude");
    }
    context_.log().info("playing {} of {} messages of {}", progress_.total, metadata.message_count,
                        bag_->path().string());
  }

  bool is_played(const BagTopic& topic) const {
    // By name and type, since a name may have been recorded with two types.
    const auto& topics = bag_->metadata().topics;
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      if (topics[i].name == topic.name && topics[i].type == topic.type) return outputs_[i] != nullptr;
    }
    return false;
  }

  /// Collects earlier latched messages to be played again: viewers drop them when the time goes back, and never saw those
  /// that were skipped.
  void move_to(std::int64_t time_ns) {
    latched_ = LatchedMessages(kMaxLatchedBytes);
    if (time_ns > bag_->metadata().start_ns) {
      bag_->select([this](const BagTopic& topic) { return is_played(topic) && is_latched(topic); });
      for (advance(); message_ && message_->timestamp_ns < time_ns; advance()) {
        latched_.add(static_cast<int>(message_->topic), message_->data);
      }
    }
    bag_->select([this](const BagTopic& topic) { return is_played(topic); }, time_ns);
    advance();
  }

  void refuse_unmatched(const TopicFilter& filter) const {
    std::vector<std::string> names;
    for (const auto& topic : bag_->metadata().topics) {
      names.push_back(topic.name);
    }
    if (const auto unmatched = filter.unmatched(names); !unmatched.empty()) {
      throw BagError(bag_->path().string() + ": no topic matches " + listed(unmatched) + "; the bag has " +
                     listed(names));
    }
  }

  std::shared_ptr<runtime::UntypedOutput> open_output(const BagTopic& topic, std::vector<std::string>& computed_here) {
    const auto name = absolute_name(topic.name);
    if (context_.is_published(name)) {
      computed_here.push_back(name);
      return nullptr;
    }
    if (topic.serialization_format != "cdr") {
      context_.log().warn("{} is not played: serialization format is {}, not cdr", name, topic.serialization_format);
      return nullptr;
    }
    const auto type = full_type_name(topic.type);
    // Bags of early versions and of other tools store no QoS; /tf_static is always latched.
    const bool is_known_latched = topic.offered_qos_profiles.empty() && name == topics::kTfStatic.name;
    const auto qos =
        is_known_latched ? interfaces::qos::kLatched : replay_qos(topic.offered_qos_profiles, topic.message_count);
    return context_.open_output({name, type, qos, interfaces::find_message_type(type)});
  }

  void advance() {
    message_ = bag_->next();
    const auto& warnings = bag_->warnings();
    for (; warnings_told_ < warnings.size(); ++warnings_told_) {
      context_.log().warn("{}", warnings[warnings_told_]);
    }
    if (!message_ && bag_->lost_messages() > 0) {
      context_.log().warn("{}: {} messages could not be read", bag_->path().string(), bag_->lost_messages());
    }
  }

  static constexpr std::size_t kMaxLatchedBytes = 64 << 20;

  runtime::Context& context_;
  std::unique_ptr<BagReader> bag_;
  std::vector<std::shared_ptr<runtime::UntypedOutput>> outputs_;  // by the bag's topics; nullptr: not played
  BagMessage* message_ = nullptr;                                 // the next one to play
  std::mutex seek_mutex_;
  std::optional<std::int64_t> sought_ns_ = INT64_MIN;  // the bag is to be read from there
  LatchedMessages latched_{kMaxLatchedBytes};          // of before, to be played first
  bool waits_at_end_ = false;
  std::size_t warnings_told_ = 0;
  Progress progress_;
};

}  // namespace
}  // namespace panvo::recorder

namespace {
using panvo::recorder::BagPlayerComponent;
}
PANVO_REGISTER_COMPONENT(BagPlayerComponent)
