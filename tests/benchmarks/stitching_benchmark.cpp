// SPDX-License-Identifier: Apache-2.0
// Time of rectifying a stereo pair and of stitching a panorama of 1080 x 540 px, one thread. Different images are used
// in turn, as with a camera, so that they are read from memory and not from a cache.
#include <benchmark/benchmark.h>

#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "painted_rigs.hpp"
#include "panvo/panorama_stitcher/panorama_stitcher.hpp"
#include "panvo/vision/rectification.hpp"

namespace {

using namespace panvo;

constexpr std::size_t kSets = 4;

cv::Mat picture(cv::Size size, int channels, std::uint64_t seed) {
  cv::Mat image(size, CV_8UC(channels));
  cv::RNG(seed).fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

void rectify_pair(benchmark::State& state, const vision::LensCamera& lens) {
  const vision::PinholeCamera rectified{450, 450, 319.5, 239.5, 640, 480};
  const vision::RectificationMap left(lens, vision::so3_exp({0.002, -0.006, 0.004}), rectified);
  const vision::RectificationMap right(lens, vision::so3_exp({-0.002, 0.004, 0.001}), rectified);
  std::vector<cv::Mat> images;
  for (std::size_t i = 0; i < 2 * kSets; ++i)
    images.push_back(picture({640, 480}, static_cast<int>(state.range(0)), i));
  cv::Mat left_rectified, right_rectified;
  std::size_t i = 0;
  for (auto _ : state) {
    left.apply(images[i % images.size()], left_rectified);
    right.apply(images[(i + 1) % images.size()], right_rectified);
    i += 2;
  }
}

void stitch(benchmark::State& state, const panorama_stitcher::PanoramaRig& rig, bool compensates_gains) {
  panorama_stitcher::PanoramaStitcher stitcher(rig, {1080, compensates_gains, {}});
  std::vector<std::vector<cv::Mat>> sets(kSets);
  for (auto& set : sets) {
    for (std::size_t i = 0; i < rig.images(); ++i)
      set.push_back(picture(rig.heads[i].image_size_px, static_cast<int>(state.range(0)), i));
  }
  cv::Mat panorama;
  std::size_t i = 0;
  for (auto _ : state) stitcher.stitch(sets[i++ % kSets], panorama);
}

void make_table(benchmark::State& state, const panorama_stitcher::PanoramaRig& rig) {
  const std::vector<bool> all(rig.heads.size(), true);
  for (auto _ : state) benchmark::DoNotOptimize(panorama_stitcher::make_stitch_table(rig, 1080, all));
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  const auto add = [](const char* name, auto function, const auto&... arguments) {
    return benchmark::RegisterBenchmark(name, function, arguments...)->Unit(benchmark::kMillisecond);
  };
  const vision::PinholeCamera raw{525, 525, 319.5, 239.5, 640, 480};
  const vision::LensCamera plumb_bob{raw, vision::LensModel::kPlumbBob, {-0.3, 0.11, 0.0004, -0.0003, -0.02}};
  const vision::LensCamera fisheye{{300, 300, 319.5, 239.5, 640, 480}, vision::LensModel::kEquidistant, {-0.01, 0.003}};
  add("rectify_pair/plumb_bob", rectify_pair, plumb_bob)->ArgName("channels")->Arg(1)->Arg(3);
  add("rectify_pair/equidistant", rectify_pair, fisheye)->ArgName("channels")->Arg(1)->Arg(3);
  const auto two = panorama_stitcher::two_fisheyes(1088);
  const auto six = panorama_stitcher::six_heads(808, 616);
  const auto six_large = panorama_stitcher::six_heads(1616, 1232);
  add("stitch/two_fisheyes_1088", stitch, two, false)->ArgName("channels")->Arg(1)->Arg(3);
  add("stitch/six_heads_808x616", stitch, six, false)->ArgName("channels")->Arg(1)->Arg(3);
  add("stitch/six_heads_808x616_gains", stitch, six, true)->ArgName("channels")->Arg(3);
  add("stitch/six_heads_1616x1232", stitch, six_large, false)->ArgName("channels")->Arg(1)->Arg(3);
  add("make_table/six_heads_808x616", make_table, six);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
