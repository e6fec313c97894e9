// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "finding.hpp"

namespace panvo::runtime::doctor {

struct NetworkInterface {
  std::string name;
  std::string address;  ///< IPv4
  bool is_loopback = false;
  bool has_multicast = false;
};

/// Interfaces that are up and have an IPv4 address.
std::vector<NetworkInterface> network_interfaces();

/// Value of an environment variable; nullopt if unset or empty.
using Environment = std::function<std::optional<std::string>(const char* name)>;
Environment process_environment();

/// Whether the system clock is synchronised; nullopt if the system does not say.
std::optional<bool> is_clock_synchronised();

// Each check reads below `root`, which is / except in tests.
Finding check_versions();
Finding check_machine(const std::filesystem::path& root);
Finding check_shared_memory(const std::filesystem::path& root);
Finding check_socket_buffers(const std::filesystem::path& root);
Finding check_network(const std::vector<NetworkInterface>& interfaces);
Finding check_clock(std::optional<bool> is_synchronised);
/// One finding per variable that panvo honours and that is set, and per contradiction.
Findings check_environment(const Environment& environment);
/// One finding per video device that cannot be opened; one if all can.
Findings check_cameras(const std::filesystem::path& root);

}  // namespace panvo::runtime::doctor
