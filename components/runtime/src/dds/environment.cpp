// SPDX-License-Identifier: Apache-2.0
#include <spdlog/fmt/fmt.h>

#include <charconv>
#include <string_view>

#include "environment_variable.hpp"
#include "node_info.hpp"
#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/errors.hpp"

namespace panvo::runtime {
namespace {

int domain_from(std::string_view text) {
  int domain = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), domain);
  if (error != std::errc{} || end != text.data() + text.size() || domain < 0 || domain > DdsSettings::kMaxDomain) {
    throw ConfigError(fmt::format("ROS_DOMAIN_ID={}: is not a DDS domain; use a whole number from 0 to {}", text,
                                  DdsSettings::kMaxDomain));
  }
  return domain;
}

bool is_localhost_only() {
  const auto only = environment_variable("ROS_LOCALHOST_ONLY");
  if (!only.empty() && only != "0" && only != "1")
    throw ConfigError(fmt::format("ROS_LOCALHOST_ONLY={}: use 1 to stay on this machine, 0 otherwise", only));
  return only == "1";
}

DiscoveryRange range_from(std::string_view text) {
  if (text.empty() || text == "SUBNET") return DiscoveryRange::kSubnet;
  if (text == "OFF") return DiscoveryRange::kOff;
  if (text == "LOCALHOST") return DiscoveryRange::kLocalhost;
  if (text == "SYSTEM_DEFAULT") return DiscoveryRange::kSystemDefault;
  throw ConfigError(
      fmt::format("ROS_AUTOMATIC_DISCOVERY_RANGE={}: use SUBNET, LOCALHOST, OFF or SYSTEM_DEFAULT", text));
}

std::vector<std::string> peers_from(std::string_view text) {
  std::vector<std::string> peers;
  while (!text.empty()) {
    const auto end = text.find(';');
    if (const auto peer = text.substr(0, end); !peer.empty()) peers.emplace_back(peer);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return peers;
}

}  // namespace

DdsSettings dds_settings_from_environment() {
  DdsSettings settings;
  if (const auto domain = environment_variable("ROS_DOMAIN_ID"); !domain.empty()) settings.domain = domain_from(domain);
  if (const auto distro = environment_variable("ROS_DISTRO"); !distro.empty()) settings.ros_distro = distro;
  // ROS_LOCALHOST_ONLY is older and prevails, as in ROS 2.
  if (is_localhost_only()) {
    settings.range = dds::is_until_humble(settings.ros_distro) ? DiscoveryRange::kLoopback : DiscoveryRange::kLocalhost;
    return settings;
  }
  settings.range = range_from(environment_variable("ROS_AUTOMATIC_DISCOVERY_RANGE"));
  settings.peers = peers_from(environment_variable("ROS_STATIC_PEERS"));
  return settings;
}

}  // namespace panvo::runtime
