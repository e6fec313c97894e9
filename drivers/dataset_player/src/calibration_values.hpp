// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "panvo/calibration_files/yaml_map.hpp"
#include "panvo/dataset_player/calibration_file.hpp"
#include "panvo/vision/lens.hpp"

/// Conversion of calibration values to vision types, shared by the readers.
namespace panvo::dataset_player {

using RowMajor3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using RowMajor34d = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

/// Pinhole of a row-major 3x3 camera matrix.
vision::PinholeCamera pinhole(const std::vector<double>& matrix, ImageSize size);

/// The lens with the distortion coefficients of `key`. `model`: the file's name of the lens model, as accepted by
/// vision::lens_camera(), or "none".
vision::LensCamera lens(calibration_files::YamlMap& file, const std::string& key, const std::string& model,
                        const vision::PinholeCamera& pinhole);

/// Throws FileError with `file` and every problem, if there are any.
void expect_no_problems(const std::vector<std::string>& problems, const std::filesystem::path& file);

}  // namespace panvo::dataset_player
