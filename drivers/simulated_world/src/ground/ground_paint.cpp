// SPDX-License-Identifier: Apache-2.0
#include "ground_paint.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace panvo::simulated_world {
namespace {

// Wear across a lane, from the road's centre to the kerb; 1 in the wheel tracks.
struct Knot {
  double kerb_m, wear;
};
constexpr std::array<Knot, 7> kAcrossLane{
    {{-5.0, -0.2}, {-3.0, -0.7}, {-2.3, 1.0}, {-1.6, -0.5}, {-0.9, 1.0}, {-0.3, -0.3}, {0.1, -0.3}}};

double wear_at(double kerb_m) {
  if (kerb_m <= kAcrossLane.front().kerb_m) return kAcrossLane.front().wear;
  for (std::size_t i = 1; i < kAcrossLane.size(); ++i) {
    const Knot &a = kAcrossLane[i - 1], &b = kAcrossLane[i];
    if (kerb_m < b.kerb_m) return a.wear + (b.wear - a.wear) * (kerb_m - a.kerb_m) / (b.kerb_m - a.kerb_m);
  }
  return kAcrossLane.back().wear;
}

Eigen::Vector3f mean_colour(const Material& material) {
  return material.albedo->mean().head<3>().cwiseProduct(material.tint);
}

}  // namespace

GroundPaint::GroundPaint(const Site& site)
    : site_(site),
      fine_(site.parameters.seed, "ground fine", 3.1),
      medium_(site.parameters.seed, "ground medium", 13.0),
      coarse_(site.parameters.seed, "ground coarse", 55.0),
      dirt_(site.parameters.seed, "ground dirt", 1.7),
      field_(site.parameters.seed, "ground fields", 110.0),
      field_share_(site.parameters.seed, "ground field colours", 70.0) {
  const auto& materials = site.palette->materials();
  const Eigen::Vector3f grass = mean_colour(materials[site.palette->find("grass")]);
  const Eigen::Vector3f far = mean_colour(materials[site.palette->find("far_land")]);
  far_from_grass_ = grass.cwiseQuotient(far.cwiseMax(1e-3f));
}

double GroundPaint::unevenness(const Eigen::Vector2d& point) const {
  return 0.09 * fine_.at(point) + 0.09 * medium_.at(point) + 0.07 * coarse_.at(point);
}

Tint GroundPaint::tint(const Eigen::Vector2d& point, const Eigen::Vector3f& colour, double contrast) const {
  const auto byte = [](double share) {
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
  };
  return {byte(colour.x()), byte(colour.y()), byte(colour.z()), byte(contrast * (1.0 - 0.9 * site_.weakness(point)))};
}

Tint GroundPaint::carriageway(const Eigen::Vector2d& point, double kerb_m, double into_street_m,
                              const Zone& zone) const {
  const double strength = 1.0 - site_.weakness(point);
  const double lanes = std::clamp(into_street_m / 8.0, 0.0, 1.0) * zone.wear;
  const double tracks = lanes * wear_at(kerb_m) * (0.11 + 0.05 * medium_.at(point));
  // dirt collects at the kerb, with local variation
  const double gutter =
      std::clamp(1.0 + kerb_m / 0.7, 0.0, 1.0) * (0.2 + 0.12 * fine_.at(point) + 0.12 * dirt_.at(point));
  const double brightness = 0.93 + strength * (unevenness(point) + tracks - gutter);
  const auto b = static_cast<float>(brightness);
  const auto g = static_cast<float>(strength * gutter);
  return tint(point, zone.asphalt_tint.cwiseProduct(Eigen::Vector3f(b * (1.0f + 0.12f * g), b, b * (1.0f - 0.3f * g))));
}

Tint GroundPaint::beside(const Eigen::Vector2d& point, double kerb_m, const Eigen::Vector3f& colour) const {
  const double strength = 1.0 - site_.weakness(point);
  const double moss = std::clamp((kerb_m - 1.2) / 1.2, 0.0, 1.0) * std::max(0.0, dirt_.at(point) + medium_.at(point));
  const auto b = static_cast<float>(0.9 + strength * (unevenness(point) - 0.12 * moss));
  const auto m = static_cast<float>(0.10 * strength * moss);
  return tint(point, colour.cwiseProduct(Eigen::Vector3f(b * (1.0f - m), b, b * (1.0f - 2.0f * m))));
}

Tint GroundPaint::grass(const Eigen::Vector2d& point, double kerb_m) const {
  // lush and dry patches; worn near the pavement
  const double dry = std::clamp(0.35 + 0.5 * medium_.at(point) + 0.5 * coarse_.at(point), 0.0, 1.0);
  const double trodden = std::clamp(1.0 - (kerb_m - 1.5) / 1.6, 0.0, 1.0) * std::clamp(0.3 + dirt_.at(point), 0.0, 1.0);
  const auto b = static_cast<float>(0.82 + 0.14 * fine_.at(point) + 0.04 * dry);
  const auto d = static_cast<float>(std::max(dry, trodden));
  return tint(point, {b * (0.86f + 0.22f * d), b * (1.0f - 0.03f * d), b * (0.92f - 0.12f * d)});
}

Tint GroundPaint::field(const Eigen::Vector2d& point, double kerb_m) const {
  const Tint near = grass(point, kerb_m);
  const Eigen::Vector3f as_grass =
      far_from_grass_.cwiseProduct(Eigen::Vector3f(near.red, near.green, near.blue)) / 255.0f;
  // crops with steep transitions, but smooth enough for a coarse grid
  const double crop = field_.at(point) + 0.25 * medium_.at(point);
  const Eigen::Vector3f other = crop > 0.25   ? Eigen::Vector3f(1.0f, 0.9f, 0.62f)
                                : crop < -0.3 ? Eigen::Vector3f(0.62f, 0.72f, 0.55f)
                                              : Eigen::Vector3f(0.82f, 0.92f, 0.72f);
  const auto far = static_cast<float>(std::clamp((kerb_m - kFieldsBegin_m) / 70.0, 0.0, 1.0));
  const auto b = static_cast<float>(1.0 + 0.12 * field_share_.at(point));
  return tint(point, (1.0f - far) * as_grass + far * b * other);
}

Tint GroundPaint::laid(const Eigen::Vector2d& point, const Eigen::Vector3f& colour, double contrast) const {
  const auto b = static_cast<float>(0.95 + (1.0 - site_.weakness(point)) * unevenness(point));
  return tint(point, b * colour, contrast);
}

}  // namespace panvo::simulated_world
