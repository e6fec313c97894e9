// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <any>
#include <memory>
#include <utility>

namespace panvo::runtime {

/// Type-erased queue of a component's second stage.
class StageQueue {
 public:
  virtual ~StageQueue() = default;
  virtual void push(std::any item) = 0;
};

/// A component's second stage: live on a thread of its own, in replay in sequence. See Context::stage.
template <class Item>
class Stage {
 public:
  explicit Stage(std::shared_ptr<StageQueue> queue) : queue_(std::move(queue)) {}

  /// Passes an item to the stage. Blocks while the queue is full, until the component stops.
  void push(Item item) { queue_->push(std::make_shared<Item>(std::move(item))); }

 private:
  std::shared_ptr<StageQueue> queue_;
};

}  // namespace panvo::runtime
