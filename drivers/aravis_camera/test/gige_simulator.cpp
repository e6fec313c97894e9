// SPDX-License-Identifier: Apache-2.0
#include <arv.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <deque>
#include <string>
#include <vector>

#include "picture_folder.hpp"
#include "test_picture.hpp"

/// Simulates several GigE Vision cameras with the real protocols in one process: Aravis's simulated camera with custom
/// pictures, clock and faults. On SIGTERM it prints the number of frames sent by each camera and exits.
namespace {

using panvo::aravis_camera::testing::PictureFolder;
using panvo::aravis_camera::testing::TestPicture;

struct Faults {
  double offset_s = 0.0;   ///< camera clock minus host clock
  double drift_ppm = 0.0;  ///< positive: the camera clock is fast
  int skip_every = 0;      ///< skip a frame number after this many frames; 0: never
};

struct Camera {
  std::string serial, address;
  unsigned index = 0;
  const Faults* faults = nullptr;
  PictureFolder* pictures = nullptr;
  std::uint64_t filled = 0, skipped = 0;
  ArvGvFakeCamera* device = nullptr;
};

std::atomic<std::int64_t> first_ns = 0;  // set by the first of the cameras' threads

std::int64_t device_time_ns(const Faults& faults, std::int64_t true_ns) {
  return true_ns + std::llround(faults.offset_s * 1e9) +
         std::llround(faults.drift_ppm * 1e-6 * static_cast<double>(true_ns - first_ns));
}

void fill(ArvBuffer* buffer, void* user_data, guint32 /*exposure_us*/, guint32 /*gain*/, ArvPixelFormat /*format*/) {
  auto& camera = *static_cast<Camera*>(user_data);
  const auto true_ns = static_cast<std::int64_t>(arv_buffer_get_timestamp(buffer));
  std::int64_t none = 0;
  first_ns.compare_exchange_strong(none, true_ns);
  auto* bytes = static_cast<std::uint8_t*>(const_cast<void*>(arv_buffer_get_data(buffer, nullptr)));
  const auto pixel_bytes = ARV_PIXEL_FORMAT_BIT_PER_PIXEL(arv_buffer_get_image_pixel_format(buffer)) / 8;
  const std::size_t width = static_cast<std::size_t>(arv_buffer_get_image_width(buffer)) * pixel_bytes;
  const std::size_t size = width * static_cast<std::size_t>(arv_buffer_get_image_height(buffer));
  if (camera.pictures != nullptr) {
    camera.pictures->draw(camera.index, true_ns, {bytes, size});
  } else {
    TestPicture{camera.index, camera.filled, true_ns}.draw({bytes, size}, width);
  }
  arv_buffer_set_timestamp(buffer, static_cast<guint64>(device_time_ns(*camera.faults, true_ns)));
  ++camera.filled;
  if (camera.faults->skip_every > 0 && camera.filled % static_cast<std::uint64_t>(camera.faults->skip_every) == 0)
    ++camera.skipped;
  if (camera.skipped > 0) {
    constexpr guint64 kNumbers = 65535;  // 1 follows 65535
    arv_buffer_set_frame_id(buffer, (arv_buffer_get_frame_id(buffer) + camera.skipped - 1) % kNumbers + 1);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Simulates GigE Vision cameras in user space.", "gige_simulator");
  std::vector<std::string> names;
  Faults faults;
  double lost_ratio = 0.0;
  std::string folder;
  double pictures_hz = 20.0;
  app.add_option("CAMERAS", names, "list of SERIAL@ADDRESS")->required();
  app.add_option("--offset-s", faults.offset_s, "camera clock minus host clock");
  app.add_option("--drift-ppm", faults.drift_ppm, "drift of the camera clock");
  app.add_option("--skip-every", faults.skip_every, "skip a frame number after this many frames");
  app.add_option("--lost-ratio", lost_ratio, "fraction of lost packets, 0 to 1");
  app.add_option("--pictures", folder, "folder with image_0, image_1 ..., the pictures of each camera");
  app.add_option("--pictures-hz", pictures_hz, "picture rate");
  CLI11_PARSE(app, argc, argv);

  sigset_t ends;
  sigemptyset(&ends);
  sigaddset(&ends, SIGTERM);
  sigaddset(&ends, SIGINT);
  sigprocmask(SIG_BLOCK, &ends, nullptr);  // before the cameras' threads, which inherit the mask

  std::unique_ptr<PictureFolder> pictures;
  if (!folder.empty()) pictures = std::make_unique<PictureFolder>(folder, names.size(), pictures_hz);
  std::deque<Camera> cameras;  // deque: element addresses stay valid
  for (const auto& name : names) {
    const auto at = name.find('@');
    auto& camera = cameras.emplace_back();
    camera.serial = name.substr(0, at);
    camera.address = name.substr(at + 1);
    camera.index = static_cast<unsigned>(cameras.size() - 1);
    camera.faults = &faults;
    camera.pictures = pictures.get();
    camera.device = arv_gv_fake_camera_new(camera.address.c_str(), camera.serial.c_str());
    if (camera.device == nullptr || !arv_gv_fake_camera_is_running(camera.device)) {
      std::fprintf(stderr, "cannot start %s\n", name.c_str());
      return 1;
    }
    g_object_set(camera.device, "gvsp-lost-ratio", lost_ratio, nullptr);
    arv_fake_camera_set_fill_pattern(arv_gv_fake_camera_get_fake_camera(camera.device), fill, &camera);
  }
  std::puts("ready");
  std::fflush(stdout);
  int signal = 0;
  sigwait(&ends, &signal);
  for (auto& camera : cameras) {
    g_object_unref(camera.device);  // ends its thread
    std::printf("%s filled %llu skipped %llu\n", camera.serial.c_str(), static_cast<unsigned long long>(camera.filled),
                static_cast<unsigned long long>(camera.skipped));
  }
  return 0;
}
