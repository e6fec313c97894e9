// SPDX-License-Identifier: Apache-2.0
// Time of place recognition, one thread: description of a panorama, comparison with many, SIFT features, pose from
// them, and the road junction detector. Uses panoramas of the recording campus_journey.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "panvo/landmark_builder/road_junction_detector.hpp"
#include "panvo/landmarks/heading_search.hpp"
#include "panvo/landmarks/keypoints.hpp"
#include "panvo/landmarks/landmark_distance.hpp"
#include "panvo/landmarks/panorama_describer.hpp"
#include "panvo/position_corrector/panorama_pose.hpp"
#include "recorded_panoramas.hpp"

namespace {

using namespace panvo;

const landmarks::PanoramaDescriber& describer() {
  static const landmarks::PanoramaDescriber describer({}, 1);
  return describer;
}

void describe(benchmark::State& state) {
  if (lack_panoramas(state)) return;
  std::size_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(describer().describe(recorded_panoramas()[i++ % recorded_panoramas().size()]));
}
BENCHMARK(describe)->Unit(benchmark::kMillisecond);

/// Description of the query panorama, and large-scale comparison at all headings with many candidates.
void search(benchmark::State& state) {
  if (lack_panoramas(state)) return;
  std::vector<landmarks::PanoramaDescription> known;
  for (std::size_t i = 0; i < 20; ++i) known.push_back(describer().describe(recorded_panoramas()[5 * i]));
  std::vector<landmarks::PanoramaDescription> candidates;
  for (int i = 0; i < state.range(0); ++i) candidates.push_back(known[static_cast<std::size_t>(i) % known.size()]);
  std::size_t i = 0;
  for (auto _ : state) {
    const auto query = describer().query(recorded_panoramas()[i++ % recorded_panoramas().size()]);
    float best = 1.0F;
    for (const auto& candidate : candidates) best = std::min(best, match_large_scale(query, candidate).distance);
    benchmark::DoNotOptimize(best);
  }
}
BENCHMARK(search)->Arg(0)->Arg(100)->Arg(10'000)->Unit(benchmark::kMillisecond);

/// Algorithm 1 and its refinement, for one landmark.
void small_scale(benchmark::State& state) {
  if (lack_panoramas(state)) return;
  const auto known = describer().describe(recorded_panoramas()[0]);
  const auto query = describer().query(recorded_panoramas()[2]);
  for (auto _ : state) benchmark::DoNotOptimize(search_heading(query, known, 0.1));
}
BENCHMARK(small_scale)->Unit(benchmark::kMillisecond);

void keypoints(benchmark::State& state) {
  if (lack_panoramas(state)) return;
  landmarks::KeypointParameters parameters;
  parameters.half_size = state.range(0) != 0;
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        landmarks::detect_keypoints(recorded_panoramas()[i++ % recorded_panoramas().size()], parameters));
  }
}
BENCHMARK(keypoints)->ArgName("half_size")->Arg(1)->Arg(0)->Unit(benchmark::kMillisecond);

/// Matching, RANSAC and refinement against a landmark whose points are all 15 m away.
void pose(benchmark::State& state) {
  if (lack_panoramas(state)) return;
  auto known = landmarks::detect_keypoints(recorded_panoramas()[0], {});
  for (auto& keypoint : known) {
    keypoint.has_point = true;
    keypoint.point_in_panorama = 15.0F * keypoint.bearing;
    keypoint.inverse_range_sigma = 0.003F;
  }
  const auto seen = landmarks::detect_keypoints(recorded_panoramas()[1], {});
  for (auto _ : state) {
    benchmark::DoNotOptimize(position_corrector::estimate_panorama_pose(seen, known, 0.0, {}));
  }
}
BENCHMARK(pose)->Unit(benchmark::kMillisecond);

void junction(benchmark::State& state) {
  if (lack_panoramas(state)) return;
  Eigen::Isometry3d base_from_panorama = Eigen::Isometry3d::Identity();
  base_from_panorama.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  base_from_panorama.translation() << -0.25, 0.0, 2.0;
  landmark_builder::RoadJunctionDetector detector({}, base_from_panorama, recorded_panoramas()[0].size());
  Eigen::Isometry3d odom_from_base = Eigen::Isometry3d::Identity();
  std::size_t i = 0;
  for (auto _ : state) {
    odom_from_base.translation().x() += 0.9;
    benchmark::DoNotOptimize(detector.detect(recorded_panoramas()[i++ % recorded_panoramas().size()], odom_from_base));
  }
}
BENCHMARK(junction)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
