// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>

namespace panvo::runtime::dds {

/// Removes the shared memory of ports (`fastrtps_portN`) that a process was killed in the middle of making: whoever needs such a port
/// next would wait for it to be finished, for ever. Returns how many. What is younger than some seconds is let be.
std::size_t remove_half_made_ports(const std::filesystem::path& folder = "/dev/shm");

}  // namespace panvo::runtime::dds
