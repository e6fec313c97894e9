// SPDX-License-Identifier: Apache-2.0
#include "peer_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "test_messages.hpp"

extern char** environ;

namespace panvo::runtime::test {

bool eventually(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + kLimit;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

PeerProcess::PeerProcess(int domain, std::string program, std::uint32_t shared_image_bytes) {
  ::signal(SIGPIPE, SIG_IGN);  // a peer that is gone is reported as an error and does not end the test
  std::array<int, 2> commands{}, answers{};
  if (pipe2(commands.data(), O_CLOEXEC) != 0 || pipe2(answers.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, commands[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, answers[1], STDOUT_FILENO);
  std::string first = std::to_string(domain), second = std::to_string(shared_image_bytes);
  std::array<char*, 4> arguments{program.data(), first.data(), shared_image_bytes > 0 ? second.data() : nullptr,
                                 nullptr};
  const int failure = posix_spawn(&pid_, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(commands[0]);
  close(answers[1]);
  commands_ = commands[1];
  answers_ = answers[0];
  if (failure != 0) throw std::runtime_error("cannot start " + program);
}

PeerProcess::~PeerProcess() {
  close(commands_);  // makes the peer end
  signal(SIGCONT);
  int status = 0;
  if (!eventually([&] { return waitpid(pid_, &status, WNOHANG) == pid_; })) {
    signal(SIGKILL);
    waitpid(pid_, &status, 0);
  }
  close(answers_);
}

std::string PeerProcess::ask(const std::string& command) {
  const std::string line = command + "\n";
  if (write(commands_, line.data(), line.size()) != static_cast<ssize_t>(line.size()))
    throw std::runtime_error("the peer is gone");
  for (;;) {
    const std::string answer = read_line();
    if (answer.starts_with("ok ")) return answer.substr(3);
    if (answer.starts_with("error ")) throw std::runtime_error(answer);
    if (answer.starts_with("received ")) received_.push_back(answer);
  }
}

std::string PeerProcess::next_received(const std::string& topic) {
  const std::string prefix = "received " + topic + " ";
  for (;;) {
    const auto found =
        std::find_if(received_.begin(), received_.end(), [&](const auto& line) { return line.starts_with(prefix); });
    if (found != received_.end()) {
      const std::string rest = found->substr(prefix.size());
      received_.erase(found);
      return rest;
    }
    received_.push_back(read_line());
  }
}

bool PeerProcess::matches(const std::string& topic, int count) {
  return eventually([&] { return ask("matched " + topic) == std::to_string(count); });
}

std::size_t PeerProcess::resident_kb() const {
  std::ifstream status("/proc/" + std::to_string(pid_) + "/status");
  for (std::string word; status >> word;) {
    std::size_t size = 0;
    if (word == "VmRSS:" && status >> size) return size;
  }
  throw std::runtime_error("the peer ended");
}

void PeerProcess::signal(int number) const { kill(pid_, number); }

void PeerProcess::kill_and_wait() const {
  signal(SIGKILL);
  siginfo_t ended{};
  if (waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOWAIT) != 0)
    throw std::runtime_error("the peer is not there");
}

void PeerProcess::wait_until_stopped() const {
  int status = 0;
  if (waitpid(pid_, &status, WUNTRACED) != pid_ || !WIFSTOPPED(status))
    throw std::runtime_error("the peer was not stopped");
}

std::string PeerProcess::read_line() {
  for (;;) {
    if (const auto end = buffer_.find('\n'); end != std::string::npos) {
      std::string line = buffer_.substr(0, end);
      buffer_.erase(0, end + 1);
      return line;
    }
    pollfd waiting{answers_, POLLIN, 0};
    if (poll(&waiting, 1, static_cast<int>(std::chrono::milliseconds(kLimit).count())) != 1)
      throw std::runtime_error("the peer is silent");
    std::array<char, 4096> chunk{};
    const auto size = read(answers_, chunk.data(), chunk.size());
    if (size <= 0) throw std::runtime_error("the peer ended");
    buffer_.append(chunk.data(), static_cast<std::size_t>(size));
  }
}

}  // namespace panvo::runtime::test
