// SPDX-License-Identifier: Apache-2.0
#include "report_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "panvo/calibration/coverage.hpp"
#include "panvo/calibration/lens_parameters.hpp"

namespace panvo::calibration {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

}  // namespace

std::size_t used_views(const Observations& observations, std::size_t camera) {
  return static_cast<std::size_t>(std::count_if(observations.views.begin(), observations.views.end(),
                                                [&](const View& view) { return !view.seen[camera].empty(); }));
}

std::vector<Residual> residuals_of(const Report& report, std::size_t camera) {
  std::vector<Residual> found;
  for (const auto& residual : report.calibration.residuals) {
    if (residual.camera == camera) found.push_back(residual);
  }
  return found;
}

Rows camera_rows(const Report& report) {
  Rows rows{{"camera", "images", "board seen", "used", "corners", "outliers", "coverage", "reprojection rms"}};
  const auto& used = report.calibration.used;
  for (std::size_t camera = 0; camera < used.cameras.size(); ++camera) {
    const auto off = residuals_of(report, camera);
    rows.push_back({used.cameras[camera], fmt::format("{}", used.views.size()),
                    fmt::format("{}", used_views(report.seen, camera)), fmt::format("{}", used_views(used, camera)),
                    fmt::format("{}", off.size()), fmt::format("{}", report.calibration.stray_corners[camera]),
                    fmt::format("{:.0f} %", 100.0 * coverage(used, camera).share),
                    fmt::format("{:.3f} px", rms_px(off))});
  }
  return rows;
}

Rows parameter_rows(const Report& report, std::size_t camera) {
  const auto& lens = report.calibration.rig.cameras[camera].lens;
  const auto names = lens_parameter_names(lens.model);
  const Eigen::VectorXd values = lens_parameters(lens);
  const auto& sigmas = report.calibration.sigmas;
  Rows rows{{"parameter", "value", "std. deviation"}};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    const double sigma = sigmas ? (*sigmas)[camera].lens[index] : 0.0;
    const bool is_px = i < 4;
    rows.push_back({names[i], is_px ? fmt::format("{:.3f} px", values[index]) : fmt::format("{:.6f}", values[index]),
                    !sigmas        ? std::string("not determined")
                    : sigma == 0.0 ? std::string("fixed")
                    : is_px        ? fmt::format("{:.3f} px", sigma)
                                   : fmt::format("{:.6f}", sigma)});
  }
  return rows;
}

Rows pose_rows(const Report& report) {
  Rows rows{{"camera", "x", "y", "z", "rotation vector", "std. deviation"}};
  const auto& cameras = report.calibration.rig.cameras;
  for (std::size_t camera = 0; camera < cameras.size(); ++camera) {
    if (camera == report.reference) continue;
    const Eigen::Isometry3d pose = cameras[camera].camera_from_reference.inverse();
    const Eigen::Vector3d turn = kDegrees * vision::so3_log(pose.linear());
    const auto& sigmas = report.calibration.sigmas;
    rows.push_back({report.calibration.used.cameras[camera], fmt::format("{:.5f} m", pose.translation().x()),
                    fmt::format("{:.5f} m", pose.translation().y()), fmt::format("{:.5f} m", pose.translation().z()),
                    fmt::format("{:.4f} {:.4f} {:.4f} deg", turn.x(), turn.y(), turn.z()),
                    sigmas ? fmt::format("{:.5f} m, {:.4f} deg", (*sigmas)[camera].position_m.norm(),
                                         kDegrees * (*sigmas)[camera].rotation_rad.norm())
                           : std::string("not determined")});
  }
  return rows;
}

Rows rejection_rows(const Report& report, bool with_unseen) {
  Rows rows{{"image", "camera", "reason"}};
  for (std::size_t view = 0; view < report.seen.views.size(); ++view) {
    const auto& [name, seen, missing] = report.seen.views[view];
    for (std::size_t camera = 0; with_unseen && camera < missing.size(); ++camera) {
      if (!missing[camera].empty()) rows.push_back({name, report.seen.cameras[camera], missing[camera]});
    }
    for (const auto& rejection : report.calibration.rejections) {
      if (rejection.view == view) rows.push_back({name, report.seen.cameras[rejection.camera], rejection.reason});
    }
  }
  return rows;
}

std::string epipolar_sentence(const Report& report) {
  const auto summary = summarise(report.epipolar);
  return fmt::format(
      "epipolar residual: rms {:.3f} px, mean {:+.3f} px, largest {:.2f} px, of {} corners in the rectified images",
      summary.rms_px, summary.mean_px, summary.max_px, summary.corners);
}

}  // namespace panvo::calibration
