// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulated_world/site.hpp"

#include <algorithm>
#include <utility>

#include "kerb_field.hpp"

namespace panvo::simulated_world {
namespace {

constexpr double kKerbHeight_m = 0.12;
constexpr double kWeakRadius_m = 20.0, kWeakFade_m = 14.0;  // around a junction with weak texture

}  // namespace

Site::Site(const SiteParameters& site_parameters, RoadNetwork network, std::shared_ptr<const Palette> materials)
    : parameters(site_parameters),
      roads(std::move(network)),
      terrain(site_parameters.seed, site_parameters.hilliness),
      palette(std::move(materials)),
      kerbs(std::make_shared<const KerbField>(roads)) {}

double Site::distance_from_kerb(const Eigen::Vector2d& point) const { return kerbs->distance_m(point); }

double Site::ground_m(const Eigen::Vector2d& point) const {
  const bool is_raised = parameters.layout != Layout::kHall && distance_from_kerb(point) >= 0.0;
  return terrain.height_m(point) + (is_raised ? kKerbHeight_m : 0.0);
}

double Site::weakness(const Eigen::Vector2d& point) const {
  if (!parameters.weak_texture) return 0.0;
  double weakness = 0.0;
  for (const Junction& junction : roads.junctions) {
    if (!junction.has_weak_texture) continue;
    const double beyond = ((junction.position - point).norm() - kWeakRadius_m) / kWeakFade_m;
    const double share = 1.0 - std::clamp(beyond, 0.0, 1.0);
    weakness = std::max(weakness, share * share * (3.0 - 2.0 * share));
  }
  return weakness;
}

}  // namespace panvo::simulated_world
