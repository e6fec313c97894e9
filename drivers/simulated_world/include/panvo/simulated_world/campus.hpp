// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>

#include "panvo/simulated_world/scene.hpp"
#include "panvo/simulated_world/site.hpp"

namespace panvo::simulated_world {

/// The complete campus, ready to render.
struct Campus {
  std::shared_ptr<const Site> site;
  std::shared_ptr<const Scene> scene;
  MoverModels movers;
};

/// Builds the campus from the seed; `assets`: folder of photographs (see Palette), or empty.
Campus build_campus(const SiteParameters& parameters, const std::filesystem::path& assets = {});

}  // namespace panvo::simulated_world
