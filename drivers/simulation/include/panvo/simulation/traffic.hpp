// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "panvo/simulation/renderer.hpp"
#include "panvo/simulation/road_network.hpp"
#include "panvo/simulation/site.hpp"
#include "panvo/simulation/vehicle_motion.hpp"

namespace panvo::simulation {

/// Cars and people on paths of their own, chosen so that the vehicle meets them: cars that come towards it, that drive
/// ahead of it (some so near that they fill half of the stereo view), that cross; people on pavements and across the
/// road. Closed-form in time.
class Traffic {
 public:
  Traffic(const Site& site, const VehicleMotion& motion, const MoverModels& models, std::uint64_t seed);

  /// An episode during which a mover is near enough to matter: for the record of the truth.
  struct Episode {
    double from_s = 0.0, to_s = 0.0;
    std::string kind;  ///< "ahead", "oncoming", "crossing", "pedestrian"
  };
  const std::vector<Episode>& episodes() const;

  /// The movers about the vehicle while a shutter is open from `opened_s` to `closed_s`.
  std::vector<MovingPlacement> at(double opened_s, double closed_s) const;

 private:
  struct Mover {
    std::uint32_t model = 0;
    Tint tint;
    double from_s = 0.0, to_s = 0.0;    ///< there only between
    std::vector<Eigen::Vector2d> path;  ///< m, world; a point about every metre
    std::vector<double> along_m;        ///< of each point
    double start_m = 0.0, speed_m_per_s = 0.0;
    bool follows_vehicle = false;  ///< keeps start_m ahead of it along its path
    double side_m = 0.0;           ///< to the left of the path
  };
  Eigen::Affine3f place(const Mover& mover, double t_s) const;

  std::vector<Mover> movers_;
  std::vector<Episode> episodes_;
  const VehicleMotion* motion_;
  const Site* site_;
};

}  // namespace panvo::simulation
