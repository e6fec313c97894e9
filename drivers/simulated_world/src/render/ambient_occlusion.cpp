// SPDX-License-Identifier: Apache-2.0
#include "ambient_occlusion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <opencv2/core/utility.hpp>
#include <span>

#include "panvo/simulated_world/scene.hpp"
#include "traced_scene.hpp"

namespace panvo::simulated_world {
namespace {

constexpr int kMaxPackets = 2;                    // of sixteen rays, per place
constexpr std::size_t kManyPlaces = 4'000;        // larger meshes get half the rays
constexpr int kChunk = 128;                       // places that a thread takes at a time
constexpr float kCell = 0.15f;                    // m: vertices nearer than this share their light
constexpr float kLift = 0.02f, kInwards = 0.05f;  // m: ray origin off the surface, and away from corners
constexpr float kFromWalls = 0.12f;               // minimum light: occluders reflect light, too

/// Vertices with nearly equal position and normal.
struct Place {
  Eigen::Vector3f position = Eigen::Vector3f::Zero(), normal = Eigen::Vector3f::UnitZ();
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();  // of its triangles, summed
  int triangles = 0;
};

/// Cosine-weighted directions around +z: equal areas of the disc (golden-angle spiral).
std::vector<Eigen::Vector3f> hemisphere(int packets) {
  std::vector<Eigen::Vector3f> directions;
  for (int i = 0; i < 16 * packets; ++i) {
    const double square = (i + 0.5) / (16.0 * packets);
    const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double radius = std::sqrt(square);
    directions.emplace_back(
        Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1.0 - square)).cast<float>());
  }
  return directions;
}

/// Merges the vertices of a mesh into places; returns the index of each vertex's place.
std::vector<std::uint32_t> join(const Mesh& mesh, std::vector<Place>& places) {
  const auto key = [&](std::uint32_t i) {
    const auto& vertex = mesh.vertices[i];
    std::uint64_t bits = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto cell = static_cast<std::int64_t>(std::floor(vertex.position[axis] / kCell));
      const auto facing = static_cast<std::int64_t>(std::lround(3.0f * vertex.normal[axis])) + 3;
      bits = bits << 21 | static_cast<std::uint64_t>((cell << 3 | facing) & 0x1fffff);
    }
    return bits;
  };
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order(mesh.vertices.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = {key(i), i};
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> place_of(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || order[i].first != order[i - 1].first) {
      const auto& vertex = mesh.vertices[order[i].second];
      places.push_back({vertex.position, vertex.normal});
    }
    place_of[order[i].second] = static_cast<std::uint32_t>(places.size() - 1);
  }
  for (const auto& triangle : mesh.triangles) {
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();
    for (const auto corner : triangle.corners) middle += mesh.vertices[corner].position / 3.0f;
    for (const auto corner : triangle.corners) {
      auto& place = places[place_of[corner]];
      place.middle += middle;
      ++place.triangles;
    }
  }
  return place_of;
}

float open_share(RTCScene scene, const Place& place, const std::vector<Eigen::Vector3f>& directions, float reach_m) {
  const Eigen::Vector3f& normal = place.normal;
  const Eigen::Vector3f across = normal.unitOrthogonal();
  const Eigen::Vector3f along = normal.cross(across);
  Eigen::Vector3f origin = place.position + kLift * normal;
  if (place.triangles > 0) {
    const Eigen::Vector3f inwards = place.middle / static_cast<float>(place.triangles) - place.position;
    const float length = inwards.norm();
    if (length > 1e-6f) origin += std::min(kInwards, 0.5f * length) / length * inwards;
  }
  TraceContext context;
  init_context(context.embree);
  float open = 0.0f;
  std::size_t from_behind = 0;
  for (std::size_t first = 0; first < directions.size(); first += 16) {
    alignas(64) RTCRayHit16 rays;
    alignas(64) std::array<std::int32_t, 16> valid;
    valid.fill(-1);
    for (std::size_t i = 0; i < 16; ++i) {
      const auto& local = directions[first + i];
      const Eigen::Vector3f direction = local.x() * across + local.y() * along + local.z() * normal;
      rays.ray.org_x[i] = origin.x();
      rays.ray.org_y[i] = origin.y();
      rays.ray.org_z[i] = origin.z();
      rays.ray.dir_x[i] = direction.x();
      rays.ray.dir_y[i] = direction.y();
      rays.ray.dir_z[i] = direction.z();
      rays.ray.tnear[i] = 0.0f;
      rays.ray.tfar[i] = reach_m;
      rays.ray.time[i] = 0.0f;
      rays.ray.mask[i] = kToShadow;
      rays.ray.flags[i] = 0;
      rays.ray.id[i] = static_cast<unsigned>(i);
      rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    intersect_16(valid.data(), scene, context.embree, rays, Rays::kAnyDirection);
    for (std::size_t i = 0; i < 16; ++i) {
      if (rays.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) {
        open += 1.0f;
        continue;
      }
      open += rays.ray.tfar[i] / reach_m;
      const bool is_solid = (rays.hit.geomID[i] & 1u) == 0 && rays.hit.instID[0][i] == RTC_INVALID_GEOMETRY_ID;
      const float facing = rays.hit.Ng_x[i] * rays.ray.dir_x[i] + rays.hit.Ng_y[i] * rays.ray.dir_y[i] +
                           rays.hit.Ng_z[i] * rays.ray.dir_z[i];
      if (is_solid && facing > 0.0f) ++from_behind;
    }
  }
  if (2 * from_behind > directions.size()) return 0.5f;
  return open / static_cast<float>(directions.size());
}

}  // namespace

std::vector<std::uint8_t> ambient_light(RTCScene scene, const Mesh& mesh, float reach_m) {
  std::vector<Place> places;
  const auto place_of = join(mesh, places);
  const auto directions = hemisphere(places.size() > kManyPlaces ? kMaxPackets / 2 : kMaxPackets);
  std::vector<std::uint8_t> shares(places.size());
  const int chunks = (static_cast<int>(places.size()) + kChunk - 1) / kChunk;
  cv::parallel_for_(cv::Range(0, chunks), [&](const cv::Range& range) {
    const auto end = std::min(places.size(), static_cast<std::size_t>(range.end) * kChunk);
    for (auto i = static_cast<std::size_t>(range.start) * kChunk; i < end; ++i) {
      const float share = kFromWalls + (1.0f - kFromWalls) * open_share(scene, places[i], directions, reach_m);
      shares[i] = static_cast<std::uint8_t>(std::lround(255.0f * share));
    }
  });
  std::vector<std::uint8_t> light(place_of.size());
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = shares[place_of[i]];
  return light;
}

}  // namespace panvo::simulated_world
