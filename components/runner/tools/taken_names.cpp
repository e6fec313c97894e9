// SPDX-License-Identifier: Apache-2.0
#include "taken_names.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <thread>

#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/graph.hpp"
#include "panvo/runtime/names.hpp"

namespace panvo::runner {
namespace {

constexpr std::chrono::milliseconds kPollPeriod{5};
// In polls, not by the clock: a process that was held up for as long would end its look before its announcement is
// answered. Our processes announce themselves twice per second and answer announcements; their endpoints follow within
// milliseconds.
constexpr int kFirstLook = 120, kQuiet = 20, kMaxLook = 400;

std::vector<std::string> taken_of(const std::vector<std::string>& wanted, const runtime::Graph& graph) {
  std::set<std::string> there;
  for (const auto& node : graph.nodes) there.insert(runtime::full_name(node.name_space, node.name));
  std::vector<std::string> taken;
  std::ranges::copy_if(wanted, std::back_inserter(taken), [&](const auto& name) { return there.contains(name); });
  return taken;
}

std::vector<std::string> look(runtime::Bridge& bridge, const std::vector<std::string>& wanted) {
  runtime::Graph graph = bridge.graph();
  for (int poll = 0, quiet = 0; poll < kMaxLook; ++poll, ++quiet) {
    if (auto taken = taken_of(wanted, graph); !taken.empty()) return taken;
    if (poll >= kFirstLook && quiet >= kQuiet && is_complete(graph)) break;
    std::this_thread::sleep_for(kPollPeriod);
    runtime::Graph next = bridge.graph();
    if (next.endpoints.size() != graph.endpoints.size() || next.nodes.size() != graph.nodes.size()) quiet = 0;
    graph = std::move(next);
  }
  return {};
}

}  // namespace

TakenNames::TakenNames(const runtime::DdsSettings& dds, std::vector<std::string> wanted)
    : bridge_(runtime::make_dds_bridge(dds)),
      taken_(std::async(std::launch::async, [this, names = std::move(wanted)] { return look(*bridge_, names); })) {}

void TakenNames::refuse() {
  const auto taken = taken_.get();
  bridge_.reset();
  if (taken.empty()) return;
  throw runtime::ConfigError(
      fmt::format("another process in this DDS domain already has a node named {}: the two runs would mix their "
                  "images and poses. Remedy: end the other one; or run this one in another domain (ROS_DOMAIN_ID, "
                  "--domain), without DDS (--local), or with another node name or namespace in its system file",
                  fmt::join(taken, ", ")));
}

}  // namespace panvo::runner
