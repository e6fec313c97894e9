// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

namespace panvo::aravis_camera {

/// Whether a GigE Vision device answers at that IPv4 address: a discovery command to it alone. Aravis's own search takes a second and its way of
/// opening a device that is away two more, with everything else waiting; this asks first.
bool answers(const std::string& address, std::chrono::milliseconds limit);

}  // namespace panvo::aravis_camera
