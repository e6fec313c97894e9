// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/renderer.hpp"

#include <atomic>
#include <cmath>
#include <limits>
#include <opencv2/core/utility.hpp>

#include "traced_scene.hpp"

namespace panvo::simulation {

struct Renderer::State {
  explicit State(std::shared_ptr<const Scene> seen) : scene(std::move(seen)), traced(scene) {}

  std::shared_ptr<const Scene> scene;
  TracedScene traced;
  Statistics statistics;
};

Renderer::Renderer(std::shared_ptr<const Scene> scene) : state_(std::make_unique<State>(std::move(scene))) {
  state_->statistics.triangles = state_->traced.triangle_count();
}
Renderer::~Renderer() = default;

namespace {

struct Hit {
  RTCRayHit ray{};
  bool is_moving = false;
  bool is_hit() const { return ray.hit.geomID != RTC_INVALID_GEOMETRY_ID; }
};

Hit trace(const TracedScene& traced, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float time,
          std::uint32_t mask) {
  Hit hit;
  auto& ray = hit.ray.ray;
  ray = {origin.x(),
         origin.y(),
         origin.z(),
         0.0f,
         direction.x(),
         direction.y(),
         direction.z(),
         time,
         std::numeric_limits<float>::infinity(),
         mask,
         0,
         0};
  hit.ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  hit.ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect1(traced.standing(), &context, &hit.ray);
  if (traced.moving()) {
    const float before = ray.tfar;
    rtcIntersect1(traced.moving(), &context, &hit.ray);
    hit.is_moving = ray.tfar < before;
  }
  return hit;
}

bool is_shadowed(const TracedScene& traced, const Eigen::Vector3f& origin, const Eigen::Vector3f& to_sun, float time) {
  RTCRay ray = {origin.x(), origin.y(), origin.z(),
                0.0f,       to_sun.x(), to_sun.y(),
                to_sun.z(), time,       std::numeric_limits<float>::infinity(),
                kToShadow,  0,          0};
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(traced.standing(), &context, &ray);
  if (ray.tfar > 0.0f && traced.moving()) rtcOccluded1(traced.moving(), &context, &ray);
  return ray.tfar < 0.0f;
}

struct Shading {
  const Scene& scene;
  const TracedScene& traced;
  const Light& light;
  int taps;

  Eigen::Vector3f radiance(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                           const Eigen::Vector3f& across, const Eigen::Vector3f& down, float time,
                           std::uint32_t mask) const {
    const float spread = 0.5f * (across.norm() + down.norm());
    const Hit hit = trace(traced, origin, direction, time, mask);
    if (!hit.is_hit()) return scene.sky->radiance(direction, light, spread);
    const auto& object = traced.objects()[traced.object(hit.ray.hit.instID[0], hit.ray.hit.geomID, hit.is_moving)];
    const auto& surface = traced.surfaces()[object.first_surface[hit.ray.hit.geomID & 1u] + hit.ray.hit.primID];
    const auto& material = scene.palette->materials()[surface.material_occlusion & 0xffu];
    const float second = hit.ray.hit.u;
    const float third = hit.ray.hit.v;
    const float first = 1.0f - second - third;
    const Eigen::Map<const Eigen::Matrix<float, 3, 4>> transform(object.world_from_model.data());
    const Eigen::Matrix3f world_from_model = transform.leftCols<3>();
    const float distance = hit.ray.ray.tfar;
    const Eigen::Vector3f point = origin + distance * direction;
    Eigen::Vector3f flat(hit.ray.hit.Ng_x, hit.ray.hit.Ng_y, hit.ray.hit.Ng_z);
    flat = (world_from_model * flat).normalized();
    Eigen::Vector3f normal =
        world_from_model * (first * unpack_normal(surface.normals[0]) + second * unpack_normal(surface.normals[1]) +
                            third * unpack_normal(surface.normals[2]));
    normal.normalize();
    if (flat.dot(direction) > 0.0f) flat = -flat;
    if (normal.dot(flat) < 0.0f) normal = -normal;

    Eigen::Vector4f tint = Eigen::Vector4f::Zero();
    for (int i = 0; i < 3; ++i) {
      const float weight = i == 0 ? first : i == 1 ? second : third;
      for (int c = 0; c < 4; ++c) {
        tint[c] +=
            weight * static_cast<float>((surface.tints[static_cast<std::size_t>(i)] >> (8 * c)) & 0xffu) / 255.0f;
      }
    }
    const bool is_painted = material.name.ends_with("_paint") || material.name.starts_with("leaves");
    Eigen::Vector3f albedo = material.tint.cwiseProduct(tint.head<3>());
    if (is_painted) albedo = albedo.cwiseProduct(Eigen::Vector3f(object.tint[0], object.tint[1], object.tint[2]));
    const Eigen::Vector2f uv(surface.uv[0] + second * surface.uv[2] + third * surface.uv[4],
                             surface.uv[1] + second * surface.uv[3] + third * surface.uv[5]);
    const auto half = [&](int i) {
      const std::uint32_t word = surface.gradients[static_cast<std::size_t>(i / 2)];
      return std::bit_cast<float>(i % 2 == 0 ? word << 16 : word & 0xffff0000u);
    };
    const float square = world_from_model.col(0).squaredNorm();
    const Eigen::Vector3f u_gradient = world_from_model * Eigen::Vector3f(half(0), half(1), half(2)) / square;
    const Eigen::Vector3f v_gradient = world_from_model * Eigen::Vector3f(half(3), half(4), half(5)) / square;
    const auto step = [&](const Eigen::Vector3f& change) {
      const float slope = std::min(direction.dot(flat), -0.02f);
      const Eigen::Vector3f on_plane = distance * (change - direction * (change.dot(flat) / slope));
      return Eigen::Vector2f(u_gradient.dot(on_plane), v_gradient.dot(on_plane));
    };
    const Eigen::Vector2f du = step(across);
    const Eigen::Vector2f dv = step(down);
    if (material.albedo) {
      const Eigen::Vector4f texel =
          material.albedo->sample(uv / material.period_m, du / material.period_m, dv / material.period_m, taps);
      const Eigen::Vector3f mean = material.albedo->mean().head<3>();
      albedo = albedo.cwiseProduct(mean + tint[3] * (texel.head<3>() - mean));
    }
    if (material.overlay) {
      const float period = material.overlay_period_m;
      const Eigen::Vector3f texel = material.overlay->sample(uv / period, du / period, dv / period, 1).head<3>();
      albedo = albedo.cwiseProduct(2.0f * texel);
    }
    const float open = (first * static_cast<float>((surface.material_occlusion >> 8) & 0xffu) +
                        second * static_cast<float>((surface.material_occlusion >> 16) & 0xffu) +
                        third * static_cast<float>((surface.material_occlusion >> 24) & 0xffu)) /
                       255.0f;
    Eigen::Vector3f irradiance =
        open * (light.sky * (0.5f + 0.5f * normal.z()) + light.ground * (0.5f - 0.5f * normal.z()));
    const float facing = normal.dot(light.to_sun);
    const float direct = facing > 0.0f ? (1.0f - material.translucency) * facing : -material.translucency * facing;
    if (direct > 0.0f) {
      const float offset = 1e-3f + 2e-4f * distance;
      const Eigen::Vector3f above = point + flat * (flat.dot(light.to_sun) > 0.0f ? offset : -offset);
      if (!is_shadowed(traced, above, light.to_sun, time)) irradiance += direct * light.sun;
    }
    Eigen::Vector3f radiance = albedo.cwiseProduct(irradiance);
    if (material.gloss > 0.0f) {
      const float cosine = std::clamp(-normal.dot(direction), 0.0f, 1.0f);
      const float fresnel = material.gloss + (1.0f - material.gloss) * std::pow(1.0f - cosine, 5.0f);
      const Eigen::Vector3f mirrored = direction + 2.0f * cosine * normal;
      const Eigen::Vector3f seen =
          mirrored.z() > 0.0f ? scene.sky->radiance(mirrored, light, 0.02f) : Eigen::Vector3f(light.ground);
      radiance += fresnel * (open * seen - radiance);
    }
    const Eigen::Vector3f level = Eigen::Vector3f(direction.x(), direction.y(), 0.05f).normalized();
    const float haze = 1.0f - std::exp(-light.haze_per_m * distance);
    if (haze > 0.01f) radiance += haze * (scene.sky->radiance(level, light, 0.1f) - radiance);
    return radiance;
  }
};

}  // namespace

cv::Mat Renderer::render(const CameraRays& rays, const Shot& shot, const Light& light,
                         std::span<const MovingPlacement> movers, const Quality& quality) {
  state_->traced.place_movers(movers);
  const Shading shading{*state_->scene, state_->traced, light, quality.texture_taps};
  cv::Mat image(rays.height, rays.width, CV_32FC3, cv::Scalar::all(0));
  const Eigen::Matrix3f rotation = shot.world_from_camera_opened.linear().cast<float>();
  const Eigen::Vector3f origin = shot.world_from_camera_opened.translation().cast<float>();
  cv::parallel_for_(cv::Range(0, rays.height), [&](const cv::Range& range) {
    for (int row = range.start; row < range.end; ++row) {
      for (int column = 0; column < rays.width; ++column) {
        const auto x = static_cast<float>(column);
        const auto y = static_cast<float>(row);
        const Eigen::Vector3f direction = rays.direction(x, y);
        if (direction.isZero()) continue;
        const Eigen::Vector3f across = rotation * (rays.direction(x + 0.5f, y) - rays.direction(x - 0.5f, y));
        const Eigen::Vector3f down = rotation * (rays.direction(x, y + 0.5f) - rays.direction(x, y - 0.5f));
        Eigen::Map<Eigen::Vector3f>(image.ptr<float>(row, column)) =
            shading.radiance(origin, rotation * direction, across, down, 0.0f, shot.visibility);
      }
    }
  });
  return image;
}

cv::Mat Renderer::render_range(const CameraRays& rays, const Shot& shot, std::span<const MovingPlacement> movers) {
  state_->traced.place_movers(movers);
  cv::Mat range(rays.height, rays.width, CV_32FC1);
  const Eigen::Matrix3f rotation = shot.world_from_camera_opened.linear().cast<float>();
  const Eigen::Vector3f origin = shot.world_from_camera_opened.translation().cast<float>();
  for (int row = 0; row < rays.height; ++row) {
    for (int column = 0; column < rays.width; ++column) {
      const Eigen::Vector3f direction =
          rotation * rays.directions[static_cast<std::size_t>(row) * static_cast<std::size_t>(rays.width) +
                                     static_cast<std::size_t>(column)];
      const bool sees = !direction.isZero();
      range.at<float>(row, column) = sees ? trace(state_->traced, origin, direction, 0.0f, shot.visibility).ray.ray.tfar
                                          : std::numeric_limits<float>::infinity();
    }
  }
  return range;
}

Renderer::Statistics Renderer::statistics() const { return state_->statistics; }

}  // namespace panvo::simulation
