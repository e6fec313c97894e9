// SPDX-License-Identifier: Apache-2.0
#include "session.hpp"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "panvo/runtime/names.hpp"
#include "panvo/runtime/printable.hpp"

namespace panvo::runtime::graph {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

volatile std::sig_atomic_t stopped = 0;

constexpr milliseconds kPollPeriod{20};
// Participants announce themselves twice a second; endpoints and nodes follow within milliseconds.
constexpr milliseconds kFirstLook{1200};
constexpr milliseconds kQuiet{400};

/// Without anybody there, as long as it takes to tell that a discovery server does not answer.
milliseconds first_look(const Graph& graph) {
  const char* server = std::getenv("ROS_DISCOVERY_SERVER");
  const bool may_be_silent = server != nullptr && *server != '\0' && graph.participants.empty();
  return may_be_silent ? milliseconds(kServerPatience) + kQuiet : kFirstLook;
}

}  // namespace

void watch_for_stop() {
  struct sigaction action {};
  action.sa_handler = [](int) { stopped = 1; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool is_stopped() { return stopped != 0; }

Session::Session(const SessionOptions& options)
    : timeout_(static_cast<milliseconds::rep>(options.timeout_s * 1000)), bridge_(make_dds_bridge(options.dds)) {
  bridge_->on_warning([](const std::string& text) { std::fprintf(stderr, "panvo: %s\n", printable(text).c_str()); });
}

Graph Session::settled_graph() {
  Graph graph = bridge_->graph();  // first: it makes the participant, which takes seconds on a busy machine
  const auto start = steady_clock::now();
  auto changed = start;
  while (!is_stopped()) {
    const auto now = steady_clock::now();
    if (now - start >= timeout_) {
      std::fprintf(stderr, "panvo: discovery has not settled: something may be missing (--timeout waits longer)\n");
      break;
    }
    if (now - start >= first_look(graph) && now - changed >= kQuiet && is_complete(graph)) break;
    std::this_thread::sleep_for(kPollPeriod);
    Graph next = bridge_->graph();
    if (next.endpoints.size() != graph.endpoints.size() || next.nodes.size() != graph.nodes.size() ||
        next.participants.size() != graph.participants.size())
      changed = steady_clock::now();
    graph = std::move(next);
  }
  return graph;
}

Graph Session::graph_with(const std::function<bool(const Graph&)>& is_there) {
  const auto end = steady_clock::now() + timeout_;
  Graph graph = bridge_->graph();
  while (!is_there(graph) && steady_clock::now() < end && !is_stopped()) {
    std::this_thread::sleep_for(kPollPeriod);
    graph = bridge_->graph();
  }
  return graph;
}

interfaces::Bytes Session::call(const ServiceDescription& service, const interfaces::Bytes& request) {
  const auto client = bridge_->open_client(service);
  if (!client->wait_for_service(timeout_)) {
    throw Failure("service " + service.name + " of type " + service.type_name +
                  " not found; is its process in this ROS_DOMAIN_ID? (--timeout waits longer)");
  }
  auto answer = client->call(request, timeout_);
  if (!answer) throw Failure("service " + service.name + " did not answer in time (--timeout waits longer)");
  return std::move(*answer);
}

std::string full_name_of(const GraphNode& node) { return full_name(node.name_space, node.name); }

std::string absolute(const std::string& name) { return name.starts_with('/') ? name : "/" + name; }

bool has(const GraphNode& node, const GraphEndpoint& endpoint) {
  const auto& gids = endpoint.is_writer ? node.writers : node.readers;
  return std::find(gids.begin(), gids.end(), endpoint.gid) != gids.end();
}

std::string node_of(const Graph& graph, const GraphEndpoint& endpoint) {
  for (const auto& node : graph.nodes) {
    if (has(node, endpoint)) return full_name_of(node);
  }
  return "";
}

}  // namespace panvo::runtime::graph
