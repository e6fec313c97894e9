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
  int fewest_arms = 3;
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
        "what makes a junction: radon (more than one maximum of the Radon field, the paper's) or arms (three roads or "
        "more that leave one centre)",
        {"radon", "arms"});
    field(&P::gather, "gather", "", "judge the road gathered from all panoramas so far; false: each one by itself");
    field(&P::fewest_arms, "fewest_arms", "1", "roads that make a junction", 3, 8);
    field(&P::radon_share, "radon_share", "1", "length of a maximum of the Radon field, of the longest", 0.1, 1.0);
    field(&P::radon_separation_deg, "radon_separation_deg", "deg", "smallest angle between two of its maxima", 5.0,
          90.0);
    field(&P::driven_half_width_m, "driven_half_width_m", "m",
          "to either side of the path driven, and of the way ahead: road for certain, to learn from", 0.1, 3.0);
    field.group(&P::ground, "ground");
    field.group(&P::body, "body");
    field.group(&P::road, "road");
    field.group(&P::map, "map");
    field.group(&P::passable, "passable");
    field.group(&P::arms, "arms");
  }
};

/// What was seen in one panorama, with every step on the way, so that people can look at it. Masks are 8UC1, 0 or 255.
struct JunctionView {
  std::optional<SeenJunction> seen;  ///< by the paper's criterion: where the vehicle is, two roads to a maximum

  cv::Mat birds_eye;           ///< as the panorama; ahead is up
  cv::Mat body, learned_from;  ///< of it: the vehicle's own body; what was taken for road to learn from
  cv::Mat road_ratio;          ///< of it: log ratio of road, 32FC1
  cv::Mat road, passable;      ///< what is judged: of the bird's-eye view, or of the gathered map (odometry's axes)
  Eigen::Vector2d vehicle_px = Eigen::Vector2d::Zero();  ///< in those two, (column, row)
  RadonField radon;                                      ///< by the paper's criterion
  std::vector<RadonPeak> peaks;
  RoadArms arms;  ///< by ours; directions from "up" of the masks
};

/// Finds road junctions in panoramas [Lu2015 4.1]: projection to the ground, Gaussian mixture of the road, morphology, Radon.
class RoadJunctionDetector {
 public:
  /// For panoramas of one camera. Throws as GroundProjection does.
  RoadJunctionDetector(const JunctionDetectorParameters& parameters, const Eigen::Isometry3d& base_from_panorama,
                       cv::Size panorama_size, vision::StageObserver* observer = nullptr);

  /// Panoramas in order of time, each with where the vehicle was.
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
  std::deque<Eigen::Vector2d> driven_;  // the last places of the base, odometry's frame
};

}  // namespace panvo::landmark_builder
