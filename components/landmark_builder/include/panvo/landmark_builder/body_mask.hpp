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
  double max_distance_m = 10.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = BodyMaskParameters;
    field(&P::learn, "learn", "",
          "learn the image region of the vehicle body, which is constant while the ground moves");
    field(&P::ahead_m, "ahead_m", "m", "minimum extent of the body ahead of the base", 0.0, 20.0);
    field(&P::behind_m, "behind_m", "m", "minimum extent of the body behind the base", 0.0, 20.0);
    field(&P::side_m, "side_m", "m", "minimum extent of the body to either side", 0.0, 20.0);
    field(&P::max_distance_m, "max_distance_m", "m", "maximum distance of the body from the base", 1.0, 30.0);
  }
};

/// Region of a bird's-eye view that shows the vehicle's own body: a given ellipse, extended by learning. A ground pixel
/// matches the previous view shifted by the vehicle's motion; a body pixel matches the previous view unshifted.
class BodyMask {
 public:
  BodyMask(const BodyMaskParameters& parameters, const GroundGrid& grid);

  /// Compares a view (8UC1 or 8UC3) with the previous one if the vehicle has moved far enough between them.
  void learn(const cv::Mat& view, const PlanarPose& odom_from_base);

  /// 8UC1: 255 on the body.
  const cv::Mat& mask() const noexcept { return mask_; }

 private:
  void update_mask();

  BodyMaskParameters parameters_;
  GroundGrid grid_;
  cv::Mat given_, possible_, mask_;
  cv::Mat previous_;  // detail of the previous view
  PlanarPose previous_pose_;
  cv::Mat stays_, goes_;  // sums of the differences without and with motion compensation, 32FC1
  double moved_m_ = 0.0;
};

}  // namespace panvo::landmark_builder
