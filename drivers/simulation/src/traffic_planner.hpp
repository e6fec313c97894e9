// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "footprint.hpp"
#include "panvo/simulated_world/random.hpp"
#include "panvo/simulation/revisits.hpp"
#include "panvo/simulation/traffic.hpp"

namespace panvo::simulation {

inline constexpr double kOwnLength_m = 4.3;  ///< of the vehicle that carries the rig

/// Sets along_m from the path.
void measure(Mover& mover);

/// Draws random movers that the vehicle would meet, and keeps those that collide with nothing and neither appear nor
/// vanish within its sight (traffic_vehicles.cpp, traffic_pedestrians.cpp).
class TrafficPlanner {
 public:
  TrafficPlanner(const simulated_world::Site& site, const VehicleMotion& motion,
                 const simulated_world::MoverModels& models, std::uint64_t seed);

  void plan();

  std::vector<Mover> movers;
  std::vector<Traffic::Episode> episodes;

 private:
  void plan_ahead();
  void plan_crossing();
  void plan_oncoming();
  void plan_road_crossers();
  void plan_strollers();

  std::optional<Mover> ahead(double near_middle_s, simulated_world::Random random) const;
  std::optional<Mover> passing(const std::vector<int>& junctions, const Eigen::Vector2d& meeting, double meeting_s,
                               bool is_van, simulated_world::Random random) const;
  std::optional<Mover> road_crosser(double t_s, simulated_world::Random random) const;
  std::optional<Mover> stroller(double t_s, simulated_world::Random random) const;

  Mover vehicle_of(bool is_van, simulated_world::Random& random) const;
  Mover person(simulated_world::Random& random) const;
  /// Appends up to `count` junctions to a walk of at least two; stops at a dead end.
  void walk_on(std::vector<int>& junctions, int count, simulated_world::Random& random) const;
  /// Sets from_s, to_s and start_m so that the mover is at `along` at `t_s` and exists while it is near. False if it
  /// would appear or vanish within sight.
  bool live(Mover& mover, double along, double t_s) const;

  /// The same for a pedestrian, who waits at the path's ends.
  void live_waiting(Mover& mover, double along, double t_s) const;

  Footprint own(double t_s) const;
  Footprint of(const Mover& mover, double t_s) const;
  bool keeps_clear(const Mover& mover, double of_vehicle_m, double of_movers_m) const;
  bool accept(const std::optional<Mover>& mover, double of_vehicle_m, double of_movers_m, const char* kind,
              double episode_m);

  const simulated_world::Site& site_;
  const VehicleMotion& motion_;
  const simulated_world::MoverModels& models_;
  simulated_world::Random random_;
  std::vector<Footprint> own_;  // every kStep_s
  std::vector<Visit> visits_;
};

}  // namespace panvo::simulation
