// SPDX-License-Identifier: Apache-2.0
#include "launch.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <thread>

#include "link.hpp"
#include "panvo/runner/run_files.hpp"
#include "panvo/runtime/errors.hpp"
#include "service_manager.hpp"
#include "stop_signals.hpp"

namespace panvo::runner {
namespace {

struct Child {
  std::string name, out;
  pid_t pid = -1;
  int to_child = -1, from_child = -1;
  std::set<std::string> published, subscribed;
  bool has_source = false, running = false;
  int status = 0;

  bool respawn = false;
  bool again = false;  // replaces a process that crashed
  bool required = true;
  double respawn_delay_s = 0;
  std::optional<std::chrono::steady_clock::time_point> starts_again;
  std::vector<std::string> folders;  // result folders of its processes
};

std::vector<std::string> command_line(const RunOptions& options, const Child& child, int link_in, int link_out) {
  std::vector<std::string> words{std::filesystem::read_symlink("/proc/self/exe").string(), options.system_file};
  for (const auto& [name, value] : options.arguments) words.push_back(name + ":=" + value);
  const auto add = [&](const std::string& option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  add("--dataset", options.dataset);
  add("--bag", options.bag);
  add("--calibration", options.calibration);
  add("--out", child.out);
  add("--rate", std::to_string(options.rate));
  for (const auto& setting : options.settings) add("--set", setting);
  for (const auto& parameter : options.ros_parameters) add("-p", parameter);
  for (const auto& rule : options.ros_remaps) add("-r", rule);
  add("--seed", std::to_string(options.seed));
  add("--domain", std::to_string(options.dds.domain));
  add("--ros-distro", options.dds.ros_distro);
  add("--dds-profiles", options.dds.profiles);
  if (options.local) words.push_back("--local");
  if (options.view) words.push_back("--view");
  if (child.again) words.push_back("--again");
  add("--run-id", options.run_id);
  if (options.verbose) words.push_back("--verbose");
  add("--container", child.name);
  for (const auto& topic : options.awaited) add("--await", topic);
  add("--link-in", std::to_string(link_in));
  add("--link-out", std::to_string(link_out));
  return words;
}

/// A restarted process keeps the results of its predecessor.
std::string next_folder(const Child& child) {
  return child.folders.empty() ? child.name : child.name + "_" + std::to_string(child.folders.size() + 1);
}

void start(const RunOptions& options, Child& child) {
  if (!options.out.empty()) {
    child.folders.push_back(next_folder(child));
    child.out = (std::filesystem::path(options.out) / child.folders.back()).string();
  }
  int down[2], up[2];
  if (pipe2(down, O_CLOEXEC) != 0 || pipe2(up, O_CLOEXEC) != 0)
    throw std::runtime_error("cannot create a pipe: too many open files?");
  const auto words = command_line(options, child, down[0], up[1]);
  std::vector<char*> arguments;
  for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  child.pid = fork();
  if (child.pid == 0) {
    fcntl(down[0], F_SETFD, 0);
    fcntl(up[1], F_SETFD, 0);
    setpgid(0, 0);  // Ctrl-C goes only to the launcher, which forwards it once
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  if (child.pid < 0) throw std::runtime_error("cannot start a process for container " + child.name);
  close(down[0]);
  close(up[1]);
  child.to_child = down[1];
  child.from_child = up[0];
  child.running = true;
}

/// Reads lines from the container until `last`; false if it ended, or on `stop`.
bool read_until(Child& child, const std::string& last, const std::atomic<bool>& stop) {
  while (const auto line = read_pipe_line(child.from_child, stop)) {
    if (*line == last) return true;
    if (*line == "has_source") child.has_source = true;
    if (line->starts_with("publishes ")) child.published.insert(line->substr(10));
    if (line->starts_with("subscribes ")) child.subscribed.insert(line->substr(11));
  }
  return false;
}

void tell_peers(const Child& child, const std::vector<Child>& children) {
  std::map<std::string, runtime::Container::Peers> peers;
  for (const auto& other : children) {
    if (&other == &child || !other.running) continue;
    for (const auto& topic : child.published) peers[topic].readers += other.subscribed.contains(topic);
    for (const auto& topic : child.subscribed) peers[topic].writers += other.published.contains(topic);
  }
  for (const auto& [topic, wanted] : peers) {
    write_pipe_line(child.to_child, fmt::format("await {} {} {}", topic, wanted.readers, wanted.writers));
  }
  write_pipe_line(child.to_child, "connect");
}

bool connect(std::vector<Child>& children, const std::atomic<bool>& stop) {
  for (auto& child : children) {
    if (!read_until(child, "loaded", stop)) return false;
  }
  for (const auto& child : children) tell_peers(child, children);
  for (auto& child : children) {
    if (!read_until(child, "connected", stop)) return false;
  }
  for (auto& child : children) write_pipe_line(child.to_child, "start");
  return true;
}

/// Restarts a crashed process. If it crashes again, this is noticed like the first crash.
void start_again(const RunOptions& options, Child& child, const std::vector<Child>& children,
                 const std::atomic<bool>& stop) {
  child.starts_again.reset();
  close(child.to_child);
  close(child.from_child);
  child.published.clear();
  child.subscribed.clear();
  child.again = true;
  start(options, child);
  if (!read_until(child, "loaded", stop)) return;
  tell_peers(child, children);
  if (read_until(child, "connected", stop)) write_pipe_line(child.to_child, "start");
}

/// Whether it was playing and was stopped, like every container on request.
bool was_interrupted(const Child& child) { return child.status == static_cast<int>(ExitStatus::kTerminated); }

/// Whether to restart an ended container: not after a configuration error, which would recur.
bool is_to_respawn(const Child& child) {
  return child.respawn && child.status != 0 && !was_interrupted(child) &&
         child.status != static_cast<int>(ExitStatus::kBadConfiguration);
}

void plan_respawn(Child& child) {
  const std::chrono::duration<double> delay_s(child.respawn_delay_s);
  const auto delay = std::chrono::duration_cast<std::chrono::steady_clock::duration>(delay_s);
  child.starts_again = std::chrono::steady_clock::now() + delay;
  std::fprintf(stderr, "panvo run: restarting container %s in %.1f s\n", child.name.c_str(), delay_s.count());
}

void tell_lost(const Child& child) {
  std::fprintf(stderr,
               "panvo run: container %s is lost (exit status %d); the others continue without it (required: false). "
               "respawn: true in the system file, or --respawn, restarts it\n",
               child.name.c_str(), child.status);
}

void signal_all(const std::vector<Child>& children, int signal) {
  for (const auto& child : children) {
    if (child.running) kill(child.pid, signal);
  }
}

/// Waits until all containers have ended. Asks the others to stop when the last source has ended, when a required
/// container without restart has failed, or when `stop` is set.
void supervise(const RunOptions& options, std::vector<Child>& children, const std::atomic<bool>& stop, bool failed) {
  bool asked = failed;
  if (failed) signal_all(children, SIGTERM);
  const bool has_source = [&] {
    for (const auto& child : children) {
      if (child.has_source) return true;
    }
    return false;
  }();
  while (true) {
    bool running = false, playing = false;
    for (auto& child : children) {
      int status = 0;
      if (child.running && waitpid(child.pid, &status, WNOHANG) == child.pid) {
        child.running = false;
        child.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        if (WIFSIGNALED(status)) {
          std::fprintf(stderr, "panvo run: container %s was killed by signal %d\n", child.name.c_str(),
                       WTERMSIG(status));
        }
        if (!asked && !stop && is_to_respawn(child)) {
          plan_respawn(child);
        } else {
          failed |= child.required && child.status != 0 && !was_interrupted(child);
          if (!asked && !stop && !child.required) tell_lost(child);
        }
      }
      if (child.starts_again && (asked || stop)) child.starts_again.reset();
      if (child.starts_again && std::chrono::steady_clock::now() >= *child.starts_again) {
        start_again(options, child, children, stop);
      }
      running |= child.running || child.starts_again;
      playing |= (child.running || child.starts_again) && child.has_source;
    }
    if (!running) return;
    if (!asked && (stop || failed || (has_source && !playing))) {
      asked = true;
      signal_all(children, SIGTERM);  // each process has its own limit, see StopSignals
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

}  // namespace

ExitStatus launch(const RunOptions& given, const runtime::SystemDescription& system) {
  RunOptions options = given;
  options.local = given.local && system.containers.size() == 1;  // several containers need DDS
  options.run_id = runtime::new_run_id();
  std::atomic<bool> stop = false;
  std::atomic<int> signal = 0;
  std::vector<Child> children;
  for (const auto& container : system.containers) {
    Child child;
    child.name = container.name;
    child.required = container.required;
    child.respawn = options.respawn || container.respawn;
    child.respawn_delay_s = container.respawn_delay_s.value_or(options.respawn_delay_s);
    children.push_back(std::move(child));
  }
  for (auto& child : children) start(options, child);
  const StopSignals signals([&](int caught) {
    signal = caught;
    stop = true;
  });
  const bool connected = connect(children, stop);
  std::optional<ServiceManager> service;
  // supervise() notices containers that end, not ones without progress.
  if (connected) service.emplace([] { return true; });
  supervise(options, children, stop, !connected);
  service.reset();

  ExitStatus status = ExitStatus::kOk;
  std::vector<std::string> folders;
  for (const auto& child : children) {
    close(child.to_child);
    close(child.from_child);
    folders.insert(folders.end(), child.folders.begin(), child.folders.end());
    if (was_interrupted(child)) {
      if (status == ExitStatus::kOk && signal != 0) status = interrupted_by(signal);
    } else if (child.status != 0) {
      std::fprintf(stderr, "panvo run: container %s failed (exit status %d)\n", child.name.c_str(), child.status);
      const bool is_bad =
          status == ExitStatus::kBadConfiguration || child.status == static_cast<int>(ExitStatus::kBadConfiguration);
      status = is_bad ? ExitStatus::kBadConfiguration : ExitStatus::kRunFailed;
    }
  }
  if (folders.empty() || status == ExitStatus::kBadConfiguration) return status;
  const bool must_have_results = status == ExitStatus::kOk && options.container.empty();
  if (merge_run_files(options.out, folders, must_have_results)) return status;
  std::fprintf(stderr, "panvo run: %s\n", nothing_written(options.out).c_str());
  return ExitStatus::kRunFailed;
}

}  // namespace panvo::runner
