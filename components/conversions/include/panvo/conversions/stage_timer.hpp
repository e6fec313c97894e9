// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string_view>
#include <thread>
#include <vector>

#include "panvo/runtime/stage_times.hpp"
#include "panvo/vision/stage_observer.hpp"

namespace panvo::conversions {

/// Measures the stages that an algorithm reports, for the component's times: wall clock, and CPU time of the thread
/// that runs the stage. The time of a nested stage also counts in the enclosing ones. Thread-safe.
class StageTimer final : public vision::StageObserver {
 public:
  explicit StageTimer(runtime::StageTimes& times) : times_(times) {}

  void enter(std::string_view stage) override;
  void leave() override;

 private:
  using OpenStages = std::vector<std::unique_ptr<runtime::StageTimer>>;

  runtime::StageTimes& times_;
  std::mutex mutex_;  // guards the map; the stages of a thread are only used by that thread
  std::map<std::thread::id, OpenStages> open_;
};

}  // namespace panvo::conversions
