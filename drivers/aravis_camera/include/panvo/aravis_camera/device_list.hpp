// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "panvo/camera_stream/found_device.hpp"

namespace panvo::aravis_camera {

/// Has Aravis's own simulated camera, serial Fake_1, count as connected; for trials.
void enable_simulated_camera();

/// The GigE Vision and USB3 Vision cameras that answer, each opened for a moment to learn what it can do. Takes a second and more.
std::vector<camera_stream::FoundDevice> find_devices();

/// A camera as it announces itself.
struct Announced {
  std::string id;  ///< by which Aravis opens it
  std::string vendor, model, serial, address, physical_id, protocol;
};

/// All that announce themselves. A search takes about a second, with whoever opens a camera waiting; one that ended no longer than `age` ago does.
std::vector<Announced> announced_devices(std::chrono::milliseconds age = std::chrono::milliseconds(0));

/// Whether a camera is meant by `selector`: serial number, IP or MAC address, Aravis's id, or model.
bool is_meant(const Announced& device, const std::string& selector);

/// "GVL (Aravis Fake at 127.0.0.1), GVR (...)", or that there is none.
std::string to_text(const std::vector<Announced>& devices);

}  // namespace panvo::aravis_camera
