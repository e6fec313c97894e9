// SPDX-License-Identifier: Apache-2.0
#include "drive_map.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "angle_units.hpp"
#include "plot_axes.hpp"
#include "plot_canvas.hpp"

namespace panvo::evaluation {
namespace {

constexpr int kShift = 4;  // OpenCV draws lines on a sixteenth of a pixel
constexpr double kMargin_px = 30.0;

cv::Scalar from_hex(const char* colour) {
  const auto value = std::stoul(colour + 1, nullptr, 16);
  return {static_cast<double>(value & 255), static_cast<double>(value >> 8 & 255), static_cast<double>(value >> 16)};
}

cv::Point fixed(const cv::Point2d& pixel) {
  return {static_cast<int>(std::lround(pixel.x * (1 << kShift))),
          static_cast<int>(std::lround(pixel.y * (1 << kShift)))};
}

void line(cv::Mat3b& picture, const cv::Point2d& from, const cv::Point2d& to, const cv::Scalar& colour, int width) {
  cv::line(picture, fixed(from), fixed(to), colour, width, cv::LINE_AA, kShift);
}

void dot(cv::Mat3b& picture, const cv::Point2d& at, double radius_px, const cv::Scalar& colour, int width) {
  cv::circle(picture, fixed(at), static_cast<int>(std::lround(radius_px * (1 << kShift))), colour, width, cv::LINE_AA,
             kShift);
}

/// Opposite corners of the box around all paths.
std::pair<Eigen::Vector2d, Eigen::Vector2d> extent_of(const JourneyFrames& frames) {
  Eigen::Vector2d least = Eigen::Vector2d::Constant(1e18), most = -least;
  const auto add = [&](const Trajectory& path, const Eigen::Isometry3d& world_from_path) {
    for (const auto& pose : path.poses) {
      const Eigen::Vector2d at = (world_from_path * pose.world_from_base.translation()).head<2>();
      least = least.cwiseMin(at);
      most = most.cwiseMax(at);
    }
  };
  add(frames.recording.truth, Eigen::Isometry3d::Identity());
  add(frames.run.binocular, frames.world_from_odom);
  add(frames.run.enhanced, frames.world_from_map);
  return {least, most};
}

}  // namespace

namespace video_colours {
cv::Scalar truth() { return from_hex(kTruthColour); }
cv::Scalar binocular() { return from_hex(kColours[1]); }
cv::Scalar enhanced() { return from_hex(kColours[0]); }
cv::Scalar correction() { return from_hex(kColours[2]); }
cv::Scalar landmark() { return from_hex(kColours[4]); }
}  // namespace video_colours

DriveMap::DriveMap(const RunEvaluation& run, cv::Size size) : run_(run), drawn_(size, cv::Vec3b(255, 255, 255)) {
  const auto [least, most] = extent_of(run.frames);
  centre_m_ = 0.5 * (least + most);
  const Eigen::Vector2d span_m = (most - least).cwiseMax(1.0);
  px_per_m_ = std::min((size.width - 2.0 * kMargin_px) / span_m.x(), (size.height - 2.0 * kMargin_px) / span_m.y());
  draw_truth();
  draw_scale();
}

cv::Point2d DriveMap::pixel(const Eigen::Vector3d& world) const {
  const Eigen::Vector2d from_centre = px_per_m_ * (world.head<2>() - centre_m_);
  return {0.5 * drawn_.cols + from_centre.x(), 0.5 * drawn_.rows - from_centre.y()};
}

void DriveMap::draw_truth() {
  const auto& poses = run_.frames.recording.truth.poses;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    line(drawn_, pixel(poses[i - 1].world_from_base.translation()), pixel(poses[i].world_from_base.translation()),
         video_colours::truth(), 5);
  }
}

void DriveMap::draw_scale() {
  const double length_m = round_number_below(0.25 * drawn_.cols / px_per_m_);
  const cv::Point2d left(kMargin_px, drawn_.rows - 14.0), right = left + cv::Point2d(length_m * px_per_m_, 0.0);
  const cv::Scalar ink(90, 90, 90);
  line(drawn_, left, right, ink, 2);
  cv::putText(drawn_, fmt::format("{:g} m", length_m), {static_cast<int>(right.x) + 8, drawn_.rows - 9},
              cv::FONT_HERSHEY_SIMPLEX, 0.5, ink, 1, cv::LINE_AA);
}

void DriveMap::extend(const Trajectory& path, const Eigen::Isometry3d& world_from_path, std::size_t& next,
                      std::int64_t stamp_ns, const cv::Scalar& colour) {
  for (; next < path.poses.size() && path.poses[next].stamp_ns <= stamp_ns; ++next) {
    if (next == 0) continue;
    line(drawn_, pixel(world_from_path * path.poses[next - 1].world_from_base.translation()),
         pixel(world_from_path * path.poses[next].world_from_base.translation()), colour, 2);
  }
}

/// Landmarks since the last call, and corrections: from the position before to that after.
void DriveMap::draw_events(std::int64_t stamp_ns) {
  for (const auto& landmark : run_.frames.run.landmarks) {
    if (landmark.stamp_ns <= drawn_to_ns_ || landmark.stamp_ns > stamp_ns) continue;
    dot(drawn_, pixel((run_.frames.world_from_map * landmark.map_from_base).translation()), 4.0,
        video_colours::landmark(), cv::FILLED);
  }
  const auto& applied = run_.revisits.applied;
  for (; corrections_ < applied.size() && applied[corrections_].stamp_ns <= stamp_ns; ++corrections_) {
    const auto& correction = applied[corrections_];
    const auto on_map = [&](const Eigen::Vector2d& at) { return pixel({at.x(), at.y(), 0.0}); };
    line(drawn_, on_map(correction.before_position_m), on_map(correction.after_position_m), video_colours::correction(),
         2);
    dot(drawn_, on_map(correction.after_position_m), 5.0, video_colours::correction(), 2);
  }
}

/// An arrowhead at the enhanced pose, and the 95 % ellipse of its position.
void DriveMap::draw_vehicle(cv::Mat3b& picture) const {
  if (enhanced_ == 0) return;
  const auto& latest = run_.frames.run.enhanced.poses[enhanced_ - 1];
  const Eigen::Isometry3d world_from_base = run_.frames.world_from_map * latest.world_from_base;
  const cv::Point2d at = pixel(world_from_base.translation());
  const auto& covariances = run_.frames.run.enhanced_covariances;
  if (covariances && covariances->contains(latest.stamp_ns)) {
    constexpr double kSigmas = 2.4477;  // 95 % of two dimensions
    const Eigen::Matrix2d turn = run_.frames.world_from_map.linear().topLeftCorner<2, 2>();
    const Eigen::Matrix2d spread =
        turn * covariances->at(latest.stamp_ns).pose.topLeftCorner<2, 2>() * turn.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
    const Eigen::Vector2d half_px = kSigmas * px_per_m_ * axes.eigenvalues().cwiseMax(0.0).cwiseSqrt();
    const Eigen::Vector2d longest = axes.eigenvectors().col(1);
    if (half_px.maxCoeff() < 2.0 * picture.cols) {
      cv::ellipse(picture,
                  cv::RotatedRect(at, cv::Size2d(2.0 * half_px.y() + 1.0, 2.0 * half_px.x() + 1.0),
                                  static_cast<float>(-std::atan2(longest.y(), longest.x()) * kDegrees)),
                  video_colours::enhanced(), 1, cv::LINE_AA);
    }
  }
  const double yaw = yaw_of(world_from_base);
  const auto corner = [&](double angle, double radius_px) {
    return fixed({at.x + radius_px * std::cos(yaw + angle), at.y - radius_px * std::sin(yaw + angle)});
  };
  const std::vector<cv::Point> arrow{corner(0.0, 14.0), corner(2.5, 10.0), corner(std::numbers::pi, 4.0),
                                     corner(-2.5, 10.0)};
  cv::fillPoly(picture, std::vector{arrow}, video_colours::enhanced(), cv::LINE_AA, kShift);
}

cv::Mat3b DriveMap::at(std::int64_t stamp_ns) {
  const auto& frames = run_.frames;
  extend(frames.run.binocular, frames.world_from_odom, binocular_, stamp_ns, video_colours::binocular());
  extend(frames.run.enhanced, frames.world_from_map, enhanced_, stamp_ns, video_colours::enhanced());
  draw_events(stamp_ns);
  drawn_to_ns_ = stamp_ns;
  cv::Mat3b picture = drawn_.clone();
  draw_vehicle(picture);
  return picture;
}

}  // namespace panvo::evaluation
