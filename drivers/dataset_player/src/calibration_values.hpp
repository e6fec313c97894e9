// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "panvo/dataset_player/calibration_file.hpp"
#include "panvo/vision/camera.hpp"
#include "yaml_file.hpp"

/// Values of calibration files as vision types; shared by the readers of the formats.
namespace panvo::dataset_player {

using RowMajor3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using RowMajor4d = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
using RowMajor34d = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

/// Pinhole of a row-major 3x3 camera matrix.
vision::PinholeCamera pinhole(const std::vector<double>& matrix, ImageSize size);

/// Coefficients k1 k2 p1 p2 k3 of the value `key`, which may hold fewer, or more that are zero. `model` is how the
/// file calls its lens model; one that is not radial-tangential ("plumb_bob") is an error.
std::array<double, 5> distortion(const YamlFile& file, const std::string& key, const std::string& model);

/// Throws DatasetError naming `file` and every problem.
void expect_no_problems(const std::vector<std::string>& problems, const std::filesystem::path& file);

}  // namespace panvo::dataset_player
