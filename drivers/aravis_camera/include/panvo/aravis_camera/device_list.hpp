// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "panvo/camera_stream/found_device.hpp"

namespace panvo::aravis_camera {

/// Enables Aravis's built-in simulated camera Fake_1, for tests.
void enable_simulated_camera();

/// Lists the GigE Vision and USB3 Vision cameras that respond. Opens each briefly to read its formats, sizes and rates.
/// Takes at least a second.
std::vector<camera_stream::FoundDevice> find_devices();

/// A camera's announcement on its network or bus.
struct Announced {
  std::string id;  ///< used by Aravis to open it
  std::string vendor, model, serial, address, physical_id, protocol;
};

/// All announced cameras. A search takes about a second and delays opening cameras; the result of the last one is
/// reused if it is at most `age` old.
std::vector<Announced> announced_devices(std::chrono::milliseconds age = std::chrono::milliseconds(0));

/// Whether `selector` matches the camera's serial number, IP or MAC address, Aravis id, or model.
bool is_meant(const Announced& device, const std::string& selector);

/// "GVL (Aravis Fake at 127.0.0.1), GVR (...)", or "none".
std::string to_text(const std::vector<Announced>& devices);

}  // namespace panvo::aravis_camera
