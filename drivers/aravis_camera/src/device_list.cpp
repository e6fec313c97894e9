// SPDX-License-Identifier: Apache-2.0
#include "panvo/aravis_camera/device_list.hpp"

#include <fmt/format.h>

#include <mutex>

#include "gobject.hpp"

namespace panvo::aravis_camera {
namespace {

std::string size_range(ArvCamera* camera) {
  ErrorSlot error;
  gint x = 0, y = 0, width = 0, height = 0, least = 0, widest = 0, highest = 0;
  arv_camera_get_region(camera, &x, &y, &width, &height, error.slot());
  if (error) return {};
  arv_camera_get_width_bounds(camera, &least, &widest, error.slot());
  if (!error) arv_camera_get_height_bounds(camera, &least, &highest, error.slot());
  if (error) return fmt::format("{} x {} px", width, height);
  return fmt::format("{} x {}, up to {} x {} px", width, height, widest, highest);
}

std::string rate_range(ArvCamera* camera) {
  ErrorSlot error;
  if (!arv_camera_is_frame_rate_available(camera, error.slot()) || error) return {};
  const double rate = arv_camera_get_frame_rate(camera, error.slot());
  if (error) return {};
  double least = 0, most = 0;
  arv_camera_get_frame_rate_bounds(camera, &least, &most, error.slot());
  if (error || most > 1e6) return fmt::format("{:.4g} Hz", rate);
  return fmt::format("{:.4g} Hz, {:.3g} to {:.4g} Hz", rate, least, most);
}

void learn(const Announced& announced, camera_stream::FoundDevice& device) {
  ErrorSlot error;
  const ObjectPtr<ArvCamera> camera(arv_camera_new(announced.id.c_str(), error.slot()));
  if (!camera) {
    device.problem = "cannot be opened: " + error.text();
    return;
  }
  guint count = 0;
  const std::unique_ptr<const char*[], Free> formats(
      arv_camera_dup_available_pixel_formats_as_strings(camera.get(), &count, error.slot()));
  for (guint i = 0; formats && i < count; ++i) device.formats.emplace_back(formats[i]);
  device.sizes = size_range(camera.get());
  device.rates = rate_range(camera.get());
  ArvDevice* its_device = arv_camera_get_device(camera.get());
  if (ARV_IS_GV_DEVICE(its_device) && !arv_gv_device_is_controller(ARV_GV_DEVICE(its_device)))
    device.problem = "is in use: another program controls it";
}

}  // namespace

void enable_simulated_camera() { arv_enable_interface("Fake"); }

std::vector<Announced> announced_devices(std::chrono::milliseconds age) {
  using std::chrono::steady_clock;
  // Aravis locks its list during an update only, not between the calls below. A caller that waited here reuses the
  // previous result.
  static std::mutex mutex;
  static std::vector<Announced> devices;
  static steady_clock::time_point found_at = steady_clock::time_point::min();
  const std::lock_guard lock(mutex);
  if (found_at != steady_clock::time_point::min() && steady_clock::now() - found_at < age) return devices;
  arv_update_device_list();
  devices.clear();
  for (unsigned i = 0; i < arv_get_n_devices(); ++i) {
    devices.push_back({text_of(arv_get_device_id(i)), text_of(arv_get_device_vendor(i)),
                       text_of(arv_get_device_model(i)), text_of(arv_get_device_serial_nbr(i)),
                       text_of(arv_get_device_address(i)), text_of(arv_get_device_physical_id(i)),
                       text_of(arv_get_device_protocol(i))});
  }
  found_at = steady_clock::now();
  return devices;
}

std::vector<camera_stream::FoundDevice> find_devices() {
  std::vector<camera_stream::FoundDevice> devices;
  for (const auto& announced : announced_devices()) {
    auto& device = devices.emplace_back();
    device.driver = "aravis_camera";
    device.protocol = announced.protocol;
    device.vendor = announced.vendor;
    device.model = announced.model;
    device.serial = announced.serial;
    device.address = announced.address;
    learn(announced, device);
  }
  return devices;
}

bool is_meant(const Announced& device, const std::string& selector) {
  return selector == device.serial || selector == device.address || selector == device.physical_id ||
         selector == device.id || selector == device.model;
}

std::string to_text(const std::vector<Announced>& devices) {
  std::string text;
  for (const auto& device : devices) {
    text += fmt::format("{}{} ({} {} at {})", text.empty() ? "" : ", ", device.serial, device.vendor, device.model,
                        device.address);
  }
  return text.empty() ? "none" : text;
}

}  // namespace panvo::aravis_camera
