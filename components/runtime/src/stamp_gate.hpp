// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "context_state.hpp"

namespace panvo::runtime {

/// Lets messages with plausible stamps into an input of a component. Those that may be of a clock that was set wait for
/// the next ones, which show it: then all follow, late but complete, so that no motion is lost on the way through several
/// components. Otherwise they are dropped, counted and logged. Fewer than Limits::confirmations wait. Thread-safe.
class StampGate {
 public:
  using Take = std::function<void(const SamplePtr&)>;

  /// `input`: distinguishes the inputs of a component. `state` must outlive the gate. `take` is called in the order of
  /// arrival and must be fast.
  StampGate(Context::State& state, std::string input, Take take)
      : state_(state), input_(std::move(input)), take_(std::move(take)) {}

  void add(const TopicDescription& topic, const SamplePtr& sample);

  /// Drops the messages that wait: those of before a pause are of no use after it, and at the end no more will come.
  void drop_waiting();

 private:
  struct Held {
    std::string topic;
    SamplePtr sample;
    StampGuard::Verdict verdict;
  };

  /// Returns those that are dropped.
  std::vector<Held> pass(const std::string& topic, const SamplePtr& sample, const StampGuard::Verdict& verdict);
  void tell(const std::vector<Held>& dropped);

  Context::State& state_;
  const std::string input_;
  const Take take_;
  std::mutex mutex_;
  std::vector<Held> held_;  // in order of arrival
};

}  // namespace panvo::runtime
