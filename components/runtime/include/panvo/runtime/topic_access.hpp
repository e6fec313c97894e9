// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/graph.hpp"
#include "panvo/runtime/output.hpp"
#include "panvo/runtime/sample.hpp"

namespace panvo::runtime {

/// All topics, nodes and services by name, for a viewer that opens them when somebody asks. Thread-safe. Names are used
/// as given, without remapping. Must be destroyed with the component, after everything it returned.
class TopicAccess {
 public:
  virtual ~TopicAccess() = default;

  /// Topics that this or another process publishes now, in order of name. The QoS is the strongest that all their
  /// writers offer.
  virtual std::vector<TopicDescription> published() const = 0;

  /// Passes latched and then all further messages of a topic to `callback`, on the publisher's thread: it must be fast
  /// and must not open or close topics. Ends when the result is destroyed; no callback is running then. Other processes
  /// send the topic only while it is read. Throws ConfigError if the topic has another type here.
  virtual std::shared_ptr<void> read(const TopicDescription& topic, std::function<void(const SamplePtr&)> callback) = 0;

  /// Publishes a topic until the result is destroyed. Throws ConfigError if the topic has another type here, or in
  /// replay, whose results must not depend on a viewer.
  virtual std::shared_ptr<UntypedOutput> write(const TopicDescription& topic) = 0;

  /// Nodes of this and other processes, with their topics and services.
  virtual std::vector<NodeDescription> nodes() const = 0;

  /// Services of this and other processes, in order of name.
  virtual std::vector<ServiceDescription> services() const = 0;

  /// Calls a service and waits for the response; nullopt: none within `limit`. Not from a callback of the component,
  /// whose own services would wait for it. Throws ConfigError in replay.
  virtual std::optional<interfaces::Bytes> call(const ServiceDescription& service, interfaces::Bytes request,
                                                std::chrono::milliseconds limit) = 0;
};

}  // namespace panvo::runtime
