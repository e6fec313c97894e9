// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "panvo/simulated_world/palette.hpp"
#include "panvo/simulated_world/random.hpp"

namespace panvo::simulated_world {

/// The overlay of a material.
enum class Wear { kNone, kRoad, kNewRoad, kGround, kWall, kPlaster };

/// The recipe of a material.
struct Recipe {
  std::string name;
  float period_m = 1.0f;
  std::function<cv::Mat(Random)> paint;  ///< an encoded picture
  Wear wear = Wear::kNone;
  float gloss = 0.0f;
  float translucency = 0.0f;
  bool has_holes = false;
};

/// The recipes of all materials of the campus.
std::vector<Recipe> material_recipes(Season season);

}  // namespace panvo::simulated_world
