// SPDX-License-Identifier: Apache-2.0
#include "packet_tracer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace panvo::simulated_world {
namespace {

// Where Embree has no packets of 16 (without AVX-512), it ignores the mask of valid lanes. Rays that end before they begin are always left out.
constexpr float kNotTraced = -std::numeric_limits<float>::infinity();
constexpr float kEvenSky = 0.015f;   // relative brightness difference: smaller ones are not visible
constexpr float kSunSpread = 0.01f;  // rad: the sun's disc, so that gaps between distant leaves have soft edges

TraceContext trace_context(float spread) {
  TraceContext context;
  init_context(context.embree);
  context.spread = spread;
  return context;
}

float turned_ray(const ShutterPose& pose, std::size_t axis, const Eigen::Vector3f& vector) {
  const float* row = &pose.world_from_camera[3 * axis];
  return row[0] * vector.x() + row[1] * vector.y() + row[2] * vector.z();
}

void set_lanes(std::uint32_t lanes, std::int32_t* valid) {
  for (int i = 0; i < kPacket; ++i) valid[i] = (lanes >> i & 1u) != 0 ? -1 : 0;
}

/// The lanes that hit something.
std::uint32_t hits_of(const TracedPacket& packet) {
  std::uint32_t hit = 0;
  for (unsigned i = 0; i < kPacket; ++i) {
    if (packet.rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) hit |= 1u << i;
  }
  return hit;
}

}  // namespace

PacketTracer::PacketTracer(const TracedScene& scene, const Sky& sky, const Light& light, const ShadingTables& tables,
                           std::uint32_t visibility, std::vector<ShutterPose> moments)
    : scene_(scene),
      sky_(sky),
      light_(light),
      tables_(tables),
      visibility_(visibility),
      moments_(std::move(moments)),
      shade_(max_shade_packet()) {}

void PacketTracer::intersect(const SampleRays& samples, TracedPacket& packet) const {
  auto& rays = packet.rays.ray;
  for (std::size_t i = 0; i < kPacket; ++i) {
    const auto& pose = moments_[static_cast<std::size_t>(samples.moments[i])];
    const auto& m = pose.world_from_camera;
    const auto& direction = samples.directions[i];
    rays.org_x[i] = pose.origin[0];
    rays.org_y[i] = pose.origin[1];
    rays.org_z[i] = pose.origin[2];
    rays.dir_x[i] = m[0] * direction.x() + m[1] * direction.y() + m[2] * direction.z();
    rays.dir_y[i] = m[3] * direction.x() + m[4] * direction.y() + m[5] * direction.z();
    rays.dir_z[i] = m[6] * direction.x() + m[7] * direction.y() + m[8] * direction.z();
    rays.time[i] = pose.time;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool is_known = samples.is_block && i > 0;
      packet.across[axis][i] = is_known ? packet.across[axis][0] : turned_ray(pose, axis, samples.across[i]);
      packet.down[axis][i] = is_known ? packet.down[axis][0] : turned_ray(pose, axis, samples.down[i]);
    }
  }
  packet.motion_share = samples.share;
  const auto first_lane = static_cast<std::size_t>(std::countr_zero(samples.lanes));
  cast(packet, samples.lanes, samples.across[first_lane].norm());
}

void PacketTracer::cast(TracedPacket& packet, std::uint32_t lanes, float spread) const {
  auto& rays = packet.rays.ray;
  auto& hits = packet.rays.hit;
  for (std::size_t i = 0; i < kPacket; ++i) {
    rays.tnear[i] = 0.0f;
    rays.tfar[i] = (lanes >> i & 1u) != 0 ? std::numeric_limits<float>::infinity() : kNotTraced;
    rays.mask[i] = visibility_;
    rays.flags[i] = 0;
    rays.id[i] = static_cast<unsigned>(i);
    hits.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    hits.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    hits.primID[i] = 0;
    packet.is_moving[i] = 0;
  }
  alignas(64) std::int32_t valid[kPacket];
  set_lanes(lanes, valid);
  auto context = trace_context(spread);
  intersect_16(valid, scene_.standing(), context.embree, packet.rays, Rays::kCoherent);
  if (scene_.moving() == nullptr) return;
  alignas(64) float before[kPacket];
  std::copy_n(rays.tfar, kPacket, before);
  intersect_16(valid, scene_.moving(), context.embree, packet.rays, Rays::kCoherent);
  for (int i = 0; i < kPacket; ++i) packet.is_moving[i] = rays.tfar[i] < before[i] ? -1 : 0;
}

void PacketTracer::meet(const SampleRays& samples, TracedPacket& packet, Renderer::Statistics& statistics) const {
  intersect(samples, packet);
  statistics.primary_rays += static_cast<std::uint64_t>(std::popcount(samples.lanes));
}

std::uint32_t PacketTracer::light_up(const SampleRays& samples, const TracedPacket& packet, ShadedPacket& shaded,
                                     Renderer::Statistics& statistics) const {
  shade_(tables_, packet, shaded);
  alignas(64) std::int32_t valid[kPacket];
  set_lanes(samples.lanes, valid);
  std::uint32_t in_light = 0, shadow_lanes = 0;
  for (unsigned i = 0; i < kPacket; ++i) {
    if (((samples.in_sun | samples.in_shadow) >> i & 1u) != 0) valid[i] = 0;
    if ((samples.in_shadow >> i & 1u) != 0) shaded.wants_shadow[i] = 0;
    valid[i] &= shaded.wants_shadow[i];
    if (shaded.wants_shadow[i] != 0) in_light |= 1u << i;
    if (valid[i] != 0) shadow_lanes |= 1u << i;
  }
  if (shadow_lanes == 0) return in_light;
  for (unsigned i = 0; i < kPacket; ++i)
    if (valid[i] == 0) shaded.shadow.tfar[i] = kNotTraced;
  statistics.shadow_rays += static_cast<std::uint64_t>(std::popcount(shadow_lanes));
  auto context = trace_context(kSunSpread);
  for (unsigned i = 0; i < kPacket; ++i) shaded.shadow.id[i] = i;
  occluded_16(valid, scene_.standing(), context.embree, shaded.shadow, Rays::kCoherent);
  if (scene_.moving() != nullptr) {
    for (int i = 0; i < kPacket; ++i) valid[i] &= shaded.shadow.tfar[i] >= 0.0f ? -1 : 0;
    occluded_16(valid, scene_.moving(), context.embree, shaded.shadow, Rays::kCoherent);
  }
  for (unsigned i = 0; i < kPacket; ++i) {
    if ((shadow_lanes >> i & 1u) != 0 && shaded.shadow.tfar[i] < 0.0f) in_light &= ~(1u << i);
  }
  return in_light;
}

void PacketTracer::shade(const SampleRays& samples, const TracedPacket& packet, SampleResults& results,
                         Renderer::Statistics& statistics) const {
  const auto& rays = packet.rays.ray;
  const std::uint32_t hit = hits_of(packet) & samples.lanes;
  ShadedPacket shaded;
  const std::uint32_t in_light = hit != 0 ? light_up(samples, packet, shaded, statistics) : 0;
  if (hit != samples.lanes) see_sky(samples, rays, hit, results);
  for (unsigned i = 0; i < kPacket; ++i) {
    if ((samples.lanes >> i & 1u) == 0) continue;
    auto& radiance = results.radiance[i];
    if ((hit >> i & 1u) == 0) {
      results.distance[i] = std::numeric_limits<float>::infinity();
      results.key[i] = 0;
      results.normal[i] = 0;
      continue;
    }
    const bool is_sunny = (in_light >> i & 1u) != 0;
    const float sun = is_sunny ? 1.0f : 0.0f;
    for (std::size_t c = 0; c < 3; ++c) radiance[c] = shaded.base[c][i] + sun * shaded.sun[c][i];
    results.distance[i] = rays.tfar[i];
    results.key[i] = shaded.key[i];
    results.normal[i] = (shaded.normal[i] & 0x7fffffffu) | (is_sunny ? 0x80000000u : 0u);
  }
  if (tables_.has_water && hit != 0) add_reflections(samples, hit, shaded, results, statistics);
}

void PacketTracer::add_reflections(const SampleRays& samples, std::uint32_t hit, ShadedPacket& shaded,
                                   SampleResults& results, Renderer::Statistics& statistics) const {
  SampleRays mirrored = samples;
  mirrored.lanes = mirrored.in_sun = mirrored.in_shadow = 0;
  for (unsigned i = 0; i < kPacket; ++i) {
    if ((hit >> i & 1u) != 0 && shaded.of_puddle[i] + shaded.of_film[i] > 0.0f) mirrored.lanes |= 1u << i;
  }
  if (mirrored.lanes == 0) return;
  auto& packet = shaded.mirrored;
  const auto first_lane = static_cast<std::size_t>(std::countr_zero(mirrored.lanes));
  packet.motion_share = samples.share;
  cast(packet, mirrored.lanes, samples.across[first_lane].norm());
  statistics.primary_rays += static_cast<std::uint64_t>(std::popcount(mirrored.lanes));

  const std::uint32_t seen = hits_of(packet) & mirrored.lanes;
  for (std::size_t i = 0; i < kPacket; ++i) {
    if ((seen >> i & 1u) == 0) continue;
    const float further = 1.0f + results.distance[i] / packet.rays.ray.tfar[i];  // the ray has widened before
    for (std::size_t axis = 0; axis < 3; ++axis) {
      packet.across[axis][i] *= further;
      packet.down[axis][i] *= further;
    }
  }
  ShadedPacket reflected;
  const std::uint32_t in_light = seen != 0 ? light_up(mirrored, packet, reflected, statistics) : 0;
  SampleResults sky;
  if (seen != mirrored.lanes) see_sky(mirrored, packet.rays.ray, seen, sky);
  for (unsigned i = 0; i < kPacket; ++i) {
    if ((mirrored.lanes >> i & 1u) == 0) continue;
    const bool is_hit = (seen >> i & 1u) != 0;
    const float sun = (in_light >> i & 1u) != 0 ? 1.0f : 0.0f;
    for (std::size_t c = 0; c < 3; ++c) {
      const float radiance = is_hit ? reflected.base[c][i] + sun * reflected.sun[c][i] : sky.radiance[i][c];
      results.radiance[i][c] +=
          shaded.of_puddle[i] * radiance + shaded.of_film[i] * std::min(radiance, tables_.film_limit);
    }
  }
}

void PacketTracer::see_sky(const SampleRays& samples, const RTCRay16& rays, std::uint32_t hit,
                           SampleResults& results) const {
  const auto see = [&](std::size_t i) {
    const float spread = samples.across[i].norm();
    const Eigen::Vector3f direction(rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]);
    Eigen::Map<Eigen::Vector3f>(results.radiance[i].data()) = sky_.radiance(direction, light_, spread);
  };
  const std::uint32_t missed = samples.lanes & ~hit;
  if (samples.is_block && missed == 0xffffu) {
    // if the centre of a block matches the interpolation of its corners, so does the rest
    constexpr std::array<std::size_t, 4> kCorners{0, 3, 12, 15};
    for (const auto corner : kCorners) see(corner);
    const auto brightness = [&](std::size_t i) { return results.radiance[i][0] + results.radiance[i][2]; };
    const auto lies_between = [&](std::size_t lane, std::size_t near, std::size_t far) {  // at a third of the distance
      see(lane);
      const float expected =
          (4.0f * brightness(near) + 2.0f * (brightness(3) + brightness(12)) + brightness(far)) / 9.0f;
      return std::abs(brightness(lane) - expected) < kEvenSky * expected;
    };
    const bool is_even = lies_between(5, 0, 15) && lies_between(10, 15, 0);
    if (is_even) {
      for (std::size_t i = 0; i < kPacket; ++i) {
        const float across = static_cast<float>(i % 4) / 3.0f;
        const float down = static_cast<float>(i / 4) / 3.0f;
        for (std::size_t c = 0; c < 3; ++c) {
          const auto at = [&](std::size_t corner) { return results.radiance[corner][c]; };
          const float upper = at(0) + across * (at(3) - at(0));
          const float lower = at(12) + across * (at(15) - at(12));
          if (i != 0 && i != 3 && i != 12 && i != 15) results.radiance[i][c] = upper + down * (lower - upper);
        }
      }
      return;
    }
  }
  for (std::size_t i = 0; i < kPacket; ++i) {
    if ((missed >> i & 1u) != 0) see(i);
  }
}

SeenSurface PacketTracer::surface(const TracedPacket& packet, std::size_t lane) const {
  const auto& hits = packet.rays.hit;
  const auto& rays = packet.rays.ray;
  const std::uint32_t geometry = hits.geomID[lane];
  if (geometry == RTC_INVALID_GEOMETRY_ID) return {};
  const std::uint32_t instance = hits.instID[0][lane];
  const bool is_instance = instance != RTC_INVALID_GEOMETRY_ID;
  const std::uint32_t number =
      (is_instance ? instance : geometry >> 1) + (packet.is_moving[lane] != 0 ? tables_.first_moving_object : 0);
  const auto& object = tables_.objects[number];
  const auto& record = tables_.surfaces[object.first_surface[geometry & 1u] + hits.primID[lane]];
  Eigen::Vector3f normal(hits.Ng_x[lane], hits.Ng_y[lane], hits.Ng_z[lane]);
  if (is_instance) normal = Eigen::Map<const Eigen::Matrix3f>(object.world_from_model.data()) * normal;
  const float facing = normal.x() * rays.dir_x[lane] + normal.y() * rays.dir_y[lane] + normal.z() * rays.dir_z[lane];
  return {(number << 8 | (record.material_light & 0xffu)) + 1u, (facing > 0.0f ? -1.0f : 1.0f) / normal.norm() * normal,
          1.0f / rays.tfar[lane]};
}

void PacketTracer::trace_range(const SampleRays& samples, float* distances) const {
  TracedPacket packet;
  intersect(samples, packet);
  std::copy_n(packet.rays.ray.tfar, kPacket, distances);
}

}  // namespace panvo::simulated_world
