// SPDX-License-Identifier: Apache-2.0
// panvo_junctions: detects the road junctions of a data set, draws the detector's steps and scores the result.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>
#include <set>

#include "panvo/evaluation/journey_recording.hpp"
#include "panvo/evaluation/junction_score.hpp"
#include "panvo/landmark_builder/drawing.hpp"
#include "panvo/landmark_builder/junction_filter.hpp"
#include "panvo/landmark_builder/road_junction_detector.hpp"

namespace {

using namespace panvo::evaluation;
using namespace panvo::landmark_builder;

enum ExitStatus { kSuccess = 0, kFailed = 1, kUsage = 2 };

struct Options {
  std::string dataset, out, criterion = "arms";
  std::vector<int> frames;
  int every = 0;
  bool grey = false, single = false, is_verbose = false;
  double radius_m = 8.5;
};

void print_score(const JunctionScore& score) {
  for (const auto& visit : score.visits) {
    if (visit.detections == 1 || visit.is_cut) continue;
    std::printf("visit of junction %d, %lld to %lld ns, nearest %.1f m: %s\n", visit.junction,
                static_cast<long long>(visit.from_ns), static_cast<long long>(visit.to_ns), visit.nearest_m,
                visit.detections == 0 ? "missed" : "found more than once");
  }
  for (const auto& wrong : score.wrong) {
    std::printf("false: %lld at (%.1f, %.1f)\n", static_cast<long long>(wrong.nearest_stamp_ns),
                wrong.centre_in_odom.x(), wrong.centre_in_odom.y());
  }
  std::printf("%d found, %d missed, %zu false: precision %.3f, recall %.3f\n", score.found, score.missed,
              score.wrong.size(), score.precision(), score.recall());
}

int run(const Options& options) {
  const JourneyRecording recording = read_journey_recording(options.dataset);
  const auto panoramas = panoramas_as_stamped(recording);
  if (!options.out.empty()) std::filesystem::create_directories(options.out);
  const std::set<int> chosen(options.frames.begin(), options.frames.end());
  JunctionDetectorParameters parameters;
  parameters.criterion = options.criterion;
  parameters.gather = !options.single;
  JunctionFilter filter({});
  std::optional<RoadJunctionDetector> detector;
  std::vector<PassedJunction> detections;
  std::vector<double> times_ms;
  for (std::size_t i = 0; i < panoramas.size(); ++i) {
    const auto& frame = panoramas[i];
    const cv::Mat panorama = cv::imread(frame.file.string(), options.grey ? cv::IMREAD_GRAYSCALE : cv::IMREAD_COLOR);
    if (panorama.empty()) throw std::runtime_error(frame.file.string() + " is not a readable image");
    if (!detector) detector.emplace(parameters, recording.base_from_panorama, panorama.size());
    cv::TickMeter timer;
    timer.start();
    const JunctionView view = detector->detect(panorama, frame.world_from_base);
    const auto passed = filter.add(frame.stamp_ns, frame.world_from_base.translation().head<2>(), view.seen);
    timer.stop();
    times_ms.push_back(timer.getTimeMilli());
    detections.insert(detections.end(), passed.begin(), passed.end());
    if (options.is_verbose) {
      const SeenJunction seen = view.seen.value_or(SeenJunction{{0.0, 0.0}, 0});
      std::printf("%4zu  %d roads at (%.1f, %.1f), vehicle at (%.1f, %.1f)%s\n", i, seen.roads, seen.centre_in_odom.x(),
                  seen.centre_in_odom.y(), frame.world_from_base.translation().x(),
                  frame.world_from_base.translation().y(), passed.empty() ? "" : ", passed");
    }
    const bool is_wanted =
        chosen.contains(static_cast<int>(i)) || (options.every > 0 && static_cast<int>(i) % options.every == 0);
    if (!options.out.empty() && is_wanted) {
      char name[32];
      std::snprintf(name, sizeof name, "%05zu.png", i);
      cv::imwrite((std::filesystem::path(options.out) / name).string(), draw_junction_view(view, parameters));
    }
  }

  for (const PassedJunction& detection : detections) {
    std::printf("%lld  junction at (%.1f, %.1f), passed at %.1f m, seen in %d panoramas\n",
                static_cast<long long>(detection.nearest_stamp_ns), detection.centre_in_odom.x(),
                detection.centre_in_odom.y(), detection.nearest_m, detection.panoramas);
  }
  std::sort(times_ms.begin(), times_ms.end());
  std::printf("%zu panoramas, %zu junctions; time per panorama: median %.2f ms, 95 %% %.2f ms\n", times_ms.size(),
              detections.size(), times_ms[times_ms.size() / 2], times_ms[times_ms.size() * 95 / 100]);
  if (!recording.places.empty())
    print_score(score_junctions(panoramas, recording.places, detections, options.radius_m));
  return kSuccess;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{
      "Finds the road junctions of a data set (EuRoC/ASL: cam2 with ground truth) and scores them against "
      "sequence.yaml.",
      "panvo landmarks junctions"};
  app.add_option("dataset", options.dataset, "data set folder with mav0")->required()->check(CLI::ExistingDirectory);
  app.add_option("--out", options.out, "output folder for the pictures");
  app.add_option("--frames", options.frames, "indices of the panoramas to draw, from 0")->delimiter(',');
  app.add_option("--every", options.every, "draw every n-th panorama")->check(CLI::NonNegativeNumber);
  app.add_option("--criterion", options.criterion, "arms, or radon as in the paper")
      ->check(CLI::IsMember({"arms", "radon"}));
  app.add_option("--radius", options.radius_m, "radius of a visit, m")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--grey", options.grey, "convert the panoramas to grey");
  app.add_flag("--single", options.single, "evaluate each panorama individually, as in the paper");
  app.add_flag("--verbose", options.is_verbose, "print one line per panorama");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kSuccess : kUsage;
  }
  cv::setNumThreads(1);
  try {
    return run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "panvo landmarks junctions: %s\n", error.what());
    return kFailed;
  }
}
