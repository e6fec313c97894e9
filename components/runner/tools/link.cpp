// SPDX-License-Identifier: Apache-2.0
#include "link.hpp"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <sstream>
#include <stdexcept>

namespace panvo::runner {

std::optional<std::string> read_pipe_line(int pipe, const std::atomic<bool>& stop) {
  constexpr int kStep_ms = 50;
  std::string line;
  for (char letter = 0;;) {
    if (stop) return std::nullopt;
    pollfd readable{.fd = pipe, .events = POLLIN, .revents = 0};
    if (poll(&readable, 1, kStep_ms) <= 0) continue;
    const ssize_t count = read(pipe, &letter, 1);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return std::nullopt;
    if (letter == '\n') return line;
    line += letter;
  }
}

bool write_pipe_line(int pipe, const std::string& line) {
  const std::string text = line + "\n";
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t count = write(pipe, text.data() + written, text.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    written += static_cast<std::size_t>(count);
  }
  return true;
}

void Link::meet(runtime::Container& container, const runtime::Logger::Write& log) {
  const runtime::Container::Links links = container.links();
  for (const auto& topic : links.published) write_line("publishes " + topic);
  for (const auto& topic : links.subscribed) write_line("subscribes " + topic);
  if (links.has_source) write_line("has_source");
  write_line("loaded");
  std::map<std::string, runtime::Container::Peers> peers;
  for (auto line = read_line(); line != "connect"; line = read_line()) {
    if (!line) return;
    std::istringstream words(*line);
    std::string verb, topic;
    runtime::Container::Peers wanted;
    words >> verb >> topic >> wanted.readers >> wanted.writers;
    peers[topic] = wanted;
  }
  constexpr std::chrono::seconds kLimit(10);  // discovery takes well under 1 s, and never succeeds behind a firewall
  if (!container.wait_for_peers(peers, kLimit)) {
    log(runtime::LogLevel::kWarning, "container",
        fmt::format(
            "another container of this system did not connect within {} s: is multicast or shared memory blocked?",
            kLimit.count()));
  }
  write_line("connected");
  while (const auto line = read_line()) {
    if (line == "start") return;
  }
}

/// nullopt on stop.
std::optional<std::string> Link::read_line() {
  auto line = read_pipe_line(in_, stop_);
  if (!line && !stop_) throw std::runtime_error("the launching process is gone");
  return line;
}

void Link::write_line(const std::string& line) {
  if (!write_pipe_line(out_, line)) throw std::runtime_error("the launching process is gone");
}

}  // namespace panvo::runner
