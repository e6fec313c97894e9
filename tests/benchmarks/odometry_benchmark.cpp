// SPDX-License-Identifier: Apache-2.0
// CPU time per stereo frame of the parts of odometry on a recording: decoding, tracking, motion, both, for each front
// end.
#include <benchmark/benchmark.h>

#include <map>
#include <opencv2/core/utility.hpp>

#include "panvo/binocular_odometry/binocular_odometry.hpp"
#include "panvo/dataset_player/dataset.hpp"
#include "panvo/dataset_player/image_file.hpp"
#include "panvo/test/recorded_data.hpp"

namespace {

using namespace panvo;
using binocular_odometry::StereoFrame;

constexpr std::size_t kFrames = 150;

/// The first frames of a rectified recording, in memory.
struct Clip {
  dataset_player::Dataset dataset;
  std::vector<StereoFrame> frames;

  explicit Clip(const std::string& name) {
    const auto folder = test::recorded_data(name);
    if (!std::filesystem::exists(folder)) return;
    dataset = dataset_player::open_dataset(folder);
    dataset_player::ImageDecoder decoder;
    for (const auto& files : dataset.stereo->frames) {
      StereoFrame frame{files.stamp_ns, {}, {}};
      if (decoder.decode(files.left, dataset_player::Colour::kGrey, frame.left)) continue;
      if (decoder.decode(files.right, dataset_player::Colour::kGrey, frame.right)) continue;
      frames.push_back(frame);
      if (frames.size() == kFrames) break;
    }
  }

  static const Clip& of(const std::string& name) {
    static std::map<std::string, Clip> clips;
    return clips.try_emplace(name, name).first->second;
  }
};

/// Returns the clip, or marks the benchmark as skipped and returns nullptr.
const Clip* find(benchmark::State& state, const std::string& name) {
  const Clip& clip = Clip::of(name);
  if (!clip.frames.empty()) return &clip;
  state.SkipWithError(test::missing_recording(test::recorded_data(name)).c_str());
  return nullptr;
}

void per_frame(benchmark::State& state, const Clip& clip) {
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * clip.frames.size()));
  state.counters["time_a_frame"] = benchmark::Counter(static_cast<double>(state.iterations() * clip.frames.size()),
                                                      benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void decoding(benchmark::State& state, const std::string& name) {
  const Clip* clip = find(state, name);
  if (!clip) return;
  dataset_player::ImageDecoder decoder;
  cv::Mat left, right;
  for (auto _ : state) {
    for (std::size_t i = 0; i < clip->frames.size(); ++i) {
      decoder.decode(clip->dataset.stereo->frames[i].left, dataset_player::Colour::kGrey, left);
      decoder.decode(clip->dataset.stereo->frames[i].right, dataset_player::Colour::kGrey, right);
    }
  }
  per_frame(state, *clip);
}

void tracking(benchmark::State& state, const std::string& name, const std::string& front_end) {
  const Clip* clip = find(state, name);
  if (!clip) return;
  binocular_odometry::Parameters parameters;
  parameters.tracking.front_end = front_end;
  for (auto _ : state) {
    binocular_odometry::TrackingStage stage(clip->dataset.stereo->rectified, parameters);
    for (const auto& frame : clip->frames) benchmark::DoNotOptimize(stage.track(frame));
  }
  per_frame(state, *clip);
}

void motion(benchmark::State& state, const std::string& name, const std::string& front_end) {
  const Clip* clip = find(state, name);
  if (!clip) return;
  binocular_odometry::Parameters parameters;
  parameters.tracking.front_end = front_end;
  std::vector<binocular_odometry::TrackedFrame> tracked;
  binocular_odometry::TrackingStage stage(clip->dataset.stereo->rectified, parameters);
  for (const auto& frame : clip->frames) tracked.push_back(stage.track(frame));
  for (auto _ : state) {
    binocular_odometry::MotionStage motion_stage(clip->dataset.stereo->rectified, parameters.motion);
    for (const auto& frame : tracked) benchmark::DoNotOptimize(motion_stage.estimate(frame));
  }
  per_frame(state, *clip);
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  for (const std::string name : {"campus_clip", "kitti_03"}) {
    benchmark::RegisterBenchmark(("decoding/" + name).c_str(), decoding, name)->Unit(benchmark::kMillisecond);
    for (const std::string front_end : {"klt", "sift"}) {
      const std::string which = name + "/" + front_end;
      benchmark::RegisterBenchmark(("tracking/" + which).c_str(), tracking, name, front_end)
          ->Unit(benchmark::kMillisecond);
      benchmark::RegisterBenchmark(("motion/" + which).c_str(), motion, name, front_end)->Unit(benchmark::kMillisecond);
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
