// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulated_world/terrain.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "panvo/simulated_world/random.hpp"

namespace panvo::simulated_world {
namespace {

/// Lengths and heights of the waves at hilliness 1. The sum of their steepest slopes is 0.11, but these do not
/// coincide: road grades stay at about 0.08.
struct Swell {
  double length_m, height_m;
};
constexpr std::array<Swell, 5> kSwells{{{420.0, 1.7}, {310.0, 1.3}, {240.0, 0.85}, {180.0, 0.45}, {150.0, 0.30}}};

}  // namespace

Terrain::Terrain(std::uint64_t seed, double hilliness) {
  if (hilliness == 0.0) return;
  Random random(seed, "terrain");
  // evenly spread directions, so that no seed gives parallel waves
  const double first_rad = random.uniform(0.0, std::numbers::pi);
  for (std::size_t i = 0; i < kSwells.size(); ++i) {
    const double heading_rad =
        first_rad + std::numbers::pi * 2.0 / 5.0 * static_cast<double>(i) + random.uniform(-0.2, 0.2);
    const double rad_per_m = 2.0 * std::numbers::pi / (kSwells[i].length_m * random.uniform(0.95, 1.1));
    waves_.push_back({rad_per_m * Eigen::Vector2d(std::cos(heading_rad), std::sin(heading_rad)),
                      random.uniform(0.0, 2.0 * std::numbers::pi), hilliness * kSwells[i].height_m});
  }
}

double Terrain::height_m(const Eigen::Vector2d& point) const {
  double height = 0.0;
  for (const Wave& wave : waves_) height += wave.amplitude_m * std::sin(wave.per_m.dot(point) + wave.phase_rad);
  return height;
}

Eigen::Vector3d Terrain::normal(const Eigen::Vector2d& point) const {
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  for (const Wave& wave : waves_) {
    slope += wave.amplitude_m * std::cos(wave.per_m.dot(point) + wave.phase_rad) * wave.per_m;
  }
  return Eigen::Vector3d(-slope.x(), -slope.y(), 1.0).normalized();
}

}  // namespace panvo::simulated_world
