// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "panvo/test/temporary_folder.hpp"

namespace panvo::evaluation {

/// A recording of a drive along x with one panorama per second and metre. Images are uniform grey; the level identifies
/// the place.
class PlainRecording {
 public:
  struct Visit {
    int place;
    int second;
  };

  PlainRecording(const std::vector<int>& greys, const std::vector<Visit>& visits) {
    folder.write("mav0/cam2/sensor.yaml",
                 "%YAML:1.0\nT_BS:\n  cols: 4\n  rows: 4\n"
                 "  data: [0, 0, 1, 0.5, -1, 0, 0, 0, 0, -1, 0, 2, 0, 0, 0, 1]\n"
                 "resolution: [256, 128]\ncamera_model: equirectangular\n");
    std::filesystem::create_directories(folder / "mav0/cam2/data");
    std::string truth = "#timestamp, x, y, z, qw, qx, qy, qz\n", images;
    for (std::size_t i = 0; i < greys.size(); ++i) {
      truth += fmt::format("{},{},0,0,1,0,0,0\n", stamp(static_cast<int>(i)), i);
      images += fmt::format("{0},{0}.png\n", stamp(static_cast<int>(i)));
      cv::imwrite((folder / "mav0/cam2/data" / (std::to_string(stamp(static_cast<int>(i))) + ".png")).string(),
                  cv::Mat(128, 256, CV_8UC1, cv::Scalar(greys[i])));
    }
    folder.write("mav0/cam2/data.csv", images);
    folder.write("mav0/state_groundtruth_estimate0/data.csv", truth);
    std::string sequence = "%YAML:1.0\nroute: made up\nvisits:\n";
    for (const auto& visit : visits) {
      sequence += fmt::format("  - {{visit: 0, id: {}, t_ns: {}, x: 1.0}}\n", visit.place, stamp(visit.second));
    }
    folder.write("sequence.yaml", sequence);
  }

  static std::int64_t stamp(int second) { return 1'700'000'000'000'000'000 + 1'000'000'000LL * second; }

  const panvo::test::TemporaryFolder folder;
};

}  // namespace panvo::evaluation
