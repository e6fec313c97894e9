// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulated_world/palette.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "material_recipes.hpp"
#include "painters.hpp"

namespace panvo::simulated_world {
namespace {

struct Overlay {
  std::shared_ptr<const Texture> texture;
  float period_m = 1.0f;
  bool is_scattered = false;
};

Overlay make_overlay(Wear wear, const Random& random) {
  const auto texture = [](const cv::Mat1f& factor) { return std::make_shared<const Texture>(encoded_overlay(factor)); };
  switch (wear) {
    case Wear::kRoad:
      return {texture(paint_road_wear(1.0f, random)), 12.0f, true};
    case Wear::kNewRoad:
      return {texture(paint_road_wear(0.25f, random)), 11.0f, true};
    case Wear::kGround:
      return {texture(paint_ground_wear(1.0f, random)), 7.0f, true};
    case Wear::kWall:
      return {texture(paint_wall_wear(0.8f, 0.0f, random)), 16.0f, false};
    case Wear::kPlaster:
      return {texture(paint_wall_wear(1.0f, 1.0f, random)), 16.0f, false};
    case Wear::kNone:
      break;
  }
  return {};
}

/// Coverage by snow of what faces upwards: traffic and clearing leave some of it on roads, nothing on glass and vehicles.
float snow_on(const std::string& material) {
  if (material == "glass" || material.starts_with("car_")) return 0.0f;
  return material.starts_with("asphalt") || material.starts_with("cobbles") ? 0.35f : 1.0f;
}

/// Coverage by water of what faces upwards: it runs off roads and pavements slowly, and seeps away elsewhere.
float wetness_of(const std::string& material) {
  constexpr std::array<std::string_view, 6> kPaved{"slabs", "cobbles", "concrete", "kerb", "marking", "manhole"};
  return material.starts_with("asphalt") || std::ranges::find(kPaved, material) != kPaved.end() ? 1.0f : 0.0f;
}

/// The nearest power of two, at most 2048.
int nearest_power_of_two(int size) {
  const auto floor = std::bit_floor(static_cast<unsigned>(std::clamp(size, 1, 2048)));
  return static_cast<int>(static_cast<unsigned>(size) > floor + floor / 2 && floor < 2048 ? 2 * floor : floor);
}

cv::Mat read_photograph(const std::filesystem::path& file) {
  cv::Mat picture = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
  if (picture.empty() || picture.depth() != CV_8U) {
    throw std::runtime_error(
        fmt::format("{}: cannot be read as an image with 8 bits per channel; save it as JPEG or PNG", file.string()));
  }
  switch (picture.channels()) {
    case 1:
      cv::cvtColor(picture, picture, cv::COLOR_GRAY2RGBA);
      break;
    case 3:
      cv::cvtColor(picture, picture, cv::COLOR_BGR2RGBA);
      break;
    default:
      cv::cvtColor(picture, picture, cv::COLOR_BGRA2RGBA);
  }
  const cv::Size size(nearest_power_of_two(picture.cols), nearest_power_of_two(picture.rows));
  cv::resize(picture, picture, size, 0.0, 0.0, size.width < picture.cols ? cv::INTER_AREA : cv::INTER_LINEAR);
  cv::flip(picture, picture, 0);  // v points up
  return picture;
}

/// The photographs of the folder, by material name.
std::map<std::string, cv::Mat> read_photographs(const std::filesystem::path& assets,
                                                const std::vector<Recipe>& recipes) {
  std::map<std::string, cv::Mat> photographs;
  if (assets.empty()) return photographs;
  if (!std::filesystem::is_directory(assets)) {
    throw std::runtime_error(fmt::format("{}: no such folder", assets.string()));
  }
  for (const auto& entry : std::filesystem::directory_iterator(assets)) {
    const std::filesystem::path& file = entry.path();
    if (file.extension() != ".jpg" && file.extension() != ".png") continue;
    const std::string name = file.stem().string();
    if (std::ranges::none_of(recipes, [&](const Recipe& recipe) { return recipe.name == name; })) {
      throw std::runtime_error(fmt::format("{}: unknown material '{}'", file.string(), name));
    }
    if (!photographs.emplace(name, read_photograph(file)).second) {
      throw std::runtime_error(fmt::format("{}: second photograph of '{}'; remove one", file.string(), name));
    }
  }
  return photographs;
}

Material material_of(const Recipe& recipe, const cv::Mat& picture) {
  Material material;
  material.name = recipe.name;
  material.albedo = std::make_shared<const Texture>(picture);
  material.period_m = recipe.period_m;
  material.gloss = recipe.gloss;
  material.translucency = recipe.translucency;
  material.has_holes = recipe.has_holes;
  return material;
}

cv::Mat grey_picture() { return cv::Mat(4, 4, CV_8UC4, cv::Scalar(128.0, 128.0, 128.0, 255.0)); }

}  // namespace

Palette Palette::unpainted() {
  Palette palette;
  for (const Recipe& recipe : material_recipes(Season::kSummer))
    palette.materials_.push_back(material_of(recipe, grey_picture()));
  return palette;
}

Palette::Palette(std::uint64_t seed, const std::filesystem::path& assets, Season season, bool wet,
                 const std::vector<std::string>& only) {
  const std::vector<Recipe> recipes = material_recipes(season);
  const auto photographs = read_photographs(assets, recipes);
  constexpr std::array kWears{Wear::kNone, Wear::kRoad, Wear::kNewRoad, Wear::kGround, Wear::kWall, Wear::kPlaster};
  std::vector<Overlay> overlays(kWears.size());
  materials_.resize(recipes.size());
  const auto is_painted = [&](const Recipe& recipe) {
    return only.empty() || std::ranges::find(only, recipe.name) != only.end();
  };
  const auto is_needed = [&](Wear wear) {
    return std::ranges::any_of(recipes, [&](const Recipe& one) { return one.wear == wear && is_painted(one); });
  };

  // Each picture depends only on the seed and its name; they are distributed over the thread pool.
  const int jobs = static_cast<int>(overlays.size() + recipes.size());
  const auto make = [&](int job) {
    if (job < static_cast<int>(overlays.size())) {
      if (is_needed(kWears[job])) overlays[job] = make_overlay(kWears[job], Random(seed, "overlay").part(job));
      return;
    }
    const Recipe& recipe = recipes[job - overlays.size()];
    const auto photograph = photographs.find(recipe.name);
    const cv::Mat picture = photograph != photographs.end() ? photograph->second
                            : is_painted(recipe)            ? recipe.paint(Random(seed, recipe.name))
                                                            : grey_picture();
    Material& material = materials_[job - overlays.size()];
    material = material_of(recipe, picture);
    if (season == Season::kSnow) material.snow = snow_on(recipe.name);
    if (wet) material.wet = wetness_of(recipe.name);
  };
  std::vector<std::exception_ptr> failures(jobs);
  cv::parallel_for_(
      {0, jobs},
      [&](const cv::Range& range) {
        for (int job = range.start; job < range.end; ++job) {
          try {
            make(job);
          } catch (...) {
            failures[job] = std::current_exception();
          }
        }
      },
      jobs);
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
  for (std::size_t number = 0; number < recipes.size(); ++number) {
    if (!is_painted(recipes[number])) continue;
    const auto wear = std::ranges::find(kWears, recipes[number].wear);
    const Overlay& overlay = overlays[wear - kWears.begin()];
    materials_[number].overlay = overlay.texture;
    materials_[number].overlay_period_m = overlay.period_m;
    materials_[number].overlay_is_scattered = overlay.is_scattered;
  }
}

std::uint16_t Palette::find(std::string_view name) const {
  const auto found = std::ranges::find(materials_, name, &Material::name);
  if (found == materials_.end()) throw std::out_of_range(fmt::format("unknown material '{}'", name));
  return static_cast<std::uint16_t>(found - materials_.begin());
}

std::vector<std::uint16_t> Palette::family(std::string_view prefix) const {
  std::vector<std::uint16_t> numbers;
  for (std::size_t number = 0; number < materials_.size(); ++number) {
    if (materials_[number].name.starts_with(prefix)) numbers.push_back(static_cast<std::uint16_t>(number));
  }
  return numbers;
}

}  // namespace panvo::simulated_world
