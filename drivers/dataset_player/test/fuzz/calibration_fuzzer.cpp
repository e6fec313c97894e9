// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: the first byte selects the kind of calibration, the rest is the file. It must be rejected with a
// DatasetError or give a pair whose rectification is finite.
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "panvo/dataset_player/calibration_file.hpp"
#include "panvo/dataset_player/dataset.hpp"

namespace {

using namespace panvo::dataset_player;
namespace fs = std::filesystem;

const fs::path& folder() {
  static const fs::path made = [] {
    const fs::path path = "/dev/shm/panvo_calibration_fuzzer_" + std::to_string(::getpid());
    for (const char* part : {"kitti/image_0", "kitti/image_1"}) {
      fs::create_directories(path / part);
      std::ofstream(path / part / "000000.pgm") << "P5 1 1 255\n ";
    }
    for (const char* part : {"euroc/mav0/cam0/data", "euroc/mav0/cam1/data"}) {
      fs::create_directories(path / part);
      std::ofstream(path / part / "1.pgm") << "P5 1 1 255\n ";
    }
    std::atexit([] { fs::remove_all(folder()); });
    return path;
  }();
  return made;
}

void expect_numbers(const panvo::vision::RectifiedStereo& stereo) {
  if (!std::isfinite(stereo.camera.fx) || !std::isfinite(stereo.baseline_m) || !(stereo.baseline_m > 0.0)) std::abort();
}

void read(std::uint8_t kind, const std::string& text) {
  const fs::path file = folder() / "calibration";
  const auto write = [&](const fs::path& path) { std::ofstream(path, std::ios::binary) << text; };
  switch (kind % 6) {
    case 0:
      write(file);
      return expect_numbers(read_boofcv_calibration(file).rectified);
    case 1:
      write(file);
      return expect_numbers(read_ros_calibration(file, file).rectified);
    case 2:
      write(file);
      return expect_numbers(read_opencv_calibration(file, file, {640, 480}).rectified);
    case 3:
      write(folder() / "kitti" / "calib.txt");
      return expect_numbers(open_dataset(folder() / "kitti").stereo->rectified);
    case 4:
      for (const char* camera : {"cam0", "cam1"}) {
        write(folder() / "euroc" / "mav0" / camera / "sensor.yaml");
        std::ofstream(folder() / "euroc" / "mav0" / camera / "data.csv") << "1,1.pgm\n";
      }
      return expect_numbers(open_dataset(folder() / "euroc").stereo->rectified);
    default:
      for (const char* camera : {"cam0", "cam1"}) write(folder() / "euroc" / "mav0" / camera / "data.csv");
      open_dataset(folder() / "euroc");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  try {
    read(data[0], std::string(reinterpret_cast<const char*>(data + 1), size - 1));
  } catch (const DatasetError&) {
  }
  return 0;
}
