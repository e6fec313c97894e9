// SPDX-License-Identifier: Apache-2.0
// `panvo run stereo` on a recording: CPU time of the whole process, including start, decoding, rectifier, odometry and
// files.
#include <benchmark/benchmark.h>

#include <nlohmann/json.hpp>

#include "panvo/test/recorded_data.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "process.hpp"

namespace {

using namespace panvo::test;

void whole(benchmark::State& state, const std::string& name, const std::string& front_end, bool replay) {
  const auto data = recorded_data(name);
  if (!std::filesystem::exists(data)) {
    state.SkipWithError(missing_recording(data).c_str());
    return;
  }
  const TemporaryFolder folder;
  nlohmann::json summary, timing;
  for (auto _ : state) {
    std::vector<std::string> words{PANVO_RUN,
                                   SYSTEMS "/stereo.yaml",
                                   "--dataset",
                                   data.string(),
                                   "--out",
                                   folder / "out",
                                   "--local",
                                   "--set",
                                   "binocular_odometry.tracking.front_end=" + front_end};
    if (replay) words.push_back("--replay");
    const Finished finished = run(words, std::chrono::seconds(600));
    if (finished.status != 0) {
      state.SkipWithError(finished.output.c_str());
      return;
    }
    summary = nlohmann::json::parse(read_file(folder / "out" / "summary.json"));
    timing = nlohmann::json::parse(read_file(folder / "out" / "timing.json"));
    state.SetIterationTime(summary.at("cpu_s").get<double>());
  }
  const double frames = summary.at("frames_in").get<double>();
  state.counters["cpu_ms_a_frame"] = summary.at("cpu_s").get<double>() * 1e3 / frames;
  state.counters["peak_memory_mb"] = summary.at("peak_memory_mb").get<double>();
  state.counters["frames_a_second"] = frames / summary.at("wall_s").get<double>();
}

}  // namespace

int main(int argc, char** argv) {
  for (const std::string name : {"campus_clip", "kitti_03"}) {
    for (const std::string front_end : {"klt", "sift"}) {
      for (const bool replay : {true, false}) {
        benchmark::RegisterBenchmark(("whole/" + name + "/" + front_end + (replay ? "/replay" : "/live")).c_str(),
                                     whole, name, front_end, replay)
            ->UseManualTime()
            ->Iterations(1)
            ->Unit(benchmark::kSecond);
      }
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
