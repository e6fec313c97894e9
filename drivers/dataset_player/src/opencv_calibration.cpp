// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "calibration_values.hpp"
#include "panvo/dataset_player/calibration_file.hpp"

namespace panvo::dataset_player {
namespace {

using calibration_files::YamlMap;

constexpr const char* kKind = "an OpenCV stereo calibration (M1 D1 M2 D2 R T)";

/// The first of `names` that is a key of the file; if there is none, all of them, which is reported as missing.
std::string first_of(YamlMap& file, const std::vector<std::string>& names) {
  const auto found = std::find_if(names.begin(), names.end(), [&](const auto& name) { return file.has(name); });
  return found == names.end() ? fmt::format("{}", fmt::join(names, " or ")) : *found;
}

ImageSize image_size(YamlMap& file, ImageSize when_absent) {
  for (const char* key : {"image_size", "imageSize", "size"}) {
    if (!file.has(key)) continue;
    const auto [width, height] = file.size_px(key);
    return {width, height};
  }
  if (!file.has("image_width") || !file.has("image_height")) return when_absent;
  return {file.integer("image_width", 1, 1 << 16), file.integer("image_height", 1, 1 << 16)};
}

}  // namespace

CalibratedStereo read_opencv_calibration(const std::filesystem::path& intrinsics_file,
                                         const std::filesystem::path& extrinsics_file, ImageSize size_when_absent) {
  YamlMap intrinsics(intrinsics_file, kKind);
  YamlMap extrinsics(extrinsics_file, kKind);
  const auto size = image_size(intrinsics, size_when_absent);

  CalibratedStereo stereo;
  auto& [left, right, right_from_left] = stereo.calibration;
  const auto left_matrix = first_of(intrinsics, {"M1", "K1", "cameraMatrix1", "camera_matrix_1"});
  const auto right_matrix = first_of(intrinsics, {"M2", "K2", "cameraMatrix2", "camera_matrix_2"});
  const auto left_distortion = first_of(intrinsics, {"D1", "distCoeffs1", "distortion_coefficients_1"});
  const auto right_distortion = first_of(intrinsics, {"D2", "distCoeffs2", "distortion_coefficients_2"});
  // OpenCV does not write the model: the number of coefficients determines it, except for its fisheye with four.
  const auto model = intrinsics.text("distortion_model", "rational_polynomial");
  left = lens(intrinsics, left_distortion, model, pinhole(intrinsics.numbers(left_matrix, 9), size));
  right = lens(intrinsics, right_distortion, model, pinhole(intrinsics.numbers(right_matrix, 9), size));
  intrinsics.check();
  right_from_left.linear() = Eigen::Map<const RowMajor3d>(extrinsics.numbers("R", 9).data());
  right_from_left.translation() = Eigen::Map<const Eigen::Vector3d>(extrinsics.numbers("T", 3).data());
  extrinsics.check();
  stereo.rectified = rectified_geometry(stereo.calibration, extrinsics_file);
  return stereo;
}

}  // namespace panvo::dataset_player
