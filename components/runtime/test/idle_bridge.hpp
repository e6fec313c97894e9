// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/graph.hpp"

namespace panvo::runtime {

/// A bridge without other processes, for tests that override what they need.
class IdleBridge : public Bridge {
 public:
  std::unique_ptr<BridgeWriter> open_writer(const TopicDescription&) override { return nullptr; }
  std::unique_ptr<BridgeReader> open_reader(const TopicDescription&, std::function<void(SamplePtr)>) override {
    return nullptr;
  }
  void watch_topics(std::function<void(const TopicDescription&)>) override {}
  std::unique_ptr<BridgeService> serve(const ServiceDescription&, ServiceHandler, ServiceGuard) override {
    return nullptr;
  }
  std::unique_ptr<BridgeClient> open_client(const ServiceDescription&) override { return nullptr; }
  void set_nodes(std::vector<NodeDescription>) override {}
  Graph graph() override { return {}; }
  void on_warning(std::function<void(const std::string&)>) override {}
};

}  // namespace panvo::runtime
