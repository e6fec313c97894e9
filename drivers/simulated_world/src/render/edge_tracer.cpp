// SPDX-License-Identifier: Apache-2.0
#include "edge_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace panvo::simulated_world {
namespace {

constexpr float kSharpness = 0.5f;              // an edge sample covers about half of the pixel's width and of the time
constexpr float kSameSurface = 0.85f * 127.0f;  // cosine of the largest angle within the same surface
constexpr float kSameRange = 0.08f;

/// Sets of samples used among leaves, where fewer samples suffice; neighbouring pixels use different sets.
std::vector<std::vector<std::size_t>> samples_among_leaves(std::size_t count) {
  if (count == 3) return {{0, 1}, {1, 2}, {2, 0}};
  const std::size_t stride = count > 1 ? 2 : 1;
  std::vector<std::vector<std::size_t>> sets(stride);
  for (std::size_t i = 0; i < count; ++i) sets[i % stride].push_back(i);
  return sets;
}

Eigen::Vector3f unpacked(std::uint32_t normal) {
  const auto part = [&](int shift) { return static_cast<float>(static_cast<std::int8_t>(normal >> shift & 0xffu)); };
  return {part(0), part(8), part(16)};
}

}  // namespace

std::vector<EdgeSample> edge_samples(int count) {
  constexpr int kMaxInARing = 5;
  constexpr double kTurn = std::numbers::pi / 12.0;
  constexpr double kGoldenAngle = 2.399963229728653;
  std::vector<EdgeSample> samples;
  for (int i = 0; i < count; ++i) {
    const bool is_ring = count <= kMaxInARing;
    const double angle = kTurn + (is_ring ? 2.0 * std::numbers::pi * i / count : i * kGoldenAngle);
    const double radius = is_ring ? 0.41 : 0.56 * std::sqrt((i + 0.5) / count);
    // alternate moments, so that position and time are not correlated
    const int order = (2 * i) % count + (count % 2 == 0 && 2 * i >= count ? 1 : 0);
    samples.push_back({static_cast<float>(radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle)),
                       static_cast<float>((order + 0.5) / count)});
  }
  Eigen::Vector2f mean = Eigen::Vector2f::Zero();
  for (const auto& sample : samples) mean += Eigen::Vector2f(sample.column, sample.row) / static_cast<float>(count);
  for (auto& sample : samples) {
    sample.column -= mean.x();
    sample.row -= mean.y();
  }
  return samples;
}

EdgeTracer::EdgeTracer(const PacketTracer& tracer, const CameraRays& rays, const std::vector<EdgeSample>& offsets,
                       const SeenSurfaces& centres, const cv::Mat& marks, Renderer::Statistics& statistics)
    : tracer_(tracer),
      rays_(rays),
      blocks_(rays),
      offsets_(offsets),
      centres_(centres),
      marks_(marks),
      statistics_(statistics),
      among_leaves_(samples_among_leaves(offsets.size())),
      all_(offsets.size()) {
  std::iota(all_.begin(), all_.end(), 0);
  asked_.samples.share = leaves_.samples.share = met_.samples.share = kSharpness;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::fill_n(met_packet_.across[axis], kPacket, 0.0f);
    std::fill_n(met_packet_.down[axis], kPacket, 0.0f);
  }
}

void EdgeTracer::trace(int top, cv::Mat& radiance) {
  for (int left = 0; left < rays_.width; left += kBlock) {
    bool has_steps = false;
    BlockRays::Steps steps;
    for (int i = 0; i < kPacket; ++i) {
      const int row = top + i / kBlock;
      const int column = left + i % kBlock;
      if (row >= rays_.height || column >= rays_.width) continue;
      const auto mark = marks_.at<std::uint8_t>(row, column);
      if ((mark & kCrossed) == 0) continue;
      if (!has_steps) steps = blocks_.steps(left, top);
      has_steps = true;
      const bool is_leaf = (mark & kInLeaves) != 0;
      const auto& chosen =
          is_leaf ? among_leaves_[static_cast<std::size_t>(row + 2 * column) % among_leaves_.size()] : all_;
      const Pending pending{radiance.ptr<float>(row, column), 1.0f / static_cast<float>(chosen.size() + 1), row, column,
                            mark};
      for (int c = 0; c < 3; ++c) pending.pixel[c] *= pending.weight;
      for (const auto number : chosen) {
        const auto& offset = offsets_[number];
        const Eigen::Vector3f direction =
            blocks_.at(column, row) + offset.column * steps.across + offset.row * steps.down;
        auto& queue = is_leaf ? leaves_ : asked_;  // leaves differ too much to reuse radiance
        add(queue, pending, direction, static_cast<int>(number) + 1,
            {kSharpness * steps.across, kSharpness * steps.down});
        if (asked_.count == kPacket) ask();
        if (leaves_.count == kPacket) shade(leaves_);
      }
    }
  }
  ask();
  shade(leaves_);
  shade(met_);
}

void EdgeTracer::add(Queue& queue, const Pending& pending, const Eigen::Vector3f& direction, int moment,
                     const BlockRays::Steps& steps) {
  const auto lane = static_cast<std::size_t>(queue.count++);
  queue.samples.directions[lane] = direction;
  queue.samples.moments[lane] = moment;
  queue.samples.across[lane] = steps.across;
  queue.samples.down[lane] = steps.down;
  queue.pending[lane] = pending;
}

/// Completes the packet; false if it is empty.
bool EdgeTracer::close(Queue& queue) const {
  if (queue.count == 0) return false;
  queue.samples.lanes = (1u << queue.count) - 1u;
  for (auto lane = static_cast<std::size_t>(queue.count); lane < kPacket; ++lane) {
    queue.samples.directions[lane] = queue.samples.directions[0];
    queue.samples.moments[lane] = queue.samples.moments[0];
    queue.samples.across[lane] = queue.samples.across[0];
    queue.samples.down[lane] = queue.samples.down[0];
  }
  return true;
}

void EdgeTracer::ask() {
  if (!close(asked_)) return;
  TracedPacket packet;
  tracer_.meet(asked_.samples, packet, statistics_);
  for (std::size_t lane = 0; lane < static_cast<std::size_t>(asked_.count); ++lane) {
    if (borrow(asked_.pending[lane], tracer_.surface(packet, lane))) continue;
    copy_lane(packet, lane, met_packet_, static_cast<std::size_t>(met_.count));
    add(met_, asked_.pending[lane], asked_.samples.directions[lane], asked_.samples.moments[lane],
        {asked_.samples.across[lane], asked_.samples.down[lane]});
    if (met_.count == kPacket) shade(met_);
  }
  asked_.count = 0;
}

void EdgeTracer::shade(Queue& queue) {
  if (!close(queue)) return;
  auto& samples = queue.samples;
  samples.in_sun = samples.in_shadow = 0;
  for (int lane = 0; lane < queue.count; ++lane) {
    const auto mark = queue.pending[static_cast<std::size_t>(lane)].mark;
    if ((mark & kAllInSun) != 0) samples.in_sun |= 1u << lane;
    if ((mark & kAllInShadow) != 0) samples.in_shadow |= 1u << lane;
  }
  SampleResults results;
  if (&queue == &met_) {
    for (auto lane = static_cast<std::size_t>(queue.count); lane < kPacket; ++lane) {
      copy_lane(met_packet_, 0, met_packet_, lane);
    }
    tracer_.shade(samples, met_packet_, results, statistics_);
  } else {
    tracer_.trace(samples, results, statistics_);
  }
  for (std::size_t lane = 0; lane < static_cast<std::size_t>(queue.count); ++lane) {
    const auto& pending = queue.pending[lane];
    for (std::size_t c = 0; c < 3; ++c) pending.pixel[c] += pending.weight * results.radiance[lane][c];
  }
  queue.count = 0;
}

/// Adds the radiance of the same surface at the centre of the pixel or its neighbours; false if none of them sees it,
/// or if some see it sunlit and others in shadow.
bool EdgeTracer::borrow(const Pending& pending, const SeenSurface& surface) const {
  const int width = rays_.width;
  const int left = pending.column > 0 ? pending.column - 1 : rays_.wraps ? width - 1 : 0;
  const int right = pending.column + 1 < width ? pending.column + 1 : rays_.wraps ? 0 : pending.column;
  const std::array<std::pair<int, int>, 5> places{{{pending.row, pending.column},
                                                   {pending.row, left},
                                                   {pending.row, right},
                                                   {std::max(pending.row - 1, 0), pending.column},
                                                   {std::min(pending.row + 1, rays_.height - 1), pending.column}}};
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float count = 0.0f;
  bool is_sunny = false;
  bool is_shady = false;
  bool is_centre = false;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto [row, column] = places[i];
    if (centres_.key.at<std::uint32_t>(row, column) != surface.key) continue;
    const auto normal = centres_.normal.at<std::uint32_t>(row, column);
    if (surface.key != 0 && unpacked(normal).dot(surface.normal) < kSameSurface) continue;
    const float nearness = centres_.inverse_range.at<float>(row, column);
    if (std::abs(surface.inverse_range - nearness) > kSameRange * nearness) continue;  // at another distance
    is_sunny = is_sunny || (normal & kSunny) != 0;
    is_shady = is_shady || (normal & kSunny) == 0;
    if (is_centre) continue;  // the nearest; the others only indicate sunlight
    is_centre = i == 0;
    sum += Eigen::Map<const Eigen::Vector3f>(centres_.radiance.ptr<float>(row, column));
    count += 1.0f;
  }
  if (count == 0.0f || (is_sunny && is_shady)) return false;
  Eigen::Map<Eigen::Vector3f>(pending.pixel) += pending.weight / count * sum;
  return true;
}

}  // namespace panvo::simulated_world
