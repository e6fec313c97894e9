// SPDX-License-Identifier: Apache-2.0
#include "panvo/conversions/stage_timer.hpp"

namespace panvo::conversions {

void StageTimer::enter(std::string_view stage) {
  const std::lock_guard lock(mutex_);
  open_[std::this_thread::get_id()].push_back(std::make_unique<runtime::StageTimer>(times_, stage));
}

void StageTimer::leave() {
  std::unique_ptr<runtime::StageTimer> innermost;  // its destructor records the time, outside the lock
  const std::lock_guard lock(mutex_);
  const auto stages = open_.find(std::this_thread::get_id());
  if (stages == open_.end() || stages->second.empty()) return;
  innermost = std::move(stages->second.back());
  stages->second.pop_back();
}

}  // namespace panvo::conversions
