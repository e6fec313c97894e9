// SPDX-License-Identifier: Apache-2.0
#include "await_peers.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <map>

#include "panvo/runtime/errors.hpp"

namespace panvo::runner {
namespace {

std::size_t count_of(const std::string& given, const std::string& number) {
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), count);
  if (error == std::errc() && end == number.data() + number.size() && count > 0) return count;
  throw runtime::ConfigError(fmt::format("--await {}: write TOPIC, or TOPIC:COUNT for that many processes", given));
}

std::map<std::string, runtime::Container::Peers> wanted_peers(const runtime::Container::Links& links,
                                                              const std::vector<std::string>& topics) {
  const auto has = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  std::map<std::string, runtime::Container::Peers> wanted;
  for (const auto& given : topics) {
    const std::size_t colon = given.find(':');
    const std::string name = given.substr(0, colon), topic = name.starts_with("/") ? name : "/" + name;
    const std::size_t count = colon == std::string::npos ? 1 : count_of(given, given.substr(colon + 1));
    runtime::Container::Peers peers{.readers = has(links.published, topic) ? count : 0,
                                    .writers = has(links.subscribed, topic) ? count : 0};
    if (peers.readers > 0) peers.writers = 0;  // published here: wait for readers
    if (peers.readers + peers.writers == 0) {
      throw runtime::ConfigError(fmt::format("--await {}: no component has this topic; available: {} {}", given,
                                             fmt::join(links.published, " "), fmt::join(links.subscribed, " ")));
    }
    wanted[topic] = peers;
  }
  return wanted;
}

}  // namespace

void await_peers(runtime::Container& container, const std::vector<std::string>& topics, const std::atomic<bool>& stop,
                 const runtime::Logger::Write& log) {
  if (topics.empty()) return;
  const auto wanted = wanted_peers(container.links(), topics);
  constexpr std::chrono::milliseconds kStep(200);
  constexpr std::chrono::seconds kPatience(10);
  std::chrono::milliseconds waited(0);
  while (!stop && !container.wait_for_peers(wanted, kStep)) {
    waited += kStep;
    if (waited != kPatience) continue;
    log(runtime::LogLevel::kWarning, "container",
        fmt::format("still waiting for another process on {}: check that it runs in the same ROS_DOMAIN_ID and that "
                    "the network lets it through",
                    fmt::join(topics, " ")));
  }
}

}  // namespace panvo::runner
