// SPDX-License-Identifier: Apache-2.0
#include "camera_tree.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "panvo/calibration/calibration_error.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::calibration {
namespace {

/// camera_from_other of each view that both cameras saw.
std::vector<Eigen::Isometry3d> shared(const BoardPoses& poses, std::size_t camera, std::size_t other) {
  std::vector<Eigen::Isometry3d> all;
  for (std::size_t view = 0; view < poses[camera].size(); ++view) {
    const auto& a = poses[camera][view];
    const auto& b = poses[other][view];
    if (a && b) all.push_back(*a * b->inverse());
  }
  return all;
}

/// The pose with the smallest sum of differences to the others (medoid); robust against outliers.
Eigen::Isometry3d middle(const std::vector<Eigen::Isometry3d>& poses) {
  std::size_t best = 0;
  double smallest = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    double sum = 0.0;
    for (const auto& other : poses) {
      const Eigen::Isometry3d between = poses[i].inverse() * other;
      sum += between.translation().norm() + vision::so3_log(between.linear()).norm();
    }
    if (i > 0 && sum >= smallest) continue;
    best = i;
    smallest = sum;
  }
  return poses[best];
}

}  // namespace

std::vector<Eigen::Isometry3d> join_cameras(const BoardPoses& poses, std::size_t reference,
                                            const std::vector<std::string>& names) {
  std::vector<std::optional<Eigen::Isometry3d>> found(poses.size());
  found[reference] = Eigen::Isometry3d::Identity();
  for (std::size_t step = 1; step < poses.size(); ++step) {
    std::size_t next = 0;
    std::size_t from = 0;
    std::vector<Eigen::Isometry3d> most;
    for (std::size_t camera = 0; camera < poses.size(); ++camera) {
      for (std::size_t other = 0; other < poses.size(); ++other) {
        if (found[camera] || !found[other]) continue;
        auto common = shared(poses, camera, other);
        if (common.size() <= most.size()) continue;
        most = std::move(common);
        next = camera;
        from = other;
      }
    }
    if (most.empty()) break;
    found[next] = middle(most) * *found[from];
  }
  std::vector<std::string> lonely;
  std::vector<Eigen::Isometry3d> all;
  for (std::size_t camera = 0; camera < poses.size(); ++camera) {
    if (!found[camera]) lonely.push_back(names[camera]);
    all.push_back(found[camera].value_or(Eigen::Isometry3d::Identity()));
  }
  if (!lonely.empty())
    throw CalibrationError(
        fmt::format("{}: no view shows the board together with a camera that is connected to '{}'; take images with "
                    "the board where two cameras see it at once (a part of a ChArUco board is enough)",
                    fmt::join(lonely, ", "), names[reference]));
  return all;
}

}  // namespace panvo::calibration
