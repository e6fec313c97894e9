// SPDX-License-Identifier: Apache-2.0
#include "stop_signals.hpp"

#include <unistd.h>
#include <csignal>
#include <cstdio>
#include <ctime>

#include <utility>

namespace panvo::runner {
namespace {

constexpr int kEndOfRun = SIGUSR2;  // wakes the thread in the destructor

sigset_t stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  struct sigaction hangup {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaddset(&signals, SIGHUP);  // nohup ignores it
  sigaddset(&signals, kEndOfRun);
  return signals;
}

void end_at_once(const char* why, int signal) {
  std::fprintf(stderr, "\npanvo run: %s\n", why);
  _exit(128 + signal);
}

}  // namespace

StopSignals::StopSignals(std::function<void(int)> request_stop) {
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is reported by the write and does not end the process
  const sigset_t signals = stop_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  thread_ = std::thread([signals, request_stop = std::move(request_stop)] {
    int signal = 0;
    sigwait(&signals, &signal);
    if (signal == kEndOfRun) return;
    request_stop(signal);
    const timespec limit{kLimit_s, 0};
    const int second = sigtimedwait(&signals, nullptr, &limit);
    if (second == kEndOfRun) return;
    if (second > 0) end_at_once("stopped immediately by a second signal", second);
    end_at_once("did not stop in time; killed", SIGKILL);
  });
}

StopSignals::~StopSignals() {
  pthread_kill(thread_.native_handle(), kEndOfRun);
  thread_.join();
}

}  // namespace panvo::runner
