// SPDX-License-Identifier: Apache-2.0
#include "container_process.hpp"

#include <fmt/ranges.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>

#include "await_peers.hpp"
#include "console.hpp"
#include "container_name.hpp"
#include "link.hpp"
#include "panvo/runner/queue_watch.hpp"
#include "panvo/runner/result_writer.hpp"
#include "panvo/runtime/container.hpp"
#include "panvo/runtime/names.hpp"
#include "service_manager.hpp"
#include "stop_signals.hpp"
#include "taken_names.hpp"

namespace panvo::runner {
namespace {

using runtime::Container;
using runtime::ContainerDescription;
using runtime::ContainerOptions;
using runtime::LogLevel;

/// The container that a signal or a failure stops; it may come before the container exists.
class Stop {
 public:
  void request() {
    requested_ = true;
    const std::lock_guard lock(mutex_);
    if (running_) running_->request_stop();
  }
  const std::atomic<bool>& requested() const { return requested_; }

  /// While it exists, requests reach `container`.
  class Reaches {
   public:
    Reaches(Stop& stop, Container& container) : stop_(stop) {
      const std::lock_guard lock(stop_.mutex_);
      stop_.running_ = &container;
      if (stop_.requested_) container.request_stop();
    }
    ~Reaches() {
      const std::lock_guard lock(stop_.mutex_);
      stop_.running_ = nullptr;
    }
    Reaches(const Reaches&) = delete;
    Reaches& operator=(const Reaches&) = delete;

   private:
    Stop& stop_;
  };

 private:
  std::atomic<bool> requested_ = false;
  std::mutex mutex_;
  Container* running_ = nullptr;
};

struct Usage {
  double wall_s, cpu_s, peak_memory_mb;
};

Usage usage_since(std::chrono::steady_clock::time_point start) {
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
  };
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
          seconds(usage.ru_utime) + seconds(usage.ru_stime), static_cast<double>(usage.ru_maxrss) / 1024.0};
}

ContainerOptions make_container_options(const RunOptions& options, const ContainerDescription& description,
                                        const runtime::Logger::Write& log) {
  ContainerOptions result{.replay = options.replay, .rate = options.rate, .seed = options.seed, .log = log};
  result.limits = {.max_message_bytes = static_cast<std::size_t>(description.max_message_mb * 1e6),
                   .max_topic_rate_hz = description.max_topic_rate_hz};
  result.again = options.again;
  result.run_id = options.run_id;
  result.is_part_of_system = options.link_in || !options.container.empty();
  if (options.local || options.replay) return result;
  result.dds = options.dds;
  result.dds->limits = result.limits;
  result.dds->name = description.name;
  result.dds->shared_image_bytes = static_cast<std::uint32_t>(description.shared_images_mb * 1e6);
  if (description.requests_per_s) result.dds->requests_per_s = *description.requests_per_s;
  result.name = node_name(description);
  result.name_space = description.name_space;
  result.parameters = description.parameters;
  result.services = description.services;
  result.files_below = description.files_below;
  return result;
}

std::vector<std::string> node_names(const ContainerDescription& container) {
  std::vector<std::string> names{runtime::full_name(container.name_space, node_name(container))};
  for (const auto& component : container.components) {
    names.push_back(runtime::full_name(component.name_space, component.name));
  }
  return names;
}

/// Reports a run that played or wrote nothing as a problem.
std::vector<std::string> find_nothing(const RunOptions& options, const Container& container, const RunFiles* files) {
  std::vector<std::string> problems;
  if (container.links().has_source && container.source_steps() == 0) {
    problems.emplace_back("nothing was played: the data has no messages, or none of the selected topics");
  }
  // With several containers, some may publish no recorded topic: the launcher judges.
  if (files && files->lines() == 0 && !options.link_in && options.container.empty()) {
    problems.push_back(nothing_written(options.out));
  }
  return problems;
}

/// Logs the components that received nothing from a bag, as when its topics have other names.
void log_idle(const std::string& bag, const Container& container, Console& console) {
  std::map<std::string, std::vector<std::string>> inputs;  // by component
  std::set<std::string> active;
  for (const auto& queue : container.queue_counters()) {
    if (queue.input.starts_with("service ")) continue;  // need not be called
    inputs[queue.component].push_back(queue.input);
    if (queue.received > 0) active.insert(queue.component);
  }
  for (const auto& [component, topics] : inputs) {
    if (active.contains(component)) continue;
    console.log(LogLevel::kWarning, component,
                fmt::format("received nothing on {}; `panvo bag info {}` shows the topics of the bag and how to rename "
                            "them",
                            fmt::join(topics, ", "), bag));
  }
}

/// Logs the messages that each input dropped; returns their sum.
std::uint64_t log_dropped(const Container& container, Console& console) {
  std::uint64_t dropped = 0;
  for (const auto& queue : container.queue_counters()) {
    dropped += queue.dropped;
    if (queue.dropped == 0) continue;
    console.log(LogLevel::kWarning, queue.component,
                fmt::format("dropped {} of {} messages of {}", queue.dropped, queue.received, queue.input));
  }
  return dropped;
}

RunSummary summary_of(const RunOptions& options, const Container& container, const ResultWriter& results,
                      const Usage& usage) {
  RunSummary summary;
  summary.frames_in = results.frames_in();
  summary.frames_out = results.frames_out();
  summary.frames_unreliable = results.frames_unreliable();
  summary.queues = container.queue_counters();
  summary.cpu_s = usage.cpu_s;
  summary.wall_s = usage.wall_s;
  summary.peak_memory_mb = usage.peak_memory_mb;
  summary.version = runtime::kRuntimeVersion;
  summary.seed = options.seed;
  summary.replay = options.replay;
  summary.system_file = options.system_file;
  summary.changed_parameters = container.changed_parameters();
  return summary;
}

/// What a finished run leaves: its problems and status in the log and in the result files.
ExitStatus conclude(const RunOptions& options, const Container& container, RunFiles* files, const ResultWriter& results,
                    std::vector<std::string> problems, int signal, std::chrono::steady_clock::time_point start,
                    Console& console) {
  const bool is_interrupted = container.was_interrupted() && signal != 0;
  if (is_interrupted) {
    console.log(LogLevel::kWarning, "container", "interrupted before the end of the data");
  } else {
    for (auto& problem : find_nothing(options, container, files)) {
      console.log(LogLevel::kWarning, "container", problem);
      problems.push_back(std::move(problem));
    }
    if (!options.bag.empty()) log_idle(options.bag, container, console);
  }
  const ExitStatus status = is_interrupted     ? interrupted_by(signal)
                            : problems.empty() ? ExitStatus::kOk
                                               : ExitStatus::kRunFailed;
  const std::uint64_t dropped = log_dropped(container, console);
  const Usage usage = usage_since(start);
  if (results.frames_out() > 0) {
    console.log(LogLevel::kInfo, "container",
                fmt::format("{} stereo frames in, {} poses out, {} of them without a measured motion, {} messages "
                            "dropped; {:.1f} s, {:.1f} s CPU, {:.0f} MB peak",
                            results.frames_in(), results.frames_out(), results.frames_unreliable(), dropped,
                            usage.wall_s, usage.cpu_s, usage.peak_memory_mb));
  }
  if (files) {
    RunSummary summary = summary_of(options, container, results, usage);
    summary.problems = std::move(problems);
    summary.interrupted = is_interrupted;
    summary.exit_status = static_cast<int>(status);
    files->finish(summary, container.stage_times());
  }
  return status;
}

}  // namespace

ExitStatus run_container(const RunOptions& options, const ContainerDescription& description,
                         const std::vector<std::string>& notes) {
  const auto start = std::chrono::steady_clock::now();
  // Also after a launcher that was killed. It has to be here: starting a program with capabilities resets it.
  if (options.link_in) prctl(PR_SET_PDEATHSIG, SIGTERM);
  Stop stop;
  std::atomic<int> signal = 0;
  const StopSignals signals([&](int caught) {
    signal = caught;
    stop.request();
  });
  std::unique_ptr<RunFiles> files;
  if (!options.out.empty()) files = std::make_unique<RunFiles>(options.out);
  Console console(files ? std::filesystem::path(options.out) / "run.log" : "",
                  options.verbose ? LogLevel::kDebug : LogLevel::kInfo);
  const runtime::Logger::Write log = [&](LogLevel level, const std::string& component, const std::string& text) {
    console.log(level, component, text);
  };
  std::optional<std::string> write_problem;  // written before the end of the writer's thread
  ResultWriter results(files.get(), [&](const std::string& problem) {
    console.log(LogLevel::kError, "container", problem);
    write_problem = problem;
    stop.request();
  });

  ContainerOptions container_options = make_container_options(options, description, log);
  std::optional<TakenNames> taken_names;
  if (container_options.dds) taken_names.emplace(*container_options.dds, node_names(description));
  Container container(std::move(container_options));
  const Stop::Reaches reaches(stop, container);
  results.observe(container);
  for (const auto& note : notes) console.log(LogLevel::kWarning, "container", note);
  container.load_all(description.components);
  if (taken_names) taken_names->refuse();
  container.on_progress([&](runtime::Source::Progress progress) { console.progress(progress); });
  container.start();
  if (options.link_in && options.link_out)
    Link(*options.link_in, *options.link_out, stop.requested()).meet(container, log);
  await_peers(container, options.awaited, stop.requested(), log);
  std::optional<ServiceManager> service;
  QueueWatch queues;
  if (!options.link_in) service.emplace([&] { return queues.moves(container.queue_counters()); });
  std::vector<std::string> problems = container.run();
  service.reset();
  console.end_progress();
  results.finish();
  if (write_problem) problems.push_back(*write_problem);
  return conclude(options, container, files.get(), results, std::move(problems), signal, start, console);
}

}  // namespace panvo::runner
