// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <utility>
#include <vector>

#include "panvo/runtime/graph.hpp"

namespace panvo::runtime {

/// The nodes of this process. Thread-safe.
class NodeList {
 public:
  void set(std::vector<NodeDescription> nodes) {
    const std::lock_guard lock(mutex_);
    nodes_ = std::move(nodes);
  }
  std::vector<NodeDescription> get() const {
    const std::lock_guard lock(mutex_);
    return nodes_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<NodeDescription> nodes_;
};

}  // namespace panvo::runtime
