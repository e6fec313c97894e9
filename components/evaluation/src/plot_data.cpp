// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include "angle_units.hpp"
#include "plot_panels.hpp"
#include "plot_path.hpp"

namespace panvo::evaluation {
namespace {}  // namespace

void add_data(PlotCanvas& canvas, const Report& report) {
  const std::vector<Eigen::Vector3d> truth = true_positions(report);
  canvas.data_block("truth", truth.size(), [&](PlotCanvas& c, std::size_t i) { c.row({truth[i].x(), truth[i].y()}); });
  const std::int64_t start_ns = covered_span(report).first_ns;
  for (std::size_t k = 0; k < report.evaluations.size(); ++k) {
    const Evaluation& evaluation = report.evaluations[k];
    // time, distance, aligned x y, error length, error x y z, yaw
    canvas.data_block("errors" + std::to_string(k), evaluation.errors.size(), [&](PlotCanvas& c, std::size_t i) {
      const PoseError& e = evaluation.errors[i];
      const Eigen::Vector3d& t = e.translation_m;
      c.row({static_cast<double>(e.stamp_ns - start_ns) * 1e-9, e.distance_m, e.estimate_m.x(), e.estimate_m.y(),
             t.norm(), t.x(), t.y(), t.z(), e.yaw_rad * kDegrees});
    });
    if (!evaluation.segments) continue;
    const std::vector<SegmentError>& segments = evaluation.segments->by_length;
    canvas.data_block("segments" + std::to_string(k), segments.size(), [&](PlotCanvas& c, std::size_t i) {
      c.row({segments[i].length_m, segments[i].translation_percent, segments[i].rotation_deg_per_m});
    });
  }
}

}  // namespace panvo::evaluation
