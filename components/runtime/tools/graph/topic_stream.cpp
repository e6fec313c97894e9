// SPDX-License-Identifier: Apache-2.0
// Commands that read a topic continuously.
#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <deque>
#include <iostream>
#include <mutex>
#include <optional>

#include "panvo/interfaces/message_text.hpp"
#include "topic_commands.hpp"

namespace panvo::runtime::graph {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// Messages of a topic. Keeps the newest if they arrive faster than they are taken.
class Stream {
 public:
  struct Arrival {
    SamplePtr sample;
    steady_clock::time_point at;
  };

  Stream(Session& session, const TopicReading& reading) {
    const TopicDescription topic = describe(session, reading);
    type_ = topic.type;
    type_name_ = topic.type_name;
    reader_ = session.bridge().open_reader(topic, [this](const SamplePtr& sample) { take(sample); });
  }

  /// nullopt at the limit or after Ctrl-C.
  std::optional<Arrival> next(milliseconds limit) {
    constexpr milliseconds kLookForStop{50};
    const auto end = steady_clock::now() + limit;
    std::unique_lock lock(mutex_);
    while (arrivals_.empty()) {
      if (is_stopped() || steady_clock::now() >= end) return std::nullopt;
      came_.wait_until(lock, std::min(end, steady_clock::now() + kLookForStop));
    }
    Arrival arrival = std::move(arrivals_.front());
    arrivals_.pop_front();
    return arrival;
  }

  bool has_writer() const { return reader_->matched_writers() > 0; }

  const interfaces::MessageType* type() const { return type_; }
  const std::string& type_name() const { return type_name_; }
  std::uint64_t skipped() const { return skipped_; }

 private:
  static constexpr std::size_t kMaxWaiting = 200;

  static bool is_writer(const GraphEndpoint& endpoint, const TopicReading& reading) {
    return endpoint.kind == EndpointKind::kTopic && endpoint.is_writer && endpoint.name == reading.topic;
  }

  /// Requests a QoS that all writers offer, so all are received.
  static TopicDescription describe(Session& session, const TopicReading& reading) {
    const auto is_it = [&](const GraphEndpoint& endpoint) { return is_writer(endpoint, reading); };
    const Graph graph = session.graph_with(
        [&](const Graph& known) { return std::any_of(known.endpoints.begin(), known.endpoints.end(), is_it); });
    TopicDescription topic{reading.topic, reading.type_name, {}, nullptr};
    topic.qos.durability = interfaces::Durability::kTransientLocal;
    bool is_written = false;
    for (const auto& endpoint : graph.endpoints) {
      if (!is_it(endpoint)) continue;
      is_written = true;
      if (topic.type_name.empty()) topic.type_name = endpoint.type_name;
      if (endpoint.qos.requested == interfaces::Reliability::kBestEffort)
        topic.qos.requested = interfaces::Reliability::kBestEffort;
      if (endpoint.qos.durability == interfaces::Durability::kVolatile)
        topic.qos.durability = interfaces::Durability::kVolatile;
    }
    if (!is_written && reading.type_name.empty())
      throw Failure("no publisher of " + reading.topic + " (panvo topic list); use --type to wait for one");
    if (!is_written) topic.qos.durability = interfaces::Durability::kVolatile;
    topic.qos.depth = kMaxWaiting;
    topic.type = interfaces::find_message_type(topic.type_name);
    return topic;
  }

  void take(const SamplePtr& sample) {
    const std::lock_guard lock(mutex_);
    arrivals_.push_back({sample, steady_clock::now()});
    if (arrivals_.size() > kMaxWaiting) {
      arrivals_.pop_front();
      ++skipped_;
    }
    came_.notify_one();
  }

  const interfaces::MessageType* type_ = nullptr;
  std::string type_name_;
  std::mutex mutex_;
  std::condition_variable came_;
  std::deque<Arrival> arrivals_;
  std::atomic<std::uint64_t> skipped_ = 0;
  std::unique_ptr<BridgeReader> reader_;  // last: its callback is take()
};

constexpr milliseconds kForEver = std::chrono::hours(24 * 365);
constexpr milliseconds kReportPeriod{1000};

/// The first message; nullopt after Ctrl-C. Without --count, waits beyond the timeout if there is a publisher, as that of
/// a paused bag.
std::optional<Stream::Arrival> first_of(Session& session, Stream& stream, const TopicReading& reading) {
  auto first = stream.next(session.timeout());
  if (first || is_stopped()) return first;
  if (reading.count > 0 || !stream.has_writer())
    throw Failure("no message received on " + reading.topic + " in time (--timeout waits longer)");
  std::cerr << "panvo: waiting: " << reading.topic << " has a publisher, which has sent nothing yet\n";
  return stream.next(kForEver);
}

/// Collects messages and reports on the newest `window` of them once per second. After a silence it starts over.
template <class Report>
void watch(const SessionOptions& options, const TopicReading& reading, const Report& report) {
  Session session(options);
  Stream stream(session, reading);
  std::deque<Stream::Arrival> window;
  auto first = first_of(session, stream, reading);
  if (!first) return;
  window.push_back(std::move(*first));
  for (std::size_t reports = 0; (reading.count == 0 || reports < reading.count) && !is_stopped(); ++reports) {
    const auto end = steady_clock::now() + kReportPeriod;
    const auto left = [&] { return std::chrono::duration_cast<milliseconds>(end - steady_clock::now()); };
    bool is_silent = reports > 0;  // the first message counts for the first report
    while (auto arrival = stream.next(left())) {
      is_silent = false;
      window.push_back(std::move(*arrival));
      if (window.size() > reading.window) window.pop_front();
    }
    if (is_stopped()) return;
    if (is_silent) {
      std::printf(stream.has_writer() ? "no new messages\n" : "the publisher is gone\n");
      window.clear();
    } else {
      report(window, stream.skipped());
    }
    std::fflush(stdout);
  }
}

double seconds(steady_clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

void report_rate(const std::deque<Stream::Arrival>& window, std::uint64_t) {
  if (window.size() < 2) {
    std::printf("no new messages\n");
    return;
  }
  double sum = 0, sum_of_squares = 0, least = HUGE_VAL, most = 0;
  for (std::size_t i = 1; i < window.size(); ++i) {
    const double interval = seconds(window[i].at - window[i - 1].at);
    sum += interval;
    sum_of_squares += interval * interval;
    least = std::min(least, interval);
    most = std::max(most, interval);
  }
  const auto count = static_cast<double>(window.size() - 1);
  const double mean = sum / count;
  const double deviation = std::sqrt(std::max(0.0, sum_of_squares / count - mean * mean));
  std::printf("average rate: %.3f\n\tmin: %.4fs max: %.4fs std dev: %.5fs window: %zu\n", 1 / mean, least, most,
              deviation, window.size());
}

void report_bandwidth(const std::deque<Stream::Arrival>& window, std::uint64_t skipped) {
  double sum = 0, least = HUGE_VAL, most = 0;
  for (const auto& arrival : window) {
    const auto size = static_cast<double>(arrival.sample->bytes().size());
    sum += size;
    least = std::min(least, size);
    most = std::max(most, size);
  }
  const double span = seconds(steady_clock::now() - window.front().at);
  const auto count = static_cast<double>(window.size());
  std::printf("%.1f KB/s from %zu messages\n\tmessage size mean: %.0f B min: %.0f B max: %.0f B\n", sum / span / 1000,
              window.size(), sum / count, least, most);
  if (skipped > 0)
    std::printf("\t%llu messages came too fast and were skipped\n", static_cast<unsigned long long>(skipped));
}

}  // namespace

void echo(const SessionOptions& options, const TopicReading& reading) {
  Session session(options);
  Stream stream(session, reading);
  if (!stream.type()) {
    throw Failure("the type " + stream.type_name() + " " + interfaces::why_unknown(stream.type_name()) +
                  ". Without it `panvo topic hz` and `bw` work, echo does not");
  }
  for (std::size_t shown = 0; reading.count == 0 || shown < reading.count;) {
    const auto arrival = shown == 0 ? first_of(session, stream, reading) : stream.next(kForEver);
    if (!arrival) return;
    try {
      std::cout << interfaces::to_yaml(*stream.type(), arrival->sample->bytes(), reading.whole ? 0 : 128) << "---"
                << std::endl;
      ++shown;
    } catch (const interfaces::DecodeError& error) {
      std::cerr << "panvo: malformed message: " << error.what() << "\n";
    }
  }
}

void hz(const SessionOptions& options, const TopicReading& reading) { watch(options, reading, report_rate); }
void bw(const SessionOptions& options, const TopicReading& reading) { watch(options, reading, report_bandwidth); }

}  // namespace panvo::runtime::graph
