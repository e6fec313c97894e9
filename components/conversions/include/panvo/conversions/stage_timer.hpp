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

/// Measures the stages that an algorithm tells of, for the component's times: wall clock, and CPU of the thread that
/// runs the stage. Nested stages count in themselves and in those around them. May be given to several threads.
class StageTimer final : public vision::StageObserver {
 public:
  explicit StageTimer(runtime::StageTimes& times) : times_(times) {}

  void enter(std::string_view stage) override;
  void leave() override;

 private:
  using OpenStages = std::vector<std::unique_ptr<runtime::StageTimer>>;

  runtime::StageTimes& times_;
  std::mutex mutex_;  // guards the map; each thread's stages are its own
  std::map<std::thread::id, OpenStages> open_;
};

}  // namespace panvo::conversions
