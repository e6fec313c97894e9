// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace panvo::binocular_odometry {

/// Parameters of the tracking stage. Lengths are in pixels of the input image.
struct TrackingParameters {
  std::string front_end = "klt";
  int max_features = 300;
  int pyramid_levels = 4;
  double min_gradient = 1.5;
  double min_correlation = 0.8;
  double nearest_depth_baselines = 5.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = TrackingParameters;
    field(&P::front_end, "front_end", "",
          "feature tracking: klt (corners, patches aligned over an image pyramid) or sift (detected and matched per "
          "frame)",
          {"klt", "sift"});
    field(&P::max_features, "max_features", "1",
          "features per frame; determines the size of the cells, which hold one each", 50, 5000);
    field(&P::pyramid_levels, "pyramid_levels", "1",
          "image pyramid levels; each doubles the largest unpredicted motion that can be tracked", 2, 6);
    field(&P::min_gradient, "min_gradient", "1/px",
          "minimum gradient of a corner along its weakest direction, grey levels per pixel", 0.1, 50.0);
    field(&P::min_correlation, "min_correlation", "1", "minimum normalised correlation of a match", 0.0, 1.0);
    field(&P::nearest_depth_baselines, "nearest_depth_baselines", "1",
          "depth of the nearest point, in baselines; limits the disparity", 1.0, 100.0);
  }
};

/// Parameters of the motion stage: RANSAC, which the tracking stage uses as well, and two-stage local binocular bundle
/// adjustment.
struct MotionParameters {
  int ransac_iterations = 100;
  double ransac_threshold_px = 2.0;
  int min_inliers = 20;
  double min_inlier_ratio = 0.25;
  double loss_scale = 2.0;
  int window_keyframes = 10;
  int fixed_keyframes = 3;
  double disparity_offset_step_px = 0.004;
  double motion_error_ratio = 0.012;
  double rotation_error_rad_per_m = 0.0002;
  double rectification_error_px = 0.002;
  double outlier_lean_rad_per_m = 0.005;
  double keyframe_parallax_px = 15.0;
  double keyframe_shared_ratio = 0.75;
  double acceleration = 2.0;
  double angular_acceleration = 0.2;
  int seed = 1;

  template <class Field>
  static void describe(Field&& field) {
    using P = MotionParameters;
    field(&P::ransac_iterations, "ransac_iterations", "1", "maximum number of sampled point triples", 10, 10000);
    field(&P::ransac_threshold_px, "ransac_threshold_px", "px",
          "maximum reprojection error of an inlier, in both stages", 0.1, 20.0);
    field(&P::min_inliers, "min_inliers", "1", "minimum inliers of a reliable frame", 6, 1000);
    field(&P::min_inlier_ratio, "min_inlier_ratio", "1", "minimum ratio of inliers to candidates", 0.0, 1.0);
    field(&P::loss_scale, "loss_scale", "1", "scale of the Cauchy loss, in standard deviations", 0.5, 20.0);
    field(&P::window_keyframes, "window_keyframes", "1", "keyframes in the adjustment window", 2, 50);
    field(&P::fixed_keyframes, "fixed_keyframes", "1", "oldest keyframes of the window, kept fixed as reference", 1,
          49);
    field(&P::disparity_offset_step_px, "disparity_offset_step_px", "px",
          "random walk per frame of the disparity offset (residual calibration error), which is estimated online", 1e-6,
          1.0);
    field(&P::motion_error_ratio, "motion_error_ratio", "1",
          "standard deviation per distance and per angle of errors other than image noise (calibration, shutter)", 0.0,
          1.0);
    field(&P::rotation_error_rad_per_m, "rotation_error_rad_per_m", "rad/m",
          "like motion_error_ratio, for rotation per distance; at least what rectification_error_px causes", 0.0, 1.0);
    field(&P::rectification_error_px, "rectification_error_px", "px",
          "standard deviation of lasting disparity errors that differ between the sides of the image: divided by focal "
          "length and baseline, what odometry turns per metre without noticing; stated in odometry/quality",
          1e-6, 10.0);
    field(
        &P::outlier_lean_rad_per_m, "outlier_lean_rad_per_m", "rad/m",
        "the same per share of points that contradict the motion: in rain, behind dirt or beside vehicles, points that "
        "agree with it are wrong, too",
        0.0, 1.0);
    field(&P::keyframe_parallax_px, "keyframe_parallax_px", "px",
          "median feature motion above which a keyframe is created", 1.0, 200.0);
    field(&P::keyframe_shared_ratio, "keyframe_shared_ratio", "1",
          "share of the last keyframe's features still tracked, below which a keyframe is created", 0.1, 1.0);
    field(&P::acceleration, "acceleration", "m/s per sqrt(s)",
          "standard deviation of the velocity change within one second of dead reckoning (cars brake and corner with "
          "2 to 3 m/s^2); the default gives a position sigma of 9 m after 4 s",
          0.01, 100.0);
    field(&P::angular_acceleration, "angular_acceleration", "rad/s per sqrt(s)",
          "like acceleration, for rotation: a car turns into a side street within two seconds", 0.01, 100.0);
    field(&P::seed, "seed", "1", "seed of the RANSAC sampling; equal seeds give equal results", 0, 1000000);
  }

  template <class Conflict>
  void find_conflicts(Conflict&& conflict) const {
    if (fixed_keyframes >= window_keyframes) conflict("fixed_keyframes", "must be less than", "window_keyframes");
  }
};

struct Parameters {
  TrackingParameters tracking;
  MotionParameters motion;

  template <class Field>
  static void describe(Field&& field) {
    using P = Parameters;
    field.group(&P::tracking, "tracking");
    field.group(&P::motion, "motion");
  }
};

}  // namespace panvo::binocular_odometry
