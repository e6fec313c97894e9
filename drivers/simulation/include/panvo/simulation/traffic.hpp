// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "panvo/simulated_world/renderer.hpp"
#include "panvo/simulated_world/road_network.hpp"
#include "panvo/simulated_world/site.hpp"
#include "panvo/simulation/vehicle_motion.hpp"

namespace panvo::simulation {

/// A vehicle or person that moves along a path, in closed form.
struct Mover {
  std::uint32_t model = 0;
  simulated_world::Tint tint;
  double length_m = 4.5, width_m = 1.8;  ///< of its bounding box, centred at the model's origin
  double from_s = 0.0, to_s = 0.0;       ///< time span in which it exists

  std::vector<Eigen::Vector2d> path;  ///< m, world
  std::vector<double> along_m;        ///< of each point
  double start_m = 0.0;               ///< position on the path at from_s; it waits at the path's ends
  double speed_m_per_s = 0.0;
  bool walks = false;  ///< a pedestrian: upright, on the pavement where there is one

  /// A vehicle that stays ahead of ours on our path: far ahead at from_s, near from near_from_s to near_to_s, and far
  /// ahead again at to_s.
  bool keeps_ahead = false;
  double near_from_s = 0.0, near_to_s = 0.0, near_m = 0.0, far_m = 0.0;  ///< distances between both centres
};

/// Cars and people whose paths are chosen so that the vehicle meets them: oncoming and crossing cars, cars ahead (some
/// so near that they fill half of the stereo view), people on pavements and crossing the road. Closed-form in time;
/// nothing touches the vehicle.
class Traffic {
 public:
  /// Keeps references to `site` and `motion`. Throws std::invalid_argument if a kind has no models.
  Traffic(const simulated_world::Site& site, const VehicleMotion& motion, const simulated_world::MoverModels& models,
          std::uint64_t seed);

  /// A period in which a mover is near the vehicle, for the ground truth file.
  struct Episode {
    double from_s = 0.0, to_s = 0.0;
    std::string kind;  ///< "ahead", "oncoming", "crossing", "pedestrian"
  };
  const std::vector<Episode>& episodes() const { return episodes_; }

  const std::vector<Mover>& movers() const { return movers_; }

  /// The movers near the vehicle while a shutter is open from `opened_s` to `closed_s`.
  std::vector<simulated_world::MovingPlacement> at(double opened_s, double closed_s) const;

 private:
  Eigen::Affine3f place(const Mover& mover, double t_s) const;

  std::vector<Mover> movers_;
  std::vector<Episode> episodes_;
  const VehicleMotion* motion_;
  const simulated_world::Site* site_;
};

/// A mover's pose on the ground: its centre and heading.
struct GroundPlace {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;
};
GroundPlace ground_place(const Mover& mover, const VehicleMotion& motion, double t_s);

}  // namespace panvo::simulation
