// SPDX-License-Identifier: Apache-2.0
#include <spdlog/fmt/fmt.h>

#include <charconv>
#include <cstdlib>
#include <string_view>

#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/errors.hpp"

namespace panvo::runtime {
namespace {

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

int domain_from(std::string_view text) {
  int domain = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), domain);
  if (error != std::errc{} || end != text.data() + text.size() || domain < 0 || domain > DdsSettings::kMaxDomain) {
    throw ConfigError(fmt::format("ROS_DOMAIN_ID={}: is not a DDS domain; use a whole number from 0 to {}", text,
                                  DdsSettings::kMaxDomain));
  }
  return domain;
}

bool localhost_only() {
  const auto only = variable("ROS_LOCALHOST_ONLY");
  if (!only.empty() && only != "0" && only != "1")
    throw ConfigError(fmt::format("ROS_LOCALHOST_ONLY={}: use 1 to stay on this machine, 0 otherwise", only));
  return only == "1" || variable("ROS_AUTOMATIC_DISCOVERY_RANGE") == "LOCALHOST";
}

}  // namespace

DdsSettings dds_settings_from_environment() {
  DdsSettings settings;
  if (const auto domain = variable("ROS_DOMAIN_ID"); !domain.empty()) settings.domain = domain_from(domain);
  if (const auto distro = variable("ROS_DISTRO"); !distro.empty()) settings.ros_distro = distro;
  settings.localhost_only = localhost_only();
  return settings;
}

}  // namespace panvo::runtime
