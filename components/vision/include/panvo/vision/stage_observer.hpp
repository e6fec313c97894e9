// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace panvo::vision {

/// Is told which stage an algorithm works on. Algorithms read no clock: who wants times implements this and measures.
/// Stages nest; enter and leave of one thread are balanced, and an observer given to two threads must bear both.
class StageObserver {
 public:
  virtual ~StageObserver() = default;
  virtual void enter(std::string_view stage) = 0;
  virtual void leave() = 0;
};

/// A stage for the lifetime of this object: `const Stage stage(observer, "match");`. No observer, no cost.
class Stage {
 public:
  Stage(StageObserver* observer, std::string_view name) : observer_(observer) {
    if (observer_ != nullptr) observer_->enter(name);
  }
  ~Stage() {
    if (observer_ != nullptr) observer_->leave();
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

 private:
  StageObserver* observer_;
};

}  // namespace panvo::vision
