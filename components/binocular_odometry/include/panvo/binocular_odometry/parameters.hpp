// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace panvo::binocular_odometry {

/// The tracking stage: features and their matches. Lengths are in pixels of the image as it is given.
struct TrackingParameters {
  std::string front_end = "klt";
  int max_features = 300;
  int pyramid_levels = 4;
  double smallest_gradient = 1.5;
  double smallest_correlation = 0.8;
  double nearest_depth_baselines = 5.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = TrackingParameters;
    field(
        &P::front_end, "front_end", "",
        "how features are followed: klt (corners, patches aligned over a pyramid) or sift (described and matched anew)",
        {"klt", "sift"});
    field(&P::max_features, "max_features", "1", "features kept a frame; sets the size of the cells that hold one each",
          50, 5000);
    field(&P::pyramid_levels, "pyramid_levels", "1",
          "levels of half size each; each doubles the motion that is followed unforeseen", 2, 6);
    field(&P::smallest_gradient, "smallest_gradient", "1/px",
          "grey levels per pixel that a corner needs in its weakest direction", 0.1, 50.0);
    field(&P::smallest_correlation, "smallest_correlation", "1", "normalised correlation that a match needs", 0.0, 1.0);
    field(&P::nearest_depth_baselines, "nearest_depth_baselines", "1",
          "depth of the nearest point, in baselines: bounds the disparity", 1.0, 100.0);
  }
};

/// The motion stage: RANSAC and two-stage local binocular bundle adjustment.
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
  double rotation_error_rad_per_m = 0.0003;
  double keyframe_parallax_px = 15.0;
  double keyframe_shared_ratio = 0.75;
  double acceleration = 2.0;
  double angular_acceleration = 0.2;
  int seed = 1;

  template <class Field>
  static void describe(Field&& field) {
    using P = MotionParameters;
    field(&P::ransac_iterations, "ransac_iterations", "1", "triples of points tried at most", 10, 10000);
    field(&P::ransac_threshold_px, "ransac_threshold_px", "px", "reprojection error of an inlier", 0.1, 20.0);
    field(&P::min_inliers, "min_inliers", "1", "inliers below which a frame's motion is not believed", 6, 1000);
    field(&P::min_inlier_ratio, "min_inlier_ratio", "1", "share of the candidates that inliers must make up", 0.0, 1.0);
    field(&P::loss_scale, "loss_scale", "1", "scale of Cauchy's robust loss, in standard deviations", 0.5, 20.0);
    field(&P::window_keyframes, "window_keyframes", "1", "keyframes adjusted together", 2, 50);
    field(&P::fixed_keyframes, "fixed_keyframes", "1",
          "of these, the oldest, which hold the others and stay as they are", 1, 49);
    field(
        &P::disparity_offset_step_px, "disparity_offset_step_px", "px",
        "how far a constant error of the disparity, left over by the calibration and estimated along, may move a frame",
        1e-6, 1.0);
    field(&P::motion_error_ratio, "motion_error_ratio", "1",
          "standard deviation per distance and per angle of what image noise does not explain (calibration, shutter)",
          0.0, 1.0);
    field(&P::rotation_error_rad_per_m, "rotation_error_rad_per_m", "rad/m",
          "as motion_error_ratio, rotation by distance", 0.0, 1.0);
    field(&P::keyframe_parallax_px, "keyframe_parallax_px", "px", "median motion of the features that makes a keyframe",
          1.0, 200.0);
    field(&P::keyframe_shared_ratio, "keyframe_shared_ratio", "1",
          "share of the last keyframe's features still seen, below which one is made", 0.1, 1.0);
    field(
        &P::acceleration, "acceleration", "m/s per sqrt(s)",
        "standard deviation of what the speed changes by within a second unseen: a car brakes and corners with 2 to 3 "
        "m/s^2; the pose is uncertain by it where no frame measures, by 9 m after 4 s",
        0.01, 100.0);
    field(&P::angular_acceleration, "angular_acceleration", "rad/s per sqrt(s)",
          "as acceleration, for rotation: a car turns into a side street within two seconds", 0.01, 100.0);
    field(&P::seed, "seed", "1", "of the random triples: the same seed, the same result", 0, 1000000);
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
