// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>

#include "panvo/evaluation/journey_evaluation.hpp"

namespace panvo::evaluation {

/// A plan of the drive, y axis up, on which both trajectories grow.
class DriveMap {
 public:
  DriveMap(const RunEvaluation& run, cv::Size size);

  /// The plan at a time. Times increase from call to call.
  cv::Mat3b at(std::int64_t stamp_ns);

 private:
  cv::Point2d pixel(const Eigen::Vector3d& world) const;
  void draw_truth();
  void draw_scale();
  void extend(const Trajectory& path, const Eigen::Isometry3d& world_from_path, std::size_t& next,
              std::int64_t stamp_ns, const cv::Scalar& colour);
  void draw_events(std::int64_t stamp_ns);
  void draw_vehicle(cv::Mat3b& picture) const;

  const RunEvaluation& run_;
  Eigen::Vector2d centre_m_;
  double px_per_m_ = 1.0;
  cv::Mat3b drawn_;
  std::size_t binocular_ = 0, enhanced_ = 0, corrections_ = 0;  // next to be drawn
  std::int64_t drawn_to_ns_ = INT64_MIN;
};

/// Colours of the plots, as OpenCV orders them.
namespace video_colours {
cv::Scalar truth();
cv::Scalar binocular();
cv::Scalar enhanced();
cv::Scalar correction();
cv::Scalar landmark();
}  // namespace video_colours

}  // namespace panvo::evaluation
