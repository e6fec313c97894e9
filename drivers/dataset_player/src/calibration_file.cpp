// SPDX-License-Identifier: Apache-2.0
#include "panvo/dataset_player/calibration_file.hpp"

#include <stdexcept>

#include "calibration_values.hpp"

namespace panvo::dataset_player {

vision::PinholeCamera pinhole(const std::vector<double>& matrix, ImageSize size) {
  return {matrix.at(0), matrix.at(4), matrix.at(2), matrix.at(5), size.width, size.height};
}

vision::LensCamera lens(calibration_files::YamlMap& file, const std::string& key, const std::string& model,
                        const vision::PinholeCamera& pinhole) {
  const std::size_t problems = file.problems();
  const auto coefficients = model == "none" ? std::vector<double>{} : file.numbers(key);
  if (file.problems() > problems) return {};
  try {
    return vision::lens_camera(model, coefficients, pinhole);
  } catch (const std::invalid_argument& error) {
    file.reject(key, std::string("cannot be used: the camera ") + error.what());
    return {};
  }
}

void expect_no_problems(const std::vector<std::string>& problems, const std::filesystem::path& file) {
  if (problems.empty()) return;
  std::string message = file.string() + ": invalid calibration; correct the file or recalibrate:";
  for (const auto& problem : problems) message += "\n  - " + problem;
  throw calibration_files::FileError(message);
}

vision::RectifiedStereo rectified_geometry(const vision::StereoCalibration& calibration,
                                           const std::filesystem::path& file) {
  expect_no_problems(vision::validate(calibration), file);
  try {
    const auto rectified = vision::rectify(calibration);
    expect_no_problems(vision::validate(rectified),
                       file);  // e.g. cameras without a common view, non-finite numbers
    return rectified;
  } catch (const std::invalid_argument& error) {
    expect_no_problems({error.what()}, file);
    throw;
  }
}

}  // namespace panvo::dataset_player
