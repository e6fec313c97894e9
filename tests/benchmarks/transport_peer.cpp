// SPDX-License-Identifier: Apache-2.0
#include "transport_peer.hpp"

#include <sys/prctl.h>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <mutex>
#include <sstream>
#include <stdexcept>

#include "transport.hpp"

namespace panvo::bench {
namespace {

using std::chrono::milliseconds;

constexpr int kWarmUp = 10;  // not measured
constexpr milliseconds kMatchLimit{20'000}, kSettle{500};

struct Rhythm {
  int count;
  milliseconds period;
};

Rhythm rhythm(Message message) {
  return message == Message::kPanorama ? Rhythm{150, milliseconds(40)} : Rhythm{400, milliseconds(10)};
}

Message message_called(const std::string& name) {
  if (name == "odometry") return Message::kOdometry;
  return name == "gray" ? Message::kGray : Message::kPanorama;
}

/// Time of a clock common to all processes of the machine.
std::int64_t now_ns() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

double cpu_us() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto us = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) * 1e6 + static_cast<double>(time.tv_usec);
  };
  return us(usage.ru_utime) + us(usage.ru_stime);
}

std::unique_ptr<Transport> make_transport(const std::string& stack, Message message, int domain) {
  if (stack == "panvo") return make_panvo_transport(message, domain, 0);
  if (stack == "panvo_shared") return make_panvo_transport(message, domain, 2'000'000);
  if (stack == "fastdds") return make_fastdds_transport(message, domain);
  return make_cyclone_transport(message, domain);
}

/// Collects latencies, and the CPU time between the first and the last measured message.
class Log {
 public:
  void arrived(std::int64_t sent_ns) {
    const double latency_us = static_cast<double>(now_ns() - sent_ns) * 1e-3;
    const std::lock_guard lock(mutex_);
    if (++count_ == kWarmUp) start_cpu_us_ = cpu_us();
    if (count_ <= kWarmUp) return;
    latencies_us_.push_back(latency_us);
    end_cpu_us_ = cpu_us();
  }

  void say(bool with_cpu) {
    const std::lock_guard lock(mutex_);
    for (const double latency : latencies_us_) std::printf("latency_us %.3f\n", latency);
    if (with_cpu) std::printf("cpu_us %.0f\n", end_cpu_us_ - start_cpu_us_);
  }

 private:
  std::mutex mutex_;
  int count_ = 0;
  std::vector<double> latencies_us_;
  double start_cpu_us_ = 0, end_cpu_us_ = 0;
};

using std::chrono::steady_clock;

sigset_t end_signal() {
  sigset_t end;
  sigemptyset(&end);
  sigaddset(&end, SIGTERM);
  return end;
}

/// Sleeps until the time; throws on SIGTERM.
void rest(steady_clock::time_point until) {
  const sigset_t end = end_signal();
  const auto left = std::chrono::nanoseconds(until - steady_clock::now()).count();
  if (left <= 0) return;
  const timespec time{static_cast<time_t>(left / 1'000'000'000), static_cast<long>(left % 1'000'000'000)};
  if (sigtimedwait(&end, nullptr, &time) == SIGTERM) throw std::runtime_error("terminated");
}

void write_all(Transport& transport, Message message) {
  const auto give_up = steady_clock::now() + kMatchLimit;
  while (!transport.is_matched()) {
    if (steady_clock::now() > give_up) throw std::runtime_error("no reader found");
    rest(steady_clock::now() + milliseconds(10));
  }
  rest(steady_clock::now() + kSettle);  // the reader must also discover the writer
  const auto [count, period] = rhythm(message);
  double start_cpu_us = 0;
  auto next = steady_clock::now();
  for (int i = 0; i < kWarmUp + count; ++i) {
    if (i == kWarmUp) start_cpu_us = cpu_us();
    transport.write(now_ns());
    next += period;
    rest(next);
  }
  std::printf("sent %d\ncpu_us %.0f\n", count, cpu_us() - start_cpu_us);
  rest(steady_clock::now() + kSettle);
}

}  // namespace

void Measured::add(const std::string& output) {
  std::istringstream lines(output);  // may contain warnings
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string what;
    double value = 0;
    if (!(words >> what >> value)) continue;
    if (what == "latency_us") latencies_us.push_back(value);
    if (what == "cpu_us") cpu_us += value;
    if (what == "sent") sent += static_cast<int>(value);
  }
}

int run_peer(const std::vector<std::string>& words) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const sigset_t end = end_signal();
  pthread_sigmask(SIG_BLOCK, &end, nullptr);  // before threads are created
  const std::string &role = words.at(0), &stack = words.at(1);
  const Message message = message_called(words.at(2));
  const auto transport = make_transport(stack, message, std::stoi(words.at(3)));
  if (!transport) return 2;
  Log log;
  if (role != "write") transport->open_reader([&log](std::int64_t sent_ns) { log.arrived(sent_ns); });
  if (role != "read") transport->open_writer();
  if (role == "read") {
    int signal = 0;
    sigwait(&end, &signal);
  } else {
    write_all(*transport, message);
  }
  log.say(role == "read");  // for role `both`, the writer reports the CPU time of the process
  return 0;
}

}  // namespace panvo::bench
