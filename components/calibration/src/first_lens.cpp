// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/first_lens.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lens_projection.hpp"
#include "panvo/calibration/planar_pose.hpp"
#include "panvo/vision/camera_model.hpp"

namespace panvo::calibration {
namespace {

constexpr double kMinFocalRatio = 0.12;  // focal length over the longer side of the image
constexpr double kMaxFocalRatio = 5.0;
constexpr double kStep = 1.08;
constexpr std::size_t kMaxViews = 24;  // sufficient for an initial value

/// nullopt if the lens is invalid: the image border would be more than 180 degrees off the axis.
std::optional<vision::CameraModel> first_model(const vision::LensCamera& lens) {
  try {
    return vision::CameraModel(lens);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

/// Median reprojection error of a view with a linear board pose, px.
std::optional<double> error_px(const vision::CameraModel& lens, const std::vector<Corner>& corners,
                               const std::vector<Eigen::Vector3d>& board_points) {
  const auto pose =
      planar_pose(corners, board_points, [&](const Eigen::Vector2d& pixel) { return lens.unproject(pixel); });
  if (!pose) return std::nullopt;
  std::vector<double> errors;
  for (const auto& corner : corners) {
    const auto pixel = lens.project(*pose * board_points[static_cast<std::size_t>(corner.id)]);
    errors.push_back(pixel ? (*pixel - corner.pixel).norm() : kNotSeen_px);
  }
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return *middle;
}

}  // namespace

std::optional<vision::LensCamera> first_lens(const std::vector<std::vector<Corner>>& views,
                                             const std::vector<Eigen::Vector3d>& board_points, cv::Size image_size,
                                             vision::LensModel model) {
  vision::LensCamera lens;
  lens.model = model;
  const auto coefficients = vision::lens_coefficients(model);
  std::transform(coefficients.begin(), coefficients.end(), lens.distortion.begin(),
                 [](const vision::LensCoefficient& coefficient) { return coefficient.start; });
  const double longer = std::max(image_size.width, image_size.height);
  const std::size_t stride = std::max<std::size_t>(1, views.size() / kMaxViews);
  std::optional<vision::LensCamera> best;
  double smallest = 0.0;
  for (double share = kMinFocalRatio; share < kMaxFocalRatio; share *= kStep) {
    const double focal = share * longer;
    lens.pinhole = {
        focal, focal, 0.5 * (image_size.width - 1), 0.5 * (image_size.height - 1), image_size.width, image_size.height};
    const auto camera = first_model(lens);
    if (!camera) continue;
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < views.size(); i += stride) {
      const auto error = views[i].empty() ? std::nullopt : error_px(*camera, views[i], board_points);
      if (!error) continue;
      sum += *error;
      ++count;
    }
    if (count == 0) continue;
    const double mean = sum / static_cast<double>(count);
    if (best && mean >= smallest) continue;
    best = lens;
    smallest = mean;
  }
  return best;
}

}  // namespace panvo::calibration
