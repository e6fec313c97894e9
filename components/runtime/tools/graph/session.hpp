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

/// A request that failed or found nothing: printed, exit status 1.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// is_stopped(): whether Ctrl-C or SIGTERM was received since watch_for_stop(). A second signal ends the process
/// immediately.
void watch_for_stop();
bool is_stopped();

struct SessionOptions {
  DdsSettings dds;
  double timeout_s = 5;  ///< limit for discovery, an answer or a first message
};

/// Access to the other processes of a DDS domain for one command.
class Session {
 public:
  explicit Session(const SessionOptions& options);

  Bridge& bridge() { return *bridge_; }
  std::chrono::milliseconds timeout() const { return timeout_; }

  /// The graph once it is complete and nothing new has been discovered for a while. If that is not the case at the
  /// timeout, says so.
  Graph settled_graph();
  /// The graph as soon as `is_there` holds, or at the timeout or Ctrl-C.
  Graph graph_with(const std::function<bool(const Graph&)>& is_there);

  /// Calls a service. Throws Failure if there is no answer in time.
  interfaces::Bytes call(const ServiceDescription& service, const interfaces::Bytes& request);
  template <class Response, class Request>
  Response call(const std::string& name, const std::string& type_name, const Request& request) {
    return from_bytes<Response>(call({name, type_name}, to_bytes(request)));
  }

 private:
  std::chrono::milliseconds timeout_;
  std::unique_ptr<Bridge> bridge_;
};

/// Full name of a node: "/robot/tracker".
std::string full_name_of(const GraphNode& node);
/// Adds the leading slash that may be omitted on the command line.
std::string absolute(const std::string& name);
/// Whether a node has an endpoint. Nodes of one process may share endpoints.
bool has(const GraphNode& node, const GraphEndpoint& endpoint);
/// Full name of the node that owns an endpoint, of the first if several share it; empty if unknown.
std::string node_of(const Graph& graph, const GraphEndpoint& endpoint);

}  // namespace panvo::runtime::graph
