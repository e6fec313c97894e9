// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulated_world/renderer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <opencv2/core/utility.hpp>
#include <stdexcept>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "block_rays.hpp"
#include "edge_finder.hpp"
#include "edge_tracer.hpp"
#include "packet_tracer.hpp"
#include "shading_materials.hpp"
#include "traced_scene.hpp"

namespace panvo::simulated_world {
namespace {

constexpr int kMaxEdgeSamples = 16;

/// Treats denormal numbers as zero during its lifetime, as Embree recommends, and equally in every thread.
class FlushDenormals {
 public:
#if defined(__SSE__)
  FlushDenormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040u); }
  ~FlushDenormals() { _mm_setcsr(before_); }

 private:
  unsigned before_;
#else
  FlushDenormals() = default;
#endif
 public:
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;
};

ShutterPose pose_at(const Shot& shot, double time) {
  const Eigen::Quaterniond opened(shot.world_from_camera_opened.linear());
  const Eigen::Quaterniond closed(shot.world_from_camera_closed.linear());
  const Eigen::Matrix3f rotation = opened.slerp(time, closed).toRotationMatrix().cast<float>();
  const Eigen::Vector3f origin =
      ((1.0 - time) * shot.world_from_camera_opened.translation() + time * shot.world_from_camera_closed.translation())
          .cast<float>();
  ShutterPose pose;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      pose.world_from_camera[static_cast<std::size_t>(3 * row + column)] = rotation(row, column);
    }
    pose.origin[static_cast<std::size_t>(row)] = origin[row];
  }
  pose.time = static_cast<float>(time);
  return pose;
}

std::array<float, 3> to_array(const Eigen::Vector3f& vector) { return {vector.x(), vector.y(), vector.z()}; }

/// Per-pixel data for finding edges.
struct Picture {
  Picture(int height, int width)
      : radiance(height, width, CV_32FC3, cv::Scalar::all(0.0)),
        inverse_range(height, width, CV_32FC1),
        key(height, width, CV_32SC1),
        normal(height, width, CV_32SC1) {}
  cv::Mat radiance, inverse_range, key, normal;
};

void trace_centres(const PacketTracer& tracer, const CameraRays& rays, int top, Picture& picture,
                   Renderer::Statistics& statistics) {
  const BlockRays blocks(rays);
  SampleRays samples;
  SampleResults results;
  for (int left = 0; left < rays.width; left += kBlock) {
    blocks.fill(left, top, samples);
    if (samples.lanes != 0) tracer.trace(samples, results, statistics);
    const int columns = std::min(kBlock, rays.width - left);
    for (int y = 0; y < std::min(kBlock, rays.height - top); ++y) {
      auto* radiance = picture.radiance.ptr<float>(top + y) + 3 * left;
      auto* inverse_range = picture.inverse_range.ptr<float>(top + y) + left;
      auto* key = picture.key.ptr<std::uint32_t>(top + y) + left;
      auto* normal = picture.normal.ptr<std::uint32_t>(top + y) + left;
      for (int x = 0; x < columns; ++x) {
        const auto lane = static_cast<std::size_t>(kBlock * y + x);
        const bool sees = (samples.lanes >> lane & 1u) != 0;
        for (std::size_t c = 0; c < 3; ++c)
          radiance[3 * x + static_cast<int>(c)] = sees ? results.radiance[lane][c] : 0;
        inverse_range[x] = sees ? 1.0f / results.distance[lane] : 0.0f;
        key[x] = sees ? results.key[lane] : 0;
        normal[x] = sees ? results.normal[lane] : 0;
      }
    }
  }
}

std::vector<LampRecord> records_of(const std::vector<Lamp>& lamps) {
  std::vector<LampRecord> records;
  for (const auto& lamp : lamps) {
    records.push_back(
        {lamp.position.x(), lamp.position.y(), lamp.position.z(), lamp.intensity, lamp.hangs ? 0.12f : 1.0f});
  }
  return records;
}

}  // namespace

struct Renderer::State {
  explicit State(std::shared_ptr<const Scene> seen)
      : scene(std::move(seen)),
        materials(*checked(*this).palette),
        environment(*scene->sky),
        traced(scene, materials),
        lamps(records_of(scene->lamps)) {}

  static const Scene& checked(const State& state) {
    if (!state.scene || !state.scene->palette || !state.scene->sky) {
      throw std::invalid_argument("renderer: the scene has no palette or no sky");
    }
    return *state.scene;
  }

  std::shared_ptr<const Scene> scene;
  ShadingMaterials materials;
  Environment environment;
  TracedScene traced;
  std::vector<LampRecord> lamps;
  Statistics statistics;
};

Renderer::Renderer(std::shared_ptr<const Scene> scene) {
  const FlushDenormals flush;
  state_ = std::make_unique<State>(std::move(scene));
}
Renderer::~Renderer() = default;

cv::Mat Renderer::render(const CameraRays& rays, const Shot& shot, const Light& light,
                         std::span<const MovingPlacement> movers, const Quality& quality) {
  auto& state = *state_;
  const FlushDenormals flush;
  state.traced.place_movers(movers);
  ShadingTables tables;
  state.traced.fill(tables);
  state.materials.fill(tables);
  tables.environment = state.environment.update(light);
  tables.to_sun = to_array(light.to_sun);
  tables.sun = to_array(light.sun);
  tables.sky = to_array(light.sky);
  tables.ground = to_array(light.ground);
  tables.haze = to_array(haze(light));
  tables.haze_per_m = light.haze_per_m;
  tables.lamps = state.lamps.data();
  tables.lamp_count = light.lamps ? static_cast<std::uint32_t>(state.lamps.size()) : 0;
  tables.evening = light.evening;
  tables.film_limit = light.lamps ? 0.03f : std::numeric_limits<float>::infinity();
  tables.texture_taps = std::clamp(quality.texture_taps, 1, 16);
  const Eigen::Vector3d moved =
      shot.world_from_camera_closed.translation() - shot.world_from_camera_opened.translation();
  tables.camera_motion = to_array(moved.cast<float>());
  const Eigen::Matrix3d turned =
      (shot.world_from_camera_closed.linear() * shot.world_from_camera_opened.linear().transpose()) -
      Eigen::Matrix3d::Identity();
  for (int i = 0; i < 9; ++i) {
    tables.camera_rotation[static_cast<std::size_t>(i)] = static_cast<float>(turned(i / 3, i % 3));
  }

  const auto offsets = edge_samples(std::clamp(quality.edge_samples, 0, kMaxEdgeSamples));
  std::vector<ShutterPose> moments{pose_at(shot, 0.5)};
  for (const auto& offset : offsets) moments.push_back(pose_at(shot, offset.time));
  const PacketTracer tracer(state.traced, *state.scene->sky, light, tables, shot.visibility, std::move(moments));

  Picture picture(rays.height, rays.width);
  state.statistics = {};
  state.statistics.pixels = static_cast<std::uint64_t>(rays.width) * static_cast<std::uint64_t>(rays.height);
  state.statistics.triangles = state.traced.triangle_count();
  std::mutex mutex;
  const int strips = (rays.height + kBlock - 1) / kBlock;
  const auto in_strips = [&](const auto& work) {
    cv::parallel_for_(
        cv::Range(0, strips),
        [&](const cv::Range& range) {
          const FlushDenormals flush_here;
          Statistics counted;
          for (int strip = range.start; strip < range.end; ++strip) work(strip * kBlock, counted);
          const std::lock_guard lock(mutex);
          state.statistics.primary_rays += counted.primary_rays;
          state.statistics.shadow_rays += counted.shadow_rays;
        },
        strips);
  };
  in_strips([&](int top, Statistics& counted) { trace_centres(tracer, rays, top, picture, counted); });
  if (offsets.empty()) return picture.radiance;
  cv::Mat is_edge(rays.height, rays.width, CV_8UC1);
  const SeenSurfaces seen{picture.radiance, picture.inverse_range, picture.key, picture.normal, rays.wraps};
  in_strips([&](int top, Statistics&) { find_edges(seen, top, std::min(top + kBlock, rays.height), is_edge); });
  cv::Mat result = picture.radiance.clone();
  in_strips([&](int top, Statistics& counted) {
    EdgeTracer(tracer, rays, offsets, seen, is_edge, counted).trace(top, result);
  });
  return result;
}

cv::Mat Renderer::render_range(const CameraRays& rays, const Shot& shot, std::span<const MovingPlacement> movers) {
  auto& state = *state_;
  const FlushDenormals flush;
  state.traced.place_movers(movers);
  const Light light;
  const PacketTracer tracer(state.traced, *state.scene->sky, light, {}, shot.visibility, {pose_at(shot, 0.0)});
  cv::Mat range(rays.height, rays.width, CV_32FC1);
  const BlockRays blocks(rays);
  const int strips = (rays.height + kBlock - 1) / kBlock;
  cv::parallel_for_(cv::Range(0, strips), [&](const cv::Range& part) {
    const FlushDenormals flush_here;
    SampleRays samples;
    std::array<float, kPacket> distances{};
    for (int top = part.start * kBlock; top < std::min(part.end * kBlock, rays.height); top += kBlock) {
      for (int left = 0; left < rays.width; left += kBlock) {
        blocks.fill(left, top, samples);
        distances.fill(std::numeric_limits<float>::infinity());
        if (samples.lanes != 0) tracer.trace_range(samples, distances.data());
        for (int i = 0; i < kPacket; ++i) {
          const int row = top + i / kBlock;
          const int column = left + i % kBlock;
          if (row >= rays.height || column >= rays.width) continue;
          range.at<float>(row, column) = distances[static_cast<std::size_t>(i)];
        }
      }
    }
  });
  return range;
}

Renderer::Statistics Renderer::statistics() const { return state_->statistics; }

}  // namespace panvo::simulated_world
