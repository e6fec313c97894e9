// SPDX-License-Identifier: Apache-2.0
#include "ground_parts.hpp"
#include "panvo/simulated_world/site.hpp"

namespace panvo::simulated_world {

void build_ground(const Site& site, Scene& scene) {
  const GroundZones zones(site);
  const GroundPaint paint(site);
  scene.fixed.push_back(ground_surface(site, zones, paint));
  scene.fixed.push_back(kerb_stones(site, paint));
  Drape drape(site, paint);
  lay_repairs(site, zones, drape);
  lay_markings(site, zones, drape);
  lay_covers(site, zones, drape);
  scene.fixed.push_back(drape.take());
}

}  // namespace panvo::simulated_world
