// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "panvo/landmark_builder/body_mask.hpp"
#include "panvo/landmark_builder/ground_projection.hpp"
#include "panvo/landmark_builder/junction_filter.hpp"
#include "panvo/landmark_builder/passable_region.hpp"
#include "panvo/landmark_builder/radon_field.hpp"
#include "panvo/landmark_builder/road_arms.hpp"
#include "panvo/landmark_builder/road_map.hpp"
#include "panvo/landmark_builder/road_model.hpp"
#include "panvo/vision/stage_observer.hpp"

namespace panvo::landmark_builder {

struct JunctionDetectorParameters {
  std::string criterion = "arms";
  bool gather = true;
  int min_arms = 3;
  double radon_share = 0.6;
  double radon_separation_deg = 25.0;
  double driven_half_width_m = 0.9;
  GroundProjectionParameters ground;
  BodyMaskParameters body;
  RoadModelParameters road;
  RoadMapParameters map;
  PassableRegionParameters passable;
  RoadArmsParameters arms;

  template <class Field>
  static void describe(Field&& field) {
    using P = JunctionDetectorParameters;
    field(
        &P::criterion, "criterion", "",
        "criterion of a junction: radon (the paper's: several maxima of the Radon field) or arms (three or more roads "
        "leave one centre)",
        {"radon", "arms"});
    field(&P::gather, "gather", "", "accumulate the road over panoramas; false: each panorama individually");
    field(&P::min_arms, "min_arms", "1", "fewest roads of a junction", 3, 8);
    field(&P::radon_share, "radon_share", "1", "smallest maximum of the Radon field, fraction of the largest", 0.1,
          1.0);
    field(&P::radon_separation_deg, "radon_separation_deg", "deg", "smallest angle between two maxima", 5.0, 90.0);
    field(&P::driven_half_width_m, "driven_half_width_m", "m",
          "half the width of the strip along the driven path and ahead that is used as road for training", 0.1, 3.0);
    field.group(&P::ground, "ground");
    field.group(&P::body, "body");
    field.group(&P::road, "road");
    field.group(&P::map, "map");
    field.group(&P::passable, "passable");
    field.group(&P::arms, "arms");
  }
};

/// Result for one panorama with all intermediate steps, for inspection. Masks are 8UC1, 0 or 255.
struct JunctionView {
  std::optional<SeenJunction> seen;  ///< the `radon` criterion gives the vehicle's position, and two roads per maximum

  cv::Mat birds_eye;           ///< same type as the panorama; ahead is up
  cv::Mat body, learned_from;  ///< in it: the vehicle's body; the pixels used for training
  cv::Mat road_ratio;          ///< in it: log ratio of road, 32FC1
  cv::Mat road, passable;      ///< the evaluated mask: of this view or the accumulated map (odometry axes)
  Eigen::Vector2d vehicle_px = Eigen::Vector2d::Zero();  ///< in these two, (column, row)
  RadonField radon;                                      ///< criterion `radon`
  std::vector<RadonPeak> peaks;
  RoadArms arms;  ///< criterion `arms`; directions from "up" of the masks
};

/// Detects road junctions in panoramas [Lu2015 4.1]: ground projection, Gaussian mixture of the road, morphology,
/// Radon.
class RoadJunctionDetector {
 public:
  /// For panoramas of one camera. Throws like GroundProjection.
  RoadJunctionDetector(const JunctionDetectorParameters& parameters, const Eigen::Isometry3d& base_from_panorama,
                       cv::Size panorama_size, vision::StageObserver* observer = nullptr);

  /// Processes panoramas in order of time, with the vehicle's pose.
  JunctionView detect(const cv::Mat& panorama, const Eigen::Isometry3d& odom_from_base);

  const RoadModel& road_model() const noexcept { return road_model_; }
  const GroundGrid& grid() const noexcept { return projection_.grid(); }
  double mask_resolution_m() const noexcept { return projection_.grid().resolution_m; }

 private:
  cv::Mat certain_road(const PlanarPose& pose) const;
  void remember(const PlanarPose& pose);
  void judge(JunctionView& view, const PlanarPose& pose) const;

  JunctionDetectorParameters parameters_;
  vision::StageObserver* observer_;
  GroundProjection projection_;
  cv::Mat range_weight_;
  BodyMask body_;
  RoadModel road_model_;
  RoadMap map_;
  std::deque<Eigen::Vector2d> driven_;  // recent positions of the base, odometry frame
};

}  // namespace panvo::landmark_builder
