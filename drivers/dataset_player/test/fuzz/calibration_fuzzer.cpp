// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: the first byte selects the kind of calibration, the rest is the file. It must be rejected with a
// FileError or DatasetError, or give a pair whose rectification is finite.
#include <cmath>
#include <cstdlib>
#include <string>

#include "panvo/dataset_player/calibration_file.hpp"
#include "panvo/dataset_player/dataset.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace {

using namespace panvo::dataset_player;

/// Data sets without calibration, in shared memory, to avoid disk writes.
struct Datasets {
  panvo::test::TemporaryFolder folder{"/dev/shm"};

  Datasets() {
    for (const char* image : {"kitti/image_0/000000.pgm", "kitti/image_1/000000.pgm", "euroc/mav0/cam0/data/1.pgm",
                              "euroc/mav0/cam1/data/1.pgm"}) {
      folder.write(image, "P5 1 1 255\n ");
    }
  }
};

void expect_numbers(const panvo::vision::RectifiedStereo& stereo) {
  if (!std::isfinite(stereo.camera.fx) || !std::isfinite(stereo.baseline_m) || !(stereo.baseline_m > 0.0)) std::abort();
}

void read(std::uint8_t kind, const std::string& text) {
  static const Datasets datasets;
  const auto& folder = datasets.folder;
  const std::string cameras[] = {"euroc/mav0/cam0/", "euroc/mav0/cam1/"};
  switch (kind % 6) {
    case 0:
      return expect_numbers(read_boofcv_calibration(folder.write("calibration", text)).rectified);
    case 1: {
      const auto file = folder.write("calibration", text);
      return expect_numbers(read_ros_calibration(file, file).rectified);
    }
    case 2: {
      const auto file = folder.write("calibration", text);
      return expect_numbers(read_opencv_calibration(file, file, {640, 480}).rectified);
    }
    case 3:
      folder.write("kitti/calib.txt", text);
      return expect_numbers(open_dataset(folder / "kitti").stereo->rectified);
    case 4:
      for (const auto& camera : cameras) {
        folder.write(camera + "sensor.yaml", text);
        folder.write(camera + "data.csv", "1,1.pgm\n");
      }
      return expect_numbers(open_dataset(folder / "euroc").stereo->rectified);
    default:
      for (const auto& camera : cameras) folder.write(camera + "data.csv", text);
      open_dataset(folder / "euroc");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  try {
    read(data[0], std::string(reinterpret_cast<const char*>(data + 1), size - 1));
  } catch (const panvo::calibration_files::FileError&) {
  } catch (const DatasetError&) {
  }
  return 0;
}
