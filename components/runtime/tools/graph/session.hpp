// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/graph.hpp"

namespace panvo::runtime::graph {

/// What was asked for is not there, or did not go well: said, exit status 1.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Whether Ctrl-C or SIGTERM came. A second one ends the process at once.
void watch_for_stop();
bool is_stopped();

struct SessionOptions {
  DdsSettings dds;
  double timeout_s = 5;  ///< of all waiting: for discovery, for an answer, for a first message
};

/// The other processes of a DDS domain, for a command that looks once and ends.
class Session {
 public:
  explicit Session(const SessionOptions& options);

  Bridge& bridge() { return *bridge_; }
  std::chrono::milliseconds timeout() const { return timeout_; }

  /// What there is once nothing new has been found for a while.
  Graph settled_graph();
  /// As soon as `is_there`; or what there is when the time is over, or Ctrl-C came.
  Graph graph_with(const std::function<bool(const Graph&)>& is_there);

  /// Asks a service. Throws Failure when nobody answers in time.
  interfaces::Bytes call(const ServiceDescription& service, const interfaces::Bytes& request);
  template <class Response, class Request>
  Response call(const std::string& name, const std::string& type_name, const Request& request) {
    return from_bytes<Response>(call({name, type_name}, to_bytes(request)));
  }

 private:
  std::chrono::milliseconds timeout_;
  std::unique_ptr<Bridge> bridge_;
};

/// "/robot/tracker" of a node.
std::string full_name_of(const GraphNode& node);
/// As it may be written on a command line: without the leading slash.
std::string absolute(const std::string& name);
/// The node that has an endpoint; empty: it is not told.
std::string node_of(const Graph& graph, const GraphEndpoint& endpoint);

}  // namespace panvo::runtime::graph
