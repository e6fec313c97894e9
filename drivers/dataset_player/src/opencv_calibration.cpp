// SPDX-License-Identifier: Apache-2.0
#include "calibration_values.hpp"
#include "panvo/dataset_player/calibration_file.hpp"
#include "yaml_file.hpp"

namespace panvo::dataset_player {
namespace {

/// The first of `names` that is a key of the file. Throws DatasetError if there is none.
std::string require(const YamlFile& file, std::initializer_list<const char*> names) {
  if (const auto key = file.first_of(names)) return *key;
  std::string list;
  for (const char* name : names) list += (list.empty() ? "" : ", ") + std::string(name);
  throw DatasetError(file.path().string() + ": has none of the keys " + list + "; add one of them");
}

ImageSize image_size(const YamlFile& file, ImageSize when_absent) {
  if (const auto key = file.first_of({"image_size", "imageSize", "size"})) {
    const auto values = file.numbers(*key, 2);
    return {static_cast<int>(values[0]), static_cast<int>(values[1])};
  }
  if (file.has("image_width") && file.has("image_height"))
    return {file.integer("image_width"), file.integer("image_height")};
  return when_absent;
}

}  // namespace

CalibratedStereo read_opencv_calibration(const std::filesystem::path& intrinsics_file,
                                         const std::filesystem::path& extrinsics_file, ImageSize size_when_absent) {
  const YamlFile intrinsics(intrinsics_file);
  const YamlFile extrinsics(extrinsics_file);
  const auto size = image_size(intrinsics, size_when_absent);

  CalibratedStereo stereo;
  auto& [left, right, right_from_left] = stereo.calibration;
  const auto left_matrix = require(intrinsics, {"M1", "K1", "cameraMatrix1", "camera_matrix_1"});
  const auto right_matrix = require(intrinsics, {"M2", "K2", "cameraMatrix2", "camera_matrix_2"});
  const auto left_distortion = require(intrinsics, {"D1", "distCoeffs1", "distortion_coefficients_1"});
  const auto right_distortion = require(intrinsics, {"D2", "distCoeffs2", "distortion_coefficients_2"});
  // OpenCV does not write the model: the number of coefficients determines it, except for its fisheye with four.
  const auto model = intrinsics.text("distortion_model", "rational_polynomial");
  left = lens(intrinsics, left_distortion, model, pinhole(intrinsics.numbers(left_matrix, 9), size));
  right = lens(intrinsics, right_distortion, model, pinhole(intrinsics.numbers(right_matrix, 9), size));
  right_from_left.linear() = Eigen::Map<const RowMajor3d>(extrinsics.numbers("R", 9).data());
  right_from_left.translation() = Eigen::Map<const Eigen::Vector3d>(extrinsics.numbers("T", 3).data());
  stereo.rectified = rectified_geometry(stereo.calibration, extrinsics_file);
  return stereo;
}

}  // namespace panvo::dataset_player
