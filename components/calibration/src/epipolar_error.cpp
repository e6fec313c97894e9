// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/epipolar_error.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "panvo/vision/camera_model.hpp"

namespace panvo::calibration {
namespace {

std::optional<Eigen::Vector2d> rectified(const vision::CameraModel& model, const Eigen::Matrix3d& rectified_from_raw,
                                         const vision::PinholeCamera& camera, const Eigen::Vector2d& pixel) {
  const auto direction = model.unproject(pixel);
  if (!direction) return std::nullopt;
  const Eigen::Vector3d turned = rectified_from_raw * *direction;
  if (!(turned.z() > 0.0)) return std::nullopt;
  const Eigen::Vector2d rectified_pixel = camera.project(turned);
  if (!camera.contains(rectified_pixel)) return std::nullopt;
  return rectified_pixel;
}

}  // namespace

std::vector<EpipolarError> epipolar_errors(const Observations& observations, const vision::LensCamera& left,
                                           const vision::LensCamera& right, const vision::RectifiedStereo& pair) {
  const vision::CameraModel left_model(left), right_model(right);
  std::vector<EpipolarError> errors;
  for (std::size_t view = 0; view < observations.views.size(); ++view) {
    std::map<int, Eigen::Vector2d> in_left;
    for (const auto& corner : observations.views[view].seen[0]) in_left.emplace(corner.id, corner.pixel);
    for (const auto& corner : observations.views[view].seen[1]) {
      const auto same = in_left.find(corner.id);
      if (same == in_left.end()) continue;
      const auto a = rectified(left_model, pair.rectified_left_from_left, pair.camera, same->second);
      const auto b = rectified(right_model, pair.rectified_right_from_right, pair.camera, corner.pixel);
      if (a && b) errors.push_back({view, *a, b->y() - a->y()});
    }
  }
  return errors;
}

EpipolarSummary summarise(const std::vector<EpipolarError>& errors) {
  EpipolarSummary summary;
  if (errors.empty()) return summary;
  double squares = 0.0;
  for (const auto& error : errors) {
    summary.mean_px += error.row_error_px;
    squares += error.row_error_px * error.row_error_px;
    summary.max_px = std::max(summary.max_px, std::abs(error.row_error_px));
  }
  summary.corners = errors.size();
  summary.mean_px /= static_cast<double>(errors.size());
  summary.rms_px = std::sqrt(squares / static_cast<double>(errors.size()));
  return summary;
}

}  // namespace panvo::calibration
