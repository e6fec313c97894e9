// SPDX-License-Identifier: Apache-2.0
#include "shading_materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <opencv2/core/utility.hpp>
#include <stdexcept>

namespace panvo::simulated_world {
namespace {

constexpr std::size_t kMaxMaterials = 256;   // a surface record has eight bits for the index
constexpr std::uint32_t kOpaque = 181;       // 255 times the square root of 0.5
constexpr float kEnvironmentSpread = 0.05f;  // rad: about the size of an entry

/// A level of a texture's pyramid, stored in tiles of 4 x 4 texels, one cache line each, if it is large enough.
struct LevelShape {
  LevelShape(const TextureRecord& texture, std::uint32_t level)
      : log2_width(std::max(texture.log2_width, level) - level),
        log2_height(std::max(texture.log2_height, level) - level),
        tile(log2_width > 1 && log2_height > 1 ? 2 : 0),
        columns((1u << log2_width) - 1),
        rows((1u << log2_height) - 1) {}

  std::uint32_t index(std::uint32_t x, std::uint32_t y) const {
    const std::uint32_t inside = (1u << tile) - 1;
    return ((y >> tile) << (log2_width + tile)) + ((x >> tile) << (2 * tile)) + ((y & inside) << tile) + (x & inside);
  }

  std::uint32_t log2_width, log2_height, tile;
  std::uint32_t columns, rows;  ///< masks: number minus one
};

/// What shines at night.
void set_shine(const std::string& name, MaterialRecord& record) {
  if (name == "lamp_head") record.shine = 1.0f;
  if (name == "glass") record.shine = 0.03f;
  if (name.starts_with("curtain")) record.shine = name == "curtain_dark" ? 0.004f : 0.018f;
  if (name == "glass" || name.starts_with("curtain")) record.flags |= kIsWindow;
}

}  // namespace

ShadingMaterials::ShadingMaterials(const Palette& palette) {
  if (palette.materials().size() > kMaxMaterials) {
    throw std::invalid_argument(
        fmt::format("renderer: the palette has {} materials, more than {}", palette.materials().size(), kMaxMaterials));
  }
  std::map<const Texture*, std::uint32_t> numbers;  // materials share textures
  const auto number_of = [&](const Texture& texture) {
    const auto [found, is_new] = numbers.try_emplace(&texture, 0);
    if (is_new) found->second = add(texture);
    return found->second;
  };
  std::size_t texel_count = 0;
  for (const auto& material : palette.materials()) {
    for (const auto& texture : {material.albedo, material.overlay}) {
      if (texture && numbers.try_emplace(texture.get(), 0).second) texel_count += texture->texels().size() / 4;
    }
  }
  texels_.reserve(texel_count);
  numbers.clear();
  for (const auto& material : palette.materials()) {
    if (!material.albedo) {
      throw std::invalid_argument(fmt::format("renderer: the material {} has no albedo", material.name));
    }
    MaterialRecord record;
    const Eigen::Vector3f mean = material.albedo->mean().head<3>();
    for (int i = 0; i < 3; ++i) {
      record.tint[static_cast<std::size_t>(i)] = material.tint[i];
      record.mean[static_cast<std::size_t>(i)] = mean[i];
    }
    record.albedo = number_of(*material.albedo);
    record.periods_per_m = 1.0f / material.period_m;
    record.gloss = material.gloss;
    record.translucency = material.translucency;
    record.snow = material.snow;
    has_snow_ = has_snow_ || material.snow > 0.0f;
    record.wet = material.wet;
    has_water_ = has_water_ || material.wet > 0.0f;
    if (material.overlay) {
      record.overlay = number_of(*material.overlay);
      record.overlay_periods_per_m = 1.0f / material.overlay_period_m;
      record.flags |= kHasOverlay | (material.overlay_is_scattered ? kOverlayIsScattered : 0u);
    }
    if (material.name.ends_with("_paint") || material.name.starts_with("leaves")) record.flags |= kTakesObjectTint;
    if (material.has_holes) record.flags |= kHasHoles;
    set_shine(material.name, record);
    materials_.push_back(record);
  }
}

std::uint32_t ShadingMaterials::add(const Texture& texture) {
  TextureRecord record;
  record.log2_width = static_cast<std::uint32_t>(std::countr_zero(static_cast<unsigned>(texture.width())));
  record.log2_height = static_cast<std::uint32_t>(std::countr_zero(static_cast<unsigned>(texture.height())));
  record.last_level = std::max(record.log2_width, record.log2_height);
  if (record.last_level >= kMaxLevels) throw std::invalid_argument("renderer: a texture is wider than 32768 texels");
  auto offset = static_cast<std::uint32_t>(texels_.size());
  for (std::uint32_t level = 0; level <= record.last_level; ++level) {
    record.offsets[level] = offset;
    offset += 1u << (std::max(record.log2_width, level) - level + std::max(record.log2_height, level) - level);
  }
  const auto& bytes = texture.texels();
  const std::size_t first = texels_.size();
  if (first + bytes.size() / 4 != offset) throw std::logic_error("renderer: a texture's pyramid has a wrong size");
  static_assert(std::endian::native == std::endian::little, "red is the low byte");
  texels_.resize(offset);
  const std::uint8_t* from = bytes.data();
  for (std::uint32_t level = 0; level <= record.last_level; ++level) {
    const LevelShape shape(record, level);
    for (std::uint32_t y = 0; y <= shape.rows; ++y) {
      for (std::uint32_t x = 0; x <= shape.columns; ++x, from += 4) {
        std::memcpy(&texels_[record.offsets[level] + shape.index(x, y)], from, 4);
      }
    }
  }
  textures_.push_back(record);
  return static_cast<std::uint32_t>(textures_.size() - 1);
}

void ShadingMaterials::fill(ShadingTables& tables) const {
  tables.materials = materials_.data();
  tables.textures = textures_.data();
  tables.texels = texels_.data();
  tables.has_snow = has_snow_;
  tables.has_water = has_water_;
}

bool ShadingMaterials::is_hole(std::uint32_t material, const Eigen::Vector2f& uv, float width_m) const {
  const auto& record = materials_[material];
  const auto& texture = textures_[record.albedo];
  // the level whose texels are about as wide as the ray
  const float texels = width_m * record.periods_per_m * static_cast<float>(1u << texture.log2_width);
  const int exponent = static_cast<int>(std::bit_cast<std::uint32_t>(texels * 1.41421356f) >> 23) - 127;
  const auto level = static_cast<std::uint32_t>(std::clamp(exponent, 0, static_cast<int>(texture.last_level)));
  const LevelShape shape(texture, level);
  const float x = uv.x() * record.periods_per_m * static_cast<float>(shape.columns + 1) - 0.5f;
  const float y = uv.y() * record.periods_per_m * static_cast<float>(shape.rows + 1) - 0.5f;
  const auto floored = [](float value) {
    const int whole = static_cast<int>(value);
    return whole - static_cast<int>(value < static_cast<float>(whole));
  };
  const int column = floored(x);
  const int row = floored(y);
  const std::uint32_t* first = texels_.data() + texture.offsets[level];
  const auto alpha = [&](int i, int j) {
    const std::uint32_t texel =
        first[shape.index(static_cast<std::uint32_t>(i) & shape.columns, static_cast<std::uint32_t>(j) & shape.rows)];
    return static_cast<float>(texel >> 24);
  };
  // far away, the nearest texel suffices
  if (level > 0) return alpha(floored(x + 0.5f), floored(y + 0.5f)) < static_cast<float>(kOpaque);
  const float right = x - static_cast<float>(column);
  const float low = y - static_cast<float>(row);
  const float upper_left = alpha(column, row);
  const float lower_left = alpha(column, row + 1);
  const float upper = upper_left + right * (alpha(column + 1, row) - upper_left);
  const float lower = lower_left + right * (alpha(column + 1, row + 1) - lower_left);
  return upper + low * (lower - upper) < static_cast<float>(kOpaque);
}

const float* Environment::update(const Light& light) {
  const bool is_same = !map_.empty() && light.to_sun == light_.to_sun && light.sun == light_.sun &&
                       light.sky == light_.sky && light.ground == light_.ground &&
                       light.haze_per_m == light_.haze_per_m && light.overcast == light_.overcast;
  if (is_same) return map_.data();
  light_ = light;
  map_.resize(static_cast<std::size_t>(3 * kEnvironmentSide * kEnvironmentSide));
  cv::parallel_for_(cv::Range(0, kEnvironmentSide), [&](const cv::Range& range) {
    for (int row = range.start; row < range.end; ++row) {
      for (int column = 0; column < kEnvironmentSide; ++column) {
        const float x = 2.0f * static_cast<float>(column) / (kEnvironmentSide - 1) - 1.0f;
        const float y = 2.0f * static_cast<float>(row) / (kEnvironmentSide - 1) - 1.0f;
        Eigen::Vector3f direction(x, y, 1.0f - std::abs(x) - std::abs(y));
        Eigen::Vector3f radiance = light.ground;
        if (direction.z() >= -0.05f) radiance = sky_->radiance(direction.normalized(), light, kEnvironmentSpread);
        std::copy_n(radiance.data(), 3, &map_[static_cast<std::size_t>(3 * (row * kEnvironmentSide + column))]);
      }
    }
  });
  return map_.data();
}

}  // namespace panvo::simulated_world
