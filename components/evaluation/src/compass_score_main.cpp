// SPDX-License-Identifier: Apache-2.0
// panvo_compass_score: accuracy of the compass on recordings with ground truth.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>
#include <string>
#include <vector>

#include "panvo/evaluation/compass_score.hpp"
#include "panvo/evaluation/journey_recording.hpp"

namespace {

enum ExitStatus { kSuccess = 0, kFailed = 1, kUsage = 2 };

}  // namespace

int main(int argc, char** argv) {
  using namespace panvo::evaluation;
  using namespace panvo::panoramic_compass;
  CLI::App app{
      "Accuracy of the panoramic compass: RMS, p95 and largest error, valid changes, and mean error^2 / variance"};
  std::vector<std::string> recordings;
  CompassParameters parameters;
  double late_ms = 0.0;
  bool list = false;
  std::size_t first = 0, count = 0;
  app.add_option("recording", recordings, "EuRoC/ASL data sets with cam2 and ground truth")->required();
  app.add_option("--method", parameters.method, "all_round or two_patches");
  app.add_option("--longest-reference", parameters.agreement.max_reference_panoramas,
                 "maximum number of panoramas per reference");
  app.add_option("--largest-parallax", parameters.agreement.max_parallax_deg,
                 "median parallax before a new reference is taken, deg");
  app.add_option("--spacing", parameters.points.spacing_px, "spacing of the points, px");
  app.add_option("--late", late_ms, "delay of the exposure after the stamp, ms");
  app.add_option("--first", first, "index of the first panorama");
  app.add_option("--count", count, "number of panoramas; 0: all");
  app.add_flag("--list", list, "list every change: stamps, change, truth and sigma in deg, parallax, validity");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kSuccess : kUsage;
  }
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  for (const std::string& folder : recordings) {
    try {
      const auto look = [&](const AzimuthChange& change, double truth) {
        if (!list) return;
        std::printf("%lld %lld %.4f %.4f %.4f %.4f %d %s\n", static_cast<long long>(change.from_stamp_ns),
                    static_cast<long long>(change.stamp_ns), change.change_rad * kDegrees, truth * kDegrees,
                    std::sqrt(change.variance_rad2) * kDegrees, change.side_parallax_rad, change.valid ? 1 : 0,
                    change.reason.c_str());
      };
      const auto recording = read_journey_recording(folder);
      auto all = panoramas_as_stamped(recording, static_cast<std::int64_t>(late_ms * 1e6));
      all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(first, all.size())));
      if (count > 0 && count < all.size()) all.resize(count);
      const CompassScore s = score_compass(recording.base_from_panorama.linear(), all, parameters, look);
      const std::string drift = s.drift_rms_deg ? fmt::format("{:.4f}", *s.drift_rms_deg) : "unknown";
      std::printf(
          "%s: %d of %d valid, RMS %.4f deg, p95 %.4f, worst %.3f (at %lld), step RMS %.4f, drift over 50 %s, "
          "consistency %.2f\n",
          folder.c_str(), s.valid, s.changes, s.rms_deg, s.p95_deg, s.worst_deg, static_cast<long long>(s.worst_ns),
          s.step_rms_deg, drift.c_str(), s.consistency);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
      return kFailed;
    }
  }
  return kSuccess;
}
