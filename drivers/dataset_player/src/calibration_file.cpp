// SPDX-License-Identifier: Apache-2.0
#include "panvo/dataset_player/calibration_file.hpp"

#include <cmath>

#include "calibration_values.hpp"
#include "panvo/dataset_player/dataset.hpp"

namespace panvo::dataset_player {

vision::PinholeCamera pinhole(const std::vector<double>& matrix, ImageSize size) {
  return {matrix.at(0), matrix.at(4), matrix.at(2), matrix.at(5), size.width, size.height};
}

std::array<double, 5> distortion(const YamlFile& file, const std::string& key, const std::string& model) {
  std::array<double, 5> coefficients{};
  if (model == "none") return coefficients;
  if (model != "plumb_bob" && model != "radial-tangential" && model != "radtan" && model != "rational_polynomial") {
    file.fail(key, "belongs to the lens model '" + model +
                       "', which is not read; calibrate with the radial-tangential model (plumb_bob), or undistort the "
                       "images first");
  }
  const auto values = file.numbers(key);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i < coefficients.size()) {
      coefficients[i] = values[i];
    } else if (values[i] != 0.0) {
      file.fail(key, "has more than the five coefficients k1 k2 p1 p2 k3; calibrate without the rational model");
    }
  }
  return coefficients;
}

void expect_no_problems(const std::vector<std::string>& problems, const std::filesystem::path& file) {
  if (problems.empty()) return;
  std::string message = file.string() + ": the calibration cannot be used; correct the file or calibrate again:";
  for (const auto& problem : problems) message += "\n  - " + problem;
  throw DatasetError(message);
}

bool is_rectified(const vision::StereoCalibration& calibration) {
  constexpr double kTolerance = 1e-6;  // files hold six digits or more
  const auto& [left, right, right_from_left] = calibration;
  for (const auto* camera : {&left, &right}) {
    for (const double coefficient : camera->distortion) {
      if (coefficient != 0.0) return false;
    }
  }
  const auto& a = left.pinhole;
  const auto& b = right.pinhole;
  const double difference_px =
      std::max({std::abs(a.fx - b.fx), std::abs(a.fy - b.fy), std::abs(a.cx - b.cx), std::abs(a.cy - b.cy)});
  const Eigen::Vector3d t = right_from_left.translation();
  return difference_px <= kTolerance * a.fx &&
         (right_from_left.linear() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= kTolerance &&
         t.tail<2>().cwiseAbs().maxCoeff() <= 10.0 * kTolerance * std::abs(t.x());
}

vision::RectifiedStereo rectified_geometry(const vision::StereoCalibration& calibration,
                                           const std::filesystem::path& file) {
  expect_no_problems(vision::validate(calibration), file);
  if (!is_rectified(calibration)) return vision::rectify(calibration);
  vision::RectifiedStereo rectified;
  rectified.camera = calibration.left.pinhole;
  rectified.baseline_m = -calibration.right_from_left.translation().x();
  return rectified;
}

}  // namespace panvo::dataset_player
