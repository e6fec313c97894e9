// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "panvo/simulated_world/mesh.hpp"
#include "panvo/simulated_world/palette.hpp"
#include "panvo/simulated_world/random.hpp"

namespace panvo::simulated_world {

/// The palette indices of mover materials.
struct MoverMaterials {
  explicit MoverMaterials(const Palette& palette);

  std::uint16_t car_paint, car_glass, car_trim, tyre, rim, lamp_head, lamp_rear, plate, skin, hair, cloth_a, cloth_b,
      cloth_c, shoes;
};

/// A car's shape, m. x forward from its centre, z above the ground.
struct CarShape {
  float length = 4.3f, width = 1.76f, roof = 1.46f;
  float sill = 0.22f;  ///< lower edge of its sides
  float nose = 0.72f, bonnet = 0.92f,
        belt = 0.95f;                ///< heights of the front edge, before the windscreen, of the windows' lower edge
  float tail = 0.95f, boot = 0.98f;  ///< heights of the rear edge, behind the rear window
  float screen_foot = 0.95f, screen_top = 0.25f;  ///< x of the windscreen's ends
  float rear_foot = -1.75f, rear_top = -1.3f;     ///< x of the rear window's ends
  float front_wheel = 1.3f, rear_wheel = -1.3f;   ///< x
  float wheel_radius = 0.31f;
  float lean = 0.8f;                           ///< half width at the roof's edge relative to the windows' lower edge
  std::vector<std::pair<float, float>> panes;  ///< side windows, as fractions from rear to front
  bool has_rear_window = true;
  Tint body = {};  ///< multiplies the paint
};

/// Builds a car, van or bus of that shape.
Mesh build_car(const CarShape& shape, const MoverMaterials& materials);

/// Builds a lorry: a cab with a box body.
Mesh build_lorry(const MoverMaterials& materials);

/// Builds a person in mid-stride with random clothes.
Mesh build_person(const MoverMaterials& materials, Random random);

/// Shapes of cars and vans (all different), and of the vehicle that carries the rig.
std::vector<CarShape> car_shapes();
std::vector<CarShape> van_shapes();
CarShape own_vehicle_shape();

}  // namespace panvo::simulated_world
