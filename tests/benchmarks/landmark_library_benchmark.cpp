// SPDX-License-Identifier: Apache-2.0
// A library of 10,000 complete landmarks: time to open its store, to find the landmarks around a position, and to read
// the SIFT features of one; memory of the library. The same for landmarks from messages. The search for a panorama in
// a whole library, without a prior position.
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <opencv2/imgproc.hpp>

#include "made_up_landmark.hpp"
#include "panvo/landmarks/landmark_library.hpp"
#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/position_corrector/landmark_matcher.hpp"
#include "panvo/position_corrector/spilled_landmarks.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace {

using namespace panvo::landmarks;

constexpr std::uint32_t kLandmarks = 10'000;
constexpr std::size_t kKeypoints = 250;
constexpr double kExtent_m = 3000.0;  // a landmark about every 30 m, as on campus roads

/// A store of synthetic landmarks, shared by all benchmarks.
const std::filesystem::path& store_file() {
  static const panvo::test::TemporaryFolder folder;
  static const std::filesystem::path file = [] {
    // Landmarks are added to a small store and copied to the large one together: one commit each would take minutes.
    const std::filesystem::path part = folder / "part", whole = folder / "whole";
    {
      LandmarkStore store(part, test::made_up_settings());
      for (std::uint32_t id = 1; id <= 100; ++id) {
        auto landmark = test::made_up_landmark(id, kKeypoints, kExtent_m);
        landmark.thumbnail.resize(25'000);
        for (auto* features : {&landmark.description.large, &landmark.description.small}) {
          features->insert(features->end(), features->begin(), features->end());  // to 200, the default
          std::ranges::stable_sort(*features, std::greater{}, &AdaptiveFeature::weight);
        }
        store.add(landmark);
      }
    }
    LandmarkStore store(whole, test::made_up_settings());
    const LandmarkStore hundred(part);
    for (std::uint32_t i = 0; i < kLandmarks / 100; ++i) store.append(hundred);
    std::vector<LandmarkPose> poses;
    for (std::uint32_t id = 1; id <= kLandmarks; ++id) {
      const auto landmark = test::made_up_landmark(id, 0, kExtent_m);
      poses.push_back({id, landmark.map_from_base, landmark.covariance});
    }
    store.set_poses(poses);
    return whole;
  }();
  return file;
}

LandmarkLibrary load(const LandmarkStore& store) {
  LandmarkLibrary library;
  for (auto& landmark : store.landmarks()) library.add(std::move(landmark));
  return library;
}

void open_and_load(benchmark::State& state) {
  const auto file = store_file();
  for (auto _ : state) {
    const auto library = load(LandmarkStore(file));
    benchmark::DoNotOptimize(library.size());
  }
  const auto before = ::mallinfo2().uordblks;
  const auto library = load(LandmarkStore(file));
  state.counters["memory_MB"] = static_cast<double>(::mallinfo2().uordblks - before) / 1e6;
  state.counters["kB_a_landmark_on_disk"] = static_cast<double>(std::filesystem::file_size(file)) / 1e3 / kLandmarks;
}
BENCHMARK(open_and_load)->Unit(benchmark::kMillisecond);

/// As in position_corrector: keypoints are kept in a separate file.
void take_from_messages(benchmark::State& state) {
  const LandmarkStore store(store_file());
  for (auto _ : state) {
    const auto before = ::mallinfo2();
    const auto keypoints = std::make_shared<panvo::position_corrector::SpilledLandmarks>("/var/tmp");
    LandmarkLibrary library(keypoints);
    for (auto& landmark : store.landmarks()) {
      keypoints->put(landmark.id, store.keypoints(landmark.id), landmark.description);
      library.add(std::move(landmark));
    }
    const auto after = ::mallinfo2();
    state.counters["memory_MB"] = static_cast<double>(after.uordblks - before.uordblks) / 1e6;
    state.counters["file_MB"] = static_cast<double>(keypoints->bytes_in_file()) / 1e6;
    if (!keypoints->problem().empty()) state.SkipWithError(keypoints->problem().c_str());
  }
}
BENCHMARK(take_from_messages)->Unit(benchmark::kMillisecond);

void spilled_landmarks_of_one(benchmark::State& state) {
  panvo::position_corrector::SpilledLandmarks keypoints("/var/tmp");
  for (std::uint32_t id = 1; id <= kLandmarks; ++id) {
    keypoints.put(id, test::made_up_landmark(id % 100, kKeypoints, kExtent_m).keypoints);
  }
  std::mt19937_64 random(1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(keypoints.keypoints(1 + static_cast<std::uint32_t>(random() % kLandmarks)));
  }
}
BENCHMARK(spilled_landmarks_of_one)->Unit(benchmark::kMicrosecond);

void within_a_prior(benchmark::State& state) {
  const auto library = load(LandmarkStore(store_file()));
  std::mt19937_64 random(1);
  std::size_t found = 0;
  for (auto _ : state) {
    const Eigen::Vector3d position{kExtent_m * (test::share(random) - 0.5), kExtent_m * (test::share(random) - 0.5), 0};
    found += library.within(position, static_cast<double>(state.range(0))).size();
  }
  state.counters["found"] = static_cast<double>(found) / static_cast<double>(state.iterations());
}
BENCHMARK(within_a_prior)->Arg(30)->Arg(100)->Arg(1000)->Unit(benchmark::kMicrosecond);

void nearest(benchmark::State& state) {
  const auto library = load(LandmarkStore(store_file()));
  std::mt19937_64 random(1);
  for (auto _ : state) {
    const Eigen::Vector3d position{kExtent_m * (test::share(random) - 0.5), kExtent_m * (test::share(random) - 0.5), 0};
    benchmark::DoNotOptimize(library.nearest(position));
  }
}
BENCHMARK(nearest)->Unit(benchmark::kMicrosecond);

void move_all(benchmark::State& state) {
  auto library = load(LandmarkStore(store_file()));
  for (auto _ : state) {
    for (const auto* landmark : library.all()) {
      auto pose = landmark->map_from_base;
      pose.translation().x() += 1.0;
      library.set_pose(landmark->id, pose, landmark->covariance);
    }
  }
}
BENCHMARK(move_all)->Unit(benchmark::kMillisecond);

void keypoints_of_one(benchmark::State& state) {
  const LandmarkStore store(store_file());
  std::mt19937_64 random(1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(store.keypoints(1 + static_cast<std::uint32_t>(random() % kLandmarks)));
  }
}
BENCHMARK(keypoints_of_one)->Unit(benchmark::kMicrosecond);

void add_one_to_the_store(benchmark::State& state) {
  const panvo::test::TemporaryFolder folder;
  LandmarkStore store(folder / "store", test::made_up_settings());
  auto landmark = test::made_up_landmark(1, kKeypoints, kExtent_m);
  landmark.id = 0;
  for (auto _ : state) store.add(landmark);
}
BENCHMARK(add_one_to_the_store)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Blots of all sizes: what the descriptions are of does not matter for the time.
cv::Mat made_up_panorama() {
  cv::Mat panorama(540, 1080, CV_8UC1);
  cv::RNG random(7);
  random.fill(panorama, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(panorama, panorama, {}, 9.0);
  cv::normalize(panorama, panorama, 0, 255, cv::NORM_MINMAX);
  return panorama;
}

/// As in position_corrector with use_position false; at most this many landmarks are compared exactly.
void search_without_prior(benchmark::State& state) {
  namespace corrector = panvo::position_corrector;
  const PanoramaDescriber describer({}, 1);
  const auto stored = std::make_shared<corrector::SpilledLandmarks>("/var/tmp");
  const auto before = ::mallinfo2();
  LandmarkLibrary library(stored, describer.basis().limits());
  for (std::uint32_t id = 1; id <= state.range(0); ++id) {
    auto landmark = test::made_up_landmark(id, 0, 10.0 * kExtent_m);
    for (auto* features : {&landmark.description.large, &landmark.description.small}) {
      features->insert(features->end(), features->begin(), features->end());
      std::ranges::stable_sort(*features, std::greater{}, &AdaptiveFeature::weight);
    }
    stored->put(id, {}, landmark.description);
    library.add(std::move(landmark));
  }
  const auto after = ::mallinfo2();
  state.counters["memory_MB"] =
      static_cast<double>(after.uordblks + after.hblkhd - before.uordblks - before.hblkhd) / 1e6;
  corrector::MatchingParameters parameters;
  parameters.max_compared = static_cast<int>(state.range(1));
  corrector::LandmarkMatcher matcher(parameters, {}, describer);
  corrector::PanoramaFrame frame;
  frame.panorama = made_up_panorama();
  for (auto _ : state) benchmark::DoNotOptimize(matcher.match(frame, library));
}
BENCHMARK(search_without_prior)
    ->Args({1000, 200})
    ->Args({1000, 1000})
    ->Args({10'000, 200})
    ->Args({10'000, 10'000})
    ->Args({100'000, 200})
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
