// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace panvo::vision {

/// Receives the start and end of each processing stage. Algorithms read no clock; an implementation may measure the
/// times. Stages nest, and calls are balanced per thread. An observer shared by several threads must be thread-safe.
class StageObserver {
 public:
  virtual ~StageObserver() = default;
  virtual void enter(std::string_view stage) = 0;
  virtual void leave() = 0;
};

/// Marks a stage for the lifetime of this object: `const Stage stage(observer, "match");`. `observer` may be null.
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
