// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "panvo/simulation/renderer.hpp"
#include "panvo/simulation/road_network.hpp"
#include "panvo/simulation/site.hpp"
#include "panvo/simulation/vehicle_motion.hpp"

namespace panvo::simulation {

/// Somebody or something that moves along a path of its own, given in closed form.
struct Mover {
  std::uint32_t model = 0;
  Tint tint;
  double length_m = 4.5, width_m = 1.8;  ///< of the box around it, its middle at the model's origin
  double from_s = 0.0, to_s = 0.0;       ///< it is there only between

  std::vector<Eigen::Vector2d> path;  ///< m, world
  std::vector<double> along_m;        ///< of each point
  double start_m = 0.0;               ///< where on the path it is at from_s; it waits at the path's ends
  double speed_m_per_s = 0.0;
  bool walks = false;  ///< on foot: upright, on the pavement where there is one

  /// A vehicle that keeps ahead of ours on our path: from far ahead at from_s it lets us come near until near_from_s,
  /// stays so near until near_to_s, and is far ahead again at to_s.
  bool keeps_ahead = false;
  double near_from_s = 0.0, near_to_s = 0.0, near_m = 0.0, far_m = 0.0;  ///< between both middles
};

/// Cars and people on paths of their own, chosen so that the vehicle meets them: cars that come towards it, that drive
/// ahead of it (some so near that they fill half of the stereo view), that cross; people on pavements and across the
/// road. Closed-form in time; no one touches the vehicle.
class Traffic {
 public:
  /// Keeps references to `site` and `motion`. Throws std::invalid_argument when there are no models of a kind.
  Traffic(const Site& site, const VehicleMotion& motion, const MoverModels& models, std::uint64_t seed);

  /// An episode during which a mover is near enough to matter: for the record of the truth.
  struct Episode {
    double from_s = 0.0, to_s = 0.0;
    std::string kind;  ///< "ahead", "oncoming", "crossing", "pedestrian"
  };
  const std::vector<Episode>& episodes() const { return episodes_; }

  const std::vector<Mover>& movers() const { return movers_; }

  /// The movers about the vehicle while a shutter is open from `opened_s` to `closed_s`.
  std::vector<MovingPlacement> at(double opened_s, double closed_s) const;

 private:
  Eigen::Affine3f place(const Mover& mover, double t_s) const;

  std::vector<Mover> movers_;
  std::vector<Episode> episodes_;
  const VehicleMotion* motion_;
  const Site* site_;
};

/// Where a mover is on the ground: its middle and its heading.
struct GroundPlace {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;
};
GroundPlace ground_place(const Mover& mover, const VehicleMotion& motion, double t_s);

}  // namespace panvo::simulation
