// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/renderer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <opencv2/core/utility.hpp>
#include <stdexcept>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "edge_finder.hpp"
#include "packet_tracer.hpp"
#include "shading_materials.hpp"
#include "traced_scene.hpp"

namespace panvo::simulation {
namespace {

constexpr int kBlock = 4;  // a packet is 4 x 4 pixels
constexpr int kMostEdgeSamples = 16;

/// Numbers too small to be normal count as zero meanwhile: Embree asks for it, and every thread must do the same.
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

/// Offsets inside a pixel, -0.5..0.5, and moments, 0..1, of the samples of an edge.
struct EdgeSample {
  float column, row, time;
};

/// The samples of an edge beside the pixel's centre: their mean is the centre, in place and time, so that the picture
/// does not shift, and along any edge that is about level or upright no two of them are as far.
std::vector<EdgeSample> edge_samples(int count) {
  constexpr int kMostInARing = 5;
  constexpr double kTurn = 15.0 * CV_PI / 180.0;
  std::vector<EdgeSample> samples;
  for (int i = 0; i < count; ++i) {
    const bool is_ring = count <= kMostInARing;
    const double angle = kTurn + (is_ring ? 2.0 * CV_PI * i / count : i * CV_PI * (3.0 - std::sqrt(5.0)));
    const double radius = is_ring ? 0.41 : 0.56 * std::sqrt((i + 0.5) / count);
    const double moment = ((2 * i) % count + (count % 2 == 0 && 2 * i >= count ? 1 : 0) + 0.5) / count;
    samples.push_back({static_cast<float>(radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle)),
                       static_cast<float>(moment)});
  }
  Eigen::Vector2f mean = Eigen::Vector2f::Zero();
  for (const auto& sample : samples) mean += Eigen::Vector2f(sample.column, sample.row) / static_cast<float>(count);
  for (auto& sample : samples) {
    sample.column -= mean.x();
    sample.row -= mean.y();
  }
  return samples;
}

/// Which of the samples are traced among leaves, where fewer will do: sets that pixels take in turns.
std::vector<std::vector<std::size_t>> samples_among_leaves(std::size_t count) {
  std::vector<std::vector<std::size_t>> sets;
  if (count == 3) return {{0, 1}, {1, 2}, {2, 0}};
  for (std::size_t first = 0; first < (count > 3 ? 2u : 1u); ++first) {
    sets.emplace_back();
    for (std::size_t i = first; i<count; i += count> 3 ? 2 : 1) sets.back().push_back(i);
  }
  return sets;
}

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

/// The rays of a camera in blocks, with the steps from one pixel to the next.
class BlockRays {
 public:
  explicit BlockRays(const CameraRays& rays) : rays_(rays) {}

  /// The centres of the pixels of a block; lanes beyond the image or where the camera sees nothing are left out.
  void fill(int left, int top, SampleRays& samples) const {
    samples.lanes = 0;
    for (int i = 0; i < kPacket; ++i) {
      const int column = left + i % kBlock;
      const int row = top + i / kBlock;
      const auto& direction = at(std::min(column, rays_.width - 1), std::min(row, rays_.height - 1));
      samples.directions[static_cast<std::size_t>(i)] = direction;
      const bool is_there =
          column < rays_.width && row < rays_.height &&
          direction.z() * direction.z() + direction.y() * direction.y() + direction.x() * direction.x() > 0.5f;
      if (is_there) samples.lanes |= 1u << i;
    }
    const auto [across, down] = steps(left, top);
    samples.across.fill(across);
    samples.down.fill(down);
    samples.is_block = true;
    samples.moments.fill(0);
    samples.share = 1.0f;
  }

  /// What the direction gains per column and per row, on the average of the block.
  std::pair<Eigen::Vector3f, Eigen::Vector3f> steps(int left, int top) const {
    const int x0 = std::clamp(left, 0, std::max(0, rays_.width - kBlock));
    const int y0 = std::clamp(top, 0, std::max(0, rays_.height - kBlock));
    const int x1 = std::min(x0 + kBlock - 1, rays_.width - 1);
    const int y1 = std::min(y0 + kBlock - 1, rays_.height - 1);
    const auto& top_left = at(x0, y0);
    const auto& top_right = at(x1, y0);
    const auto& low_left = at(x0, y1);
    const auto& low_right = at(x1, y1);
    const auto step = [](const Eigen::Vector3f& a, const Eigen::Vector3f& b, int count) {
      const bool sees = !a.isZero() && !b.isZero() && count > 0;
      return sees ? Eigen::Vector3f((b - a) / static_cast<float>(count)) : Eigen::Vector3f(Eigen::Vector3f::Zero());
    };
    const auto either = [](const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
      if (a.isZero()) return b;
      return b.isZero() ? a : Eigen::Vector3f(0.5f * (a + b));
    };
    return {either(step(top_left, top_right, x1 - x0), step(low_left, low_right, x1 - x0)),
            either(step(top_left, low_left, y1 - y0), step(top_right, low_right, y1 - y0))};
  }

  const Eigen::Vector3f& at(int column, int row) const {
    return rays_.directions[static_cast<std::size_t>(row) * static_cast<std::size_t>(rays_.width) +
                            static_cast<std::size_t>(column)];
  }

 private:
  const CameraRays& rays_;
};

/// What is needed to find the edges.
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

/// Adds the samples of the edges in four rows of pixels, whose edges `is_edge` marks.
void trace_edges(const PacketTracer& tracer, const CameraRays& rays, const std::vector<EdgeSample>& offsets, int top,
                 const cv::Mat& is_edge, cv::Mat& radiance, Renderer::Statistics& statistics) {
  const BlockRays blocks(rays);
  SampleRays samples;
  SampleResults results;
  std::array<float*, kPacket> pixels{};
  samples.share = 0.5f;
  samples.is_block = false;
  const auto among_leaves = samples_among_leaves(offsets.size());
  std::vector<std::size_t> all(offsets.size());
  std::iota(all.begin(), all.end(), 0);
  std::array<float, kPacket> weights{};
  int count = 0;
  const auto flush = [&] {
    if (count == 0) return;
    samples.lanes = (1u << count) - 1u;
    for (int i = count; i < kPacket; ++i) {
      samples.directions[static_cast<std::size_t>(i)] = samples.directions[0];
      samples.moments[static_cast<std::size_t>(i)] = samples.moments[0];
    }
    tracer.trace(samples, results, statistics);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      for (std::size_t c = 0; c < 3; ++c) pixels[i][c] += weights[i] * results.radiance[i][c];
    }
    count = 0;
    samples.in_sun = samples.in_shadow = 0;
  };
  for (int left = 0; left < rays.width; left += kBlock) {
    bool has_steps = false;
    std::pair<Eigen::Vector3f, Eigen::Vector3f> full_steps{Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()};
    auto steps = full_steps;
    for (int i = 0; i < kPacket; ++i) {
      const int row = top + i / kBlock;
      const int column = left + i % kBlock;
      if (row >= rays.height || column >= rays.width || (is_edge.at<std::uint8_t>(row, column) & kCrossed) == 0)
        continue;
      const auto mark = is_edge.at<std::uint8_t>(row, column);
      if (!has_steps) {
        full_steps = blocks.steps(left, top);
        steps = {samples.share * full_steps.first, samples.share * full_steps.second};
        has_steps = true;
      }
      const bool is_leaf = (mark & kInLeaves) != 0;
      const auto& chosen =
          is_leaf ? among_leaves[static_cast<std::size_t>(row + 2 * column) % among_leaves.size()] : all;
      const float weight = 1.0f / static_cast<float>(chosen.size() + 1);
      auto* pixel = radiance.ptr<float>(row, column);
      for (int c = 0; c < 3; ++c) pixel[c] *= weight;
      const auto& centre = blocks.at(column, row);
      for (const auto s : chosen) {
        const Eigen::Vector3f direction =
            centre + offsets[s].column * full_steps.first + offsets[s].row * full_steps.second;
        const auto lane = static_cast<std::size_t>(count);
        samples.directions[lane] = direction;
        samples.moments[lane] = static_cast<int>(s) + 1;
        samples.across[lane] = steps.first;
        samples.down[lane] = steps.second;
        pixels[lane] = pixel;
        weights[lane] = weight;
        if ((mark & kAllInSun) != 0) samples.in_sun |= 1u << count;
        if ((mark & kAllInShadow) != 0) samples.in_shadow |= 1u << count;
        if (++count == kPacket) flush();
      }
    }
  }
  flush();
}

}  // namespace

struct Renderer::State {
  explicit State(std::shared_ptr<const Scene> seen)
      : scene(std::move(seen)),
        materials(*checked(*this).palette),
        environment(*scene->sky),
        traced(scene, materials) {}

  static const Scene& checked(const State& state) {
    if (!state.scene || !state.scene->palette || !state.scene->sky) {
      throw std::invalid_argument("renderer: the scene lacks its palette or its sky");
    }
    return *state.scene;
  }

  std::shared_ptr<const Scene> scene;
  ShadingMaterials materials;
  Environment environment;
  TracedScene traced;
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

  const auto offsets = edge_samples(std::clamp(quality.edge_samples, 0, kMostEdgeSamples));
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
  in_strips([&](int top, Statistics& counted) {
    trace_edges(tracer, rays, offsets, top, is_edge, picture.radiance, counted);
  });
  return picture.radiance;
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

}  // namespace panvo::simulation
