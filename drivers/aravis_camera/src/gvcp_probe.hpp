// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

namespace panvo::aravis_camera {

/// Whether a GigE Vision device responds at this IPv4 address to a discovery command. Cheaper than Aravis, whose search
/// takes a second, and two more to open an absent device, while all other calls wait.
bool answers(const std::string& address, std::chrono::milliseconds limit);

}  // namespace panvo::aravis_camera
