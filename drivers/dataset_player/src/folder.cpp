// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "layouts.hpp"

namespace panvo::dataset_player {
namespace {

namespace fs = std::filesystem;

constexpr double kUsualRateHz = 30.0;

struct FoundCalibration {
  CalibratedStereo stereo;
  fs::path file;
};

/// Reads the calibration in a folder, in the first format found.
FoundCalibration find_calibration(const fs::path& directory, const std::vector<StereoFrame>& frames) {
  const auto path = [&](const char* name) { return directory / name; };
  if (fs::exists(path("stereo_params.xml"))) {
    return {read_boofcv_calibration(path("stereo_params.xml")), path("stereo_params.xml")};
  }
  if (fs::exists(path("left.yaml")) || fs::exists(path("right.yaml"))) {
    return {read_ros_calibration(path("left.yaml"), path("right.yaml")), path("left.yaml")};
  }
  for (const auto& file : {path("stereo.yaml"), path("stereo.yml")}) {
    if (fs::exists(file)) return {read_opencv_calibration(file, file, stereo_image_size(frames)), file};
  }
  if (fs::exists(path("intrinsics.yml")) && fs::exists(path("extrinsics.yml"))) {
    return {read_opencv_calibration(path("intrinsics.yml"), path("extrinsics.yml"), stereo_image_size(frames)),
            path("intrinsics.yml")};
  }
  throw DatasetError(
      fmt::format("{}: contains no calibration; looked for stereo_params.xml (BoofCV), left.yaml and right.yaml (ROS "
                  "camera_info), stereo.yaml or "
                  "stereo.yml (OpenCV: M1 D1 M2 D2 R T), intrinsics.yml and extrinsics.yml (OpenCV's sample)",
                  directory.string()));
}

}  // namespace

bool looks_like_folders(const fs::path& directory) {
  return fs::is_directory(directory / "left") || fs::is_directory(directory / "right");
}

Dataset read_folders(const fs::path& directory, const ReadOptions& options) {
  Dataset dataset;
  dataset.kind = "left/right folders";
  dataset.directory = directory;
  const auto folders = pair_by_number(directory / "left", directory / "right", dataset.notes);
  const double rate_hz = options.rate_hz > 0.0 ? options.rate_hz : kUsualRateHz;
  if (options.rate_hz <= 0.0) {
    dataset.notes.push_back(
        fmt::format("the frame rate is not recorded: {} Hz is assumed (parameter rate_hz)", kUsualRateHz));
  }
  StereoRecording stereo;
  for (const auto& pair : folders.pairs) {
    stereo.frames.push_back({stamp_at(pair.place, rate_hz, pair.left), pair.left, pair.right});
  }
  const auto [calibrated, file] =
      find_calibration(options.calibration.empty() ? directory : options.calibration, stereo.frames);
  stereo.calibration = calibrated.calibration;
  stereo.rectified = calibrated.rectified;
  stereo.base_from_left = base_from_optical();
  expect_image_size(stereo.calibration.left.pinhole, file, stereo.frames);
  dataset.stereo = std::move(stereo);
  return dataset;
}

}  // namespace panvo::dataset_player
