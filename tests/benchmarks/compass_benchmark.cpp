// SPDX-License-Identifier: Apache-2.0
// What the panoramic compass costs a panorama, one thread (the paper: 100 ms [Lu2015 Table 3]). On panoramas of the recording
// campus_journey.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "panvo/panoramic_compass/panoramic_compass.hpp"

namespace {

namespace fs = std::filesystem;
using namespace panvo::panoramic_compass;

/// Some seconds of panoramas, a corner among them; empty where there are no recordings.
const std::vector<cv::Mat>& panoramas() {
  static const std::vector<cv::Mat> all = [] {
    std::vector<cv::Mat> images;
    const char* const data = std::getenv("PANVO_DATA");
    const fs::path folder = fs::path(data != nullptr ? data : "") / "campus_journey/mav0/cam2/data";
    std::vector<fs::path> files;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (std::size_t i = 0; i < std::min<std::size_t>(files.size(), 150); ++i) {
      images.push_back(cv::imread(files[i].string()));
    }
    cv::setNumThreads(1);
    return images;
  }();
  return all;
}

void compass(benchmark::State& state, const std::string& method) {
  if (panoramas().empty()) {
    state.SkipWithError("no panoramas: set PANVO_DATA to a folder that holds campus_journey");
    return;
  }
  CompassParameters parameters;
  parameters.method = method;
  PanoramicCompass compass(parameters);
  std::int64_t i = 0;
  int valid = 0;
  for (auto _ : state) {
    // there and back again, so that no panorama follows upon one of another place
    const auto count = static_cast<std::int64_t>(panoramas().size());
    const std::int64_t at = i % (2 * count) < count ? i % (2 * count) : 2 * count - 1 - i % (2 * count);
    const auto change = compass.track(++i, panoramas()[static_cast<std::size_t>(at)]);
    valid += change && change->valid ? 1 : 0;
  }
  state.counters["valid"] = benchmark::Counter(valid, benchmark::Counter::kAvgIterations);
}
BENCHMARK_CAPTURE(compass, all_round, "all_round")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(compass, two_patches, "two_patches")->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
