// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/rig_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "camera_tree.hpp"
#include "outliers.hpp"
#include "panvo/calibration/calibration_error.hpp"
#include "panvo/calibration/first_lens.hpp"
#include "panvo/calibration/planar_pose.hpp"
#include "panvo/vision/camera_model.hpp"

namespace panvo::calibration {
namespace {

constexpr std::size_t kMinViews = 5;  // to estimate a lens
constexpr double kLoss_px = 1.0;      // while outliers are being removed
constexpr int kMaxRounds = 8;

/// The observations of one camera.
Observations only(const Observations& all, std::size_t camera) {
  Observations one{{all.cameras[camera]}, {all.image_sizes[camera]}, all.board_points, {}};
  for (const auto& view : all.views) one.views.push_back({view.name, {view.seen[camera]}});
  return one;
}

std::size_t seen_views(const Observations& one) {
  return static_cast<std::size_t>(
      std::count_if(one.views.begin(), one.views.end(), [](const View& view) { return !view.seen[0].empty(); }));
}

vision::LensCamera begin_lens(const Observations& one, vision::LensModel model) {
  std::vector<std::vector<Corner>> views;
  for (const auto& view : one.views) {
    if (!view.seen[0].empty()) views.push_back(view.seen[0]);
  }
  const auto lens = first_lens(views, one.board_points, one.image_sizes[0], model);
  if (!lens)
    throw CalibrationError(one.cameras[0] + ": no image yields a pose of the board; check the counts in --board");
  return *lens;
}

vision::CameraModel checked_model(const vision::LensCamera& lens, const std::string& name) {
  try {
    return vision::CameraModel(lens);
  } catch (const std::invalid_argument& error) {
    throw CalibrationError(fmt::format("{}: the camera {}", name, error.what()));
  }
}

void pose_boards(const Observations& one, Rig& rig) {
  const auto model = checked_model(rig.cameras[0].lens, one.cameras[0]);
  rig.reference_from_board.assign(one.views.size(), std::nullopt);
  for (std::size_t view = 0; view < one.views.size(); ++view)
    rig.reference_from_board[view] = planar_pose(one.views[view].seen[0], one.board_points,
                                                 [&](const Eigen::Vector2d& pixel) { return model.unproject(pixel); });
}

/// Adjusts and removes outliers alternately with a robust loss, then adjusts with a squared loss.
void settle(Observations& observations, BundleOptions options, Rig& rig, std::vector<Rejection>& rejections,
            std::vector<std::size_t>& strays, const std::string& who) {
  options.loss_px = kLoss_px;
  for (int round = 0; round < kMaxRounds; ++round) {
    if (!adjust(observations, options, rig))
      throw CalibrationError(
          who + ": no lens and poses fit the corners; check the description of the board and that it is flat");
    // whole sightings first, since a wrong one increases the errors of good corners elsewhere
    if (!reject_sightings(observations, rig, rejections) && !reject_corners(observations, rig, strays)) break;
  }
  options.loss_px = 0.0;
  if (!adjust(observations, options, rig))
    throw CalibrationError(
        who + ": the adjustment does not converge; take more images, with the board tilted and near the image borders");
}

void check_count(const Observations& one, const RigOptions& options) {
  const std::size_t needed = options.are_lenses_held ? 1 : kMinViews;
  const std::size_t count = seen_views(one);
  if (count >= needed) return;
  throw CalibrationError(fmt::format(
      "{}: the board is used in {} of {} images, at least {} are needed (20 recommended); {}", one.cameras[0], count,
      one.views.size(), needed,
      count == 0 ? "check the counts and the dictionary of --board, and that the board is sharp and fully visible"
                 : "take more images"));
}

/// Calibrates one camera alone.
Rig calibrate_one(Observations& one, const RigOptions& options, std::size_t camera, std::vector<Rejection>& rejections,
                  std::size_t& strays) {
  check_count(one, options);
  Rig rig;
  const auto& given = options.lenses[camera];
  rig.cameras.push_back({given ? *given : begin_lens(one, options.models[camera])});
  pose_boards(one, rig);
  std::vector<Rejection> rejected;
  std::vector<std::size_t> stray_corners{0};
  settle(one, {0, options.are_lenses_held}, rig, rejected, stray_corners, one.cameras[0]);
  for (auto& rejection : rejected) rejections.push_back({camera, rejection.view, rejection.reason});
  strays += stray_corners[0];
  check_count(one, options);
  return rig;
}

/// Sets the board poses, each from the first camera that saw the board.
void place_boards(const std::vector<Rig>& singles, Rig& rig) {
  const std::size_t views = singles.front().reference_from_board.size();
  rig.reference_from_board.assign(views, std::nullopt);
  for (std::size_t view = 0; view < views; ++view) {
    for (std::size_t camera = 0; camera < singles.size() && !rig.reference_from_board[view]; ++camera) {
      const auto& pose = singles[camera].reference_from_board[view];
      if (pose) rig.reference_from_board[view] = rig.cameras[camera].camera_from_reference.inverse() * *pose;
    }
  }
}

}  // namespace

RigCalibration calibrate(const Observations& observations, const RigOptions& options) {
  RigCalibration result;
  result.used = observations;
  result.stray_corners.assign(observations.cameras.size(), 0);
  std::vector<Rig> singles;
  BoardPoses poses;
  for (std::size_t camera = 0; camera < observations.cameras.size(); ++camera) {
    Observations one = only(observations, camera);
    singles.push_back(calibrate_one(one, options, camera, result.rejections, result.stray_corners[camera]));
    for (std::size_t view = 0; view < one.views.size(); ++view) {
      if (!singles.back().reference_from_board[view]) one.views[view].seen[0].clear();
      result.used.views[view].seen[camera] = one.views[view].seen[0];
    }
    poses.push_back(singles.back().reference_from_board);
  }
  const auto joined = join_cameras(poses, options.reference, observations.cameras);
  for (std::size_t camera = 0; camera < singles.size(); ++camera)
    result.rig.cameras.push_back({singles[camera].cameras[0].lens, joined[camera]});
  place_boards(singles, result.rig);
  const BundleOptions bundle{options.reference, options.are_lenses_held};
  settle(result.used, bundle, result.rig, result.rejections, result.stray_corners, "all cameras together");
  for (std::size_t camera = 0; camera < singles.size(); ++camera)
    checked_model(result.rig.cameras[camera].lens, observations.cameras[camera]);
  std::stable_sort(result.rejections.begin(), result.rejections.end(), [](const Rejection& a, const Rejection& b) {
    return std::pair(a.view, a.camera) < std::pair(b.view, b.camera);
  });
  result.residuals = residuals(result.used, result.rig);
  result.sigmas = uncertainty(result.used, bundle, result.rig);
  return result;
}

}  // namespace panvo::calibration
