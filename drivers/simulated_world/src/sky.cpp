// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulated_world/sky.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "shapes.hpp"
#include "textures/painters.hpp"

namespace panvo::simulated_world {
namespace {

constexpr float kMaxSun = 56.0f * kPi / 180.0f;  ///< at noon on a summer day at middle latitudes
constexpr float kSunRadius = 0.0047f;            ///< rad
constexpr float kCloudPeriods = 0.40f;           ///< of the cloud plane, per unit of its height
constexpr float kCloudCurve = 0.10f;             ///< keeps the cloud plane finite at the horizon
constexpr float kHorizonTop = 0.080f;            ///< rad, highest hill
constexpr float kHorizonBottom = -0.020f;        ///< rad

Eigen::Array3f mixed_light(const Eigen::Array3f& from, const Eigen::Array3f& to, float share) {
  return from + (to - from) * share;
}

/// Clouds on a plane: billows, dense and grey in the middle, bright and ragged at the edges.
cv::Mat paint_clouds(const Random& random) {
  constexpr int kSize = 1024;
  const cv::Mat1f shapes = fractal_noise(kSize, {5, 5}, 6, 0.5f, random.part(0));
  const cv::Mat1f groups = fractal_noise(kSize, {2, 2}, 3, 0.5f, random.part(1));
  const cv::Mat1f veil = fractal_noise(kSize, {3, 9}, 5, 0.55f, random.part(2));
  // Folded noise bulges upwards like cumulus clouds.
  const cv::Mat1f billow = fractal_noise(kSize, {11, 11}, 5, 0.5f, random.part(3));
  cv::Mat3f picture(kSize, kSize);
  cv::Mat1f density(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const float body =
          shapes(row, column) + 0.45f * groups(row, column) + 0.22f * std::abs(billow(row, column)) - 0.75f;
      const float thick = smooth_step(0.0f, 0.75f, body);
      const float wisp = 0.3f * smooth_step(0.6f, 2.4f, veil(row, column));
      density(row, column) = std::max(thick, wisp);
      const float depth = smooth_step(0.15f, 1.9f, body);
      const float lit = 1.0f - 0.55f * depth + 0.07f * billow(row, column) * thick;
      picture(row, column)[0] = lit;
    }
  }
  // Green and blue: gradient of the density along x and y (v decreases with the row), to light the side facing the sun.
  const cv::Mat1f soft = blurred(density, 2.5);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const int ahead = (column + 6) % kSize;
      const int back = (column + kSize - 6) % kSize;
      const int above = (row + kSize - 6) % kSize;
      const int below = (row + 6) % kSize;
      picture(row, column)[1] = 0.5f + 0.5f * (soft(row, ahead) - soft(row, back));
      picture(row, column)[2] = 0.5f + 0.5f * (soft(above, column) - soft(below, column));
    }
  }
  return encoded_picture(picture, density);
}

/// Wooded hills and, in front of them, the crowns of a row of trees; alpha: where they cover the sky.
cv::Mat paint_horizon(const Random& random) {
  constexpr int kWidth = 2048;
  constexpr int kHeight = 64;
  const cv::Mat1f noise = fractal_noise(kWidth, {7, 7}, 6, 0.5f, random.part(0));
  const cv::Mat1f crowns = fractal_noise(kWidth, {150, 150}, 4, 0.7f, random.part(1));
  const cv::Mat1f groves = fractal_noise(kWidth, {12, 12}, 4, 0.6f, random.part(2));
  cv::Mat3f picture(kHeight, kWidth);
  cv::Mat1f alpha(kHeight, kWidth);
  const float per_row = (kHorizonTop - kHorizonBottom) / kHeight;
  for (int column = 0; column < kWidth; ++column) {
    const float far = 0.028f + 0.014f * noise(100, column);
    const float near = 0.016f + 0.006f * noise(900, column) + 0.0022f * crowns(3, column);
    const float trees = 0.011f + 0.007f * groves(500, column) + 0.0045f * crowns(700, column);
    for (int row = 0; row < kHeight; ++row) {
      const float elevation = kHorizonTop - (static_cast<float>(row) + 0.5f) * per_row;
      const auto below = [&](float top) { return smooth_step(-0.6f * per_row, 0.6f * per_row, top - elevation); };
      const float leafy = 1.0f + 0.25f * crowns(row * 6, column);
      const Colour of_far(0.30f, 0.36f, 0.44f);
      const Colour of_near = Colour(0.13f, 0.17f, 0.155f) * (1.0f + 0.14f * crowns(row * 5 + 400, column));
      const Colour of_trees = Colour(0.045f, 0.07f, 0.03f) * leafy;
      Colour colour = of_far;
      colour += (of_near - colour) * below(near);
      colour += (of_trees - colour) * below(trees);
      picture(row, column) = colour;
      alpha(row, column) = std::max({below(far), below(near), below(trees)});
    }
  }
  return encoded_picture(picture, alpha);
}

}  // namespace

Light light_at(double hour, double cloud_cover) {
  const float cover = std::clamp(static_cast<float>(cloud_cover), 0.0f, 1.0f);
  const float day = kPi * std::clamp((static_cast<float>(hour) - 6.0f) / 12.0f, 0.0f, 1.0f);
  Light light;
  light.to_sun = {std::cos(day), -std::sin(day) * std::cos(kMaxSun), std::sin(day) * std::sin(kMaxSun)};
  const float up = std::max(light.to_sun.z(), 0.0f);

  // Air mass by Kasten and Young 1989; optical depths of a clear summer sky, with blue scattered most.
  const float elevation_deg = std::asin(std::min(up, 1.0f)) * 180.0f / kPi;
  const float air = 1.0f / (up + 0.50572f * std::pow(elevation_deg + 6.07995f, -1.6364f));
  const Eigen::Array3f depth(0.12f, 0.17f, 0.27f);
  const Eigen::Array3f clear_sun = 0.98f * (-depth * air).exp();
  const Eigen::Array3f scattered = (0.98f - clear_sun) * std::sqrt(up + 0.02f);
  const Eigen::Array3f clear_sky = 0.04f * std::sqrt(up + 0.01f) + scattered * Eigen::Array3f(1.12f, 1.14f, 1.17f);
  // A cloud scatters half of the light in all directions.
  const float all = (clear_sun * up + clear_sky).mean();
  const Eigen::Array3f clouded = 0.5f * all * Eigen::Array3f(0.97f, 1.0f, 1.05f);
  light.sun = (clear_sun * (1.0f - 0.97f * cover)).matrix();
  light.sky = mixed_light(clear_sky, clouded, cover).matrix();
  const Eigen::Array3f earth(0.15f, 0.14f, 0.115f);
  light.ground = (earth * (light.sun.array() * up + light.sky.array())).matrix();
  return light;
}

Light overcast_light_at(double hour) {
  Light light = light_at(hour, 1.0);
  light.sky += light.sun * std::max(light.to_sun.z(), 0.0f);  // what passes the clouds comes from all sides
  light.sun.setZero();
  light.overcast = true;
  return light;
}

Light night_light(bool overcast, std::uint32_t evening) {
  Light light;
  light.to_sun = Eigen::Vector3f::UnitZ();
  light.sun.setZero();
  light.sky = Eigen::Vector3f(0.0016f, 0.0015f, 0.0017f) * (overcast ? 2.0f : 1.0f);
  light.ground = 0.15f * light.sky;
  light.overcast = overcast;
  light.lamps = true;
  light.evening = evening;
  return light;
}

Light hall_light() {
  Light light = night_light(false, 0);
  light.sky = Eigen::Vector3f(0.065f, 0.063f, 0.058f);
  light.ground = 0.6f * light.sky;
  light.haze_per_m = 0.0f;
  return light;
}

namespace {

/// Radiance of an overcast sky at height `up`: three times as bright overhead as at the horizon, after Moon and Spencer
/// 1942, with the mean that `sky` states.
Eigen::Vector3f overcast_radiance(float up, const Light& light) {
  return light.sky * (3.0f / 7.0f * (1.0f + 2.0f * std::clamp(up, 0.0f, 1.0f)));
}

}  // namespace

Eigen::Vector3f haze(const Light& light) {
  if (light.overcast) return overcast_radiance(0.0f, light);
  // Because of the long path through air, whiter and brighter than the sky overhead.
  const float grey = light.sky.mean();
  return (mixed_light(light.sky.array(), Eigen::Array3f::Constant(grey), 0.45f) * 1.9f + 0.16f * light.sun.array())
      .matrix();
}

namespace {

/// Forward scattering around the sun, wide.
float wide_glow(float cosine) {
  const float forward = std::max(cosine, 0.0f);
  const float squared = forward * forward;
  return squared * squared;
}

/// The cloudless sky at height `up` (the sine of the elevation); `cosine` of the angle from the sun.
Eigen::Array3f clear_sky(float up, float cosine, const Light& light) {
  // Whitish at the horizon, deeper and bluer overhead.
  const float lower = 1.0f - std::min(up, 1.0f);
  const Eigen::Array3f zenith = light.sky.array() * Eigen::Array3f(0.66f, 0.80f, 0.98f);
  const float fall = lower * lower * lower;
  Eigen::Array3f colour = mixed_light(zenith, haze(light).array(), fall * (0.35f + 0.65f * lower * lower));
  colour += light.sun.array() * (0.05f * wide_glow(cosine) + 0.16f * std::exp(-(1.0f - cosine) * 60.0f) +
                                 0.9f * std::exp(-(1.0f - cosine) * 1200.0f));
  return colour;
}

/// The texel of the clouds, which are seen edge-on towards the horizon.
Eigen::Vector4f cloud_at(const Texture& clouds, const Eigen::Vector3f& direction, float spread_rad) {
  const float height = std::min(direction.z(), 1.0f);
  const float scale = kCloudPeriods / (height + kCloudCurve);
  const Eigen::Vector2f uv = direction.head<2>() * scale;
  const float across = spread_rad * scale;
  const float along = across / (height + kCloudCurve);
  const Eigen::Vector2f outwards = direction.head<2>().normalized();
  const Eigen::Vector2f sideways(-outwards.y(), outwards.x());
  return clouds.sample(uv, outwards * along, sideways * across, 1);
}

/// The sky with a cloud in front; towards the horizon it fades into the haze.
Eigen::Array3f with_cloud(const Eigen::Array3f& clear, const Eigen::Vector4f& cloud, float up, float cosine,
                          const Light& light) {
  const Eigen::Array3f sky = light.sky.array();
  const float wide = wide_glow(cosine);
  // The side facing the sun is lit, the other is in the cloud's own shadow.
  const float sunward = (cloud.y() - 0.5f) * light.to_sun.x() + (cloud.z() - 0.5f) * light.to_sun.y();
  const float lit = std::clamp(cloud.x() - 0.9f * sunward, 0.2f, 1.2f);
  const Eigen::Array3f white = light.sun.array() * (0.95f + 0.4f * wide * wide) + sky;
  const Eigen::Array3f shaded = sky * 1.3f + 0.16f * light.sun.array();
  const Eigen::Array3f of_cloud = mixed_light(shaded, white, std::clamp(1.4f * lit - 0.4f, 0.0f, 1.0f));
  return mixed_light(clear, of_cloud, cloud.w() * std::min(1.0f, 6.0f * std::min(up, 1.0f)));
}

/// The sun's disc, spread over the pixel; hidden by clouds.
Eigen::Array3f sun_disc(float cosine, float spread_rad, float cloud_density, const Light& light) {
  const float spread = std::max(spread_rad, kSunRadius);
  const float from_sun = std::sqrt(std::max(2.0f * (1.0f - cosine), 0.0f));
  if (!(from_sun < 2.0f * spread + kSunRadius)) return Eigen::Array3f::Zero();
  const float inside = 1.0f - std::clamp((from_sun - kSunRadius) / (0.7f * spread) + 0.5f, 0.0f, 1.0f);
  return light.sun.array() * (400.0f * (kSunRadius / spread) * (kSunRadius / spread) * inside * (1.0f - cloud_density));
}

}  // namespace

Sky::Sky(std::uint64_t seed)
    : clouds_(std::make_shared<const Texture>(paint_clouds(Random(seed, "clouds")))),
      horizon_(std::make_shared<const Texture>(paint_horizon(Random(seed, "horizon")))) {}

Eigen::Vector3f Sky::radiance(const Eigen::Vector3f& direction, const Light& light, float spread_rad) const {
  const float up = direction.z();
  const Eigen::Array3f far = haze(light).array();
  Eigen::Array3f colour;
  if (up > 0.0f && light.overcast) {
    colour = overcast_radiance(up, light).array();
  } else if (up > 0.0f) {
    const float cosine = direction.dot(light.to_sun);
    const Eigen::Vector4f cloud = cloud_at(*clouds_, direction, spread_rad);
    colour = with_cloud(clear_sky(up, cosine, light), cloud, up, cosine, light);
    colour += sun_disc(cosine, spread_rad, cloud.w(), light);
  } else {
    // Below the horizon, if no object is there: land that fades into the haze.
    const float depth = std::min(-up * 12.0f, 1.0f);
    colour = mixed_light(far, light.ground.array() * 0.9f, depth);
  }
  if (up > kHorizonBottom && up < kHorizonTop) {
    const float azimuth = std::atan2(direction.y(), direction.x()) * (0.5f / kPi);
    constexpr float kRange = kHorizonTop - kHorizonBottom;
    const Eigen::Vector2f uv(azimuth, (up - kHorizonBottom) / kRange);
    const Eigen::Vector4f land = horizon_->sample(uv, {spread_rad * 0.5f / kPi, 0.0f}, {0.0f, spread_rad / kRange}, 2);
    // Farther hills are painted pale already; the air in front contributes about a fifth.
    const Eigen::Array3f lit = land.head<3>().array() * (light.sun.array() * 0.5f + light.sky.array());
    const float inside = std::min(1.0f, (kHorizonTop - up) / (0.05f * kRange));
    const float lower = up < 0.0f ? 1.0f + up / kHorizonBottom * -1.0f : 1.0f;
    colour = mixed_light(colour, mixed_light(lit, far, 0.22f), land.w() * inside * std::clamp(lower, 0.0f, 1.0f));
  }
  const float day = std::max(light.sun.maxCoeff(), 1e-3f);
  return (colour * std::min(1.0f, day * 1e3f)).matrix();
}

}  // namespace panvo::simulated_world
