// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "panvo/landmark_builder/road_map.hpp"

namespace panvo::landmark_builder {

struct BodyMaskParameters {
  bool learn = true;
  double ahead_m = 3.5;
  double behind_m = 3.5;
  double side_m = 2.0;
  double farthest_m = 10.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = BodyMaskParameters;
    field(&P::learn, "learn", "",
          "find out what the vehicle covers of the ground: it stays as it is while the ground goes by");
    field(&P::ahead_m, "ahead_m", "m", "covered at least, ahead of the base", 0.0, 20.0);
    field(&P::behind_m, "behind_m", "m", "covered at least, behind the base", 0.0, 20.0);
    field(&P::side_m, "side_m", "m", "covered at least, to either side", 0.0, 20.0);
    field(&P::farthest_m, "farthest_m", "m", "covered at most, from the base", 1.0, 30.0);
  }
};

/// What of a bird's-eye view shows the vehicle's own body: an ellipse that is given, and what is learned on the way. A pixel of
/// the ground looks like the pixel that the vehicle has moved away from; one of the body looks like itself before.
class BodyMask {
 public:
  BodyMask(const BodyMaskParameters& parameters, const GroundGrid& grid);

  /// Compares a view (8UC1 or 8UC3) with the one before, once the vehicle has moved far enough between them.
  void learn(const cv::Mat& view, const PlanarPose& odom_from_base);

  /// 8UC1: 255 where the body is.
  const cv::Mat& mask() const noexcept { return mask_; }

 private:
  void update_mask();

  BodyMaskParameters parameters_;
  GroundGrid grid_;
  cv::Mat given_, possible_, mask_;
  cv::Mat previous_;  // what of the last view is compared: its detail
  PlanarPose previous_pose_;
  cv::Mat stays_, goes_;  // sums of differences, 32FC1
  double moved_m_ = 0.0;
};

}  // namespace panvo::landmark_builder
