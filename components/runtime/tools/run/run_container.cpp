// SPDX-License-Identifier: Apache-2.0
#include "run_container.hpp"

#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>

#include "await_peers.hpp"
#include "console.hpp"
#include "container_name.hpp"
#include "link.hpp"
#include "panvo/runtime/container.hpp"
#include "panvo/runtime/names.hpp"
#include "panvo_msgs/msg/OdometryQuality.h"
#include "stop_signals.hpp"
#include "taken_names.hpp"

namespace panvo::runtime {
namespace {

bool ends_with_any(const std::string& name, std::initializer_list<const char*> ends) {
  for (const char* end : ends) {
    if (name.ends_with(end)) return true;
  }
  return false;
}

/// Counts stereo frames in and poses out, and writes the result files.
class Results {
 public:
  Results(Container& container, RunFiles* files, std::function<void(const std::string&)> failed)
      : files_(files), failed_(std::move(failed)) {
    container.observe(
        [this](const TopicDescription& topic) {
          return is_frame_in(topic) || is_frame_out(topic) || is_quality(topic) || (files_ && files_->wants(topic));
        },
        [this](const TopicDescription& topic, const SamplePtr& sample) { take(topic, sample); });
  }

  std::uint64_t frames_in() const { return frames_in_; }
  std::uint64_t frames_out() const { return frames_out_; }
  std::uint64_t frames_unreliable() const { return frames_unreliable_; }

 private:
  static bool is_frame_in(const TopicDescription& topic) {
    return ends_with_any(topic.name, {"stereo/left/image_rect"});
  }
  static bool is_frame_out(const TopicDescription& topic) { return ends_with_any(topic.name, {"odometry/binocular"}); }
  static bool is_quality(const TopicDescription& topic) {
    return topic.name.ends_with("odometry/quality") &&
           topic.type_name == interfaces::message_type<panvo_msgs::msg::OdometryQuality>().name;
  }

  static bool is_reliable(const SamplePtr& sample) {
    try {
      const auto quality = Sample::as<panvo_msgs::msg::OdometryQuality>(sample);
      return quality && quality->reliable();
    } catch (const interfaces::DecodeError&) {  // undecodable
      return false;
    }
  }

  void take(const TopicDescription& topic, const SamplePtr& sample) {
    frames_in_ += is_frame_in(topic);
    frames_out_ += is_frame_out(topic);
    frames_unreliable_ += is_quality(topic) && !is_reliable(sample);
    if (!files_ || !files_->wants(topic)) return;
    const std::lock_guard lock(mutex_);
    if (broken_) return;
    try {
      files_->write(topic, sample);
    } catch (const std::exception& error) {
      broken_ = true;
      failed_(error.what());
    }
  }

  RunFiles* files_;
  std::function<void(const std::string&)> failed_;
  std::atomic<std::uint64_t> frames_in_ = 0, frames_out_ = 0, frames_unreliable_ = 0;
  std::mutex mutex_;
  bool broken_ = false;
};

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

/// Reports a run that played or wrote nothing as a problem.
std::vector<std::string> find_nothing(const RunOptions& options, const Container& container, const RunFiles* files) {
  std::vector<std::string> problems;
  if (container.links().has_source && container.source_steps() == 0) {
    problems.emplace_back("nothing was played: the data has no messages, or none of the selected topics");
  }
  // With several containers, some may publish no recorded topic.
  if (files && !files->has_lines() && !options.link_in && options.container.empty()) {
    problems.push_back("nothing was written to " + options.out +
                       ": no odometry, landmark or other result was published");
  }
  return problems;
}

std::vector<std::string> node_names(const ContainerDescription& container) {
  std::vector<std::string> names{full_name(container.name_space, node_name(container))};
  for (const auto& component : container.components) names.push_back(full_name(component.name_space, component.name));
  return names;
}

}  // namespace

ExitStatus run_container(const RunOptions& options, const ContainerDescription& description,
                         const std::vector<std::string>& notes) {
  const auto start = std::chrono::steady_clock::now();
  Container* running = nullptr;
  std::atomic<bool> stop = false;
  std::atomic<int> signal = 0;
  std::mutex running_mutex;
  const StopSignals signals([&](int caught) {
    signal = caught;
    stop = true;
    const std::lock_guard lock(running_mutex);
    if (running) running->request_stop();
  });

  std::unique_ptr<RunFiles> files;
  if (!options.out.empty()) files = std::make_unique<RunFiles>(options.out);
  Console console(files ? std::filesystem::path(options.out) / "run.log" : "",
                  options.verbose ? LogLevel::kDebug : LogLevel::kInfo);
  const Logger::Write log = [&](LogLevel level, const std::string& component, const std::string& text) {
    console.log(level, component, text);
  };

  ContainerOptions container_options{.replay = options.replay, .rate = options.rate, .seed = options.seed, .log = log};
  container_options.limits = {.max_message_bytes = static_cast<std::size_t>(description.max_message_mb * 1e6),
                              .max_topic_rate_hz = description.max_topic_rate_hz};
  container_options.again = options.again;
  if (!options.local && !options.replay) {
    container_options.dds = options.dds;
    container_options.dds->limits = container_options.limits;
    container_options.dds->name = description.name;
    container_options.dds->shared_image_bytes = static_cast<std::uint32_t>(description.shared_images_mb * 1e6);
    if (description.requests_per_s) container_options.dds->requests_per_s = *description.requests_per_s;
    container_options.name = node_name(description);
    container_options.name_space = description.name_space;
    container_options.services = description.services;
    container_options.files_below = description.files_below;
  }
  std::optional<TakenNames> taken_names;
  if (container_options.dds) taken_names.emplace(*container_options.dds, node_names(description));
  Container container(std::move(container_options));
  std::vector<std::string> problems;
  Results results(container, files.get(), [&](const std::string& what) {
    console.log(LogLevel::kError, "container", what);
    problems.push_back(what);
    container.request_stop();
  });
  for (const auto& note : notes) console.log(LogLevel::kWarning, "container", note);
  container.load_all(description.components);
  if (taken_names) taken_names->refuse();
  {
    const std::lock_guard lock(running_mutex);
    running = &container;
    if (stop) container.request_stop();
  }
  container.on_progress([&](Source::Progress progress) { console.progress(progress); });
  container.start();
  if (options.link_in && options.link_out) Link(*options.link_in, *options.link_out).meet(container, log);
  await_peers(container, options.awaited, stop, log);
  for (auto& problem : container.run()) problems.push_back(std::move(problem));
  console.end_progress();
  {
    const std::lock_guard lock(running_mutex);
    running = nullptr;
  }

  const bool is_interrupted = container.was_interrupted() && signal != 0;
  if (is_interrupted) {
    console.log(LogLevel::kWarning, "container", "interrupted before the end of the data");
  } else {
    for (auto& problem : find_nothing(options, container, files.get())) {
      console.log(LogLevel::kWarning, "container", problem);
      problems.push_back(std::move(problem));
    }
  }
  const ExitStatus status = is_interrupted     ? interrupted_by(signal)
                            : problems.empty() ? ExitStatus::kOk
                                               : ExitStatus::kRunFailed;
  std::uint64_t dropped = 0;
  for (const auto& queue : container.queue_counters()) {
    dropped += queue.dropped;
    if (queue.dropped > 0) {
      console.log(LogLevel::kWarning, queue.component,
                  fmt::format("dropped {} of {} messages of {}", queue.dropped, queue.received, queue.input));
    }
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  const double peak_memory_mb = static_cast<double>(usage.ru_maxrss) / 1024.0;
  if (results.frames_out() > 0) {
    console.log(
        LogLevel::kInfo, "container",
        fmt::format(
            "{} stereo frames in, {} poses out, {} of them without a measured motion, {} messages dropped; {:.1f} s, "
            "{:.1f} s CPU, {:.0f} MB peak",
            results.frames_in(), results.frames_out(), results.frames_unreliable(), dropped, wall_s, cpu_s,
            peak_memory_mb));
  }
  if (files) {
    RunSummary summary;
    summary.frames_in = results.frames_in();
    summary.frames_out = results.frames_out();
    summary.frames_unreliable = results.frames_unreliable();
    summary.queues = container.queue_counters();
    summary.cpu_s = cpu_s;
    summary.wall_s = wall_s;
    summary.peak_memory_mb = peak_memory_mb;
    summary.version = kRuntimeVersion;
    summary.seed = options.seed;
    summary.replay = options.replay;
    summary.system_file = options.system_file;
    summary.changed_parameters = container.changed_parameters();
    summary.problems = problems;
    summary.interrupted = is_interrupted;
    summary.exit_status = static_cast<int>(status);
    files->finish(summary, container.stage_times());
  }
  return status;
}

}  // namespace panvo::runtime
