// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

namespace panvo::evaluation {

/// A recording of a drive along x with one panorama per second and metre. Images are uniform grey; the level identifies
/// the place.
class PlainRecording {
 public:
  struct Visit {
    int place;
    int second;
  };

  PlainRecording(const std::string& name, const std::vector<int>& greys, const std::vector<Visit>& visits)
      : folder(std::filesystem::temp_directory_path() / ("panvo_places_" + name)) {
    namespace fs = std::filesystem;
    fs::remove_all(folder);
    fs::create_directories(folder / "mav0/cam2/data");
    fs::create_directories(folder / "mav0/state_groundtruth_estimate0");
    std::ofstream(folder / "mav0/cam2/sensor.yaml") << "%YAML:1.0\nT_BS:\n  cols: 4\n  rows: 4\n"
                                                       "  data: [0, 0, 1, 0.5, -1, 0, 0, 0, 0, -1, 0, 2, 0, 0, 0, 1]\n";
    std::ofstream truth(folder / "mav0/state_groundtruth_estimate0/data.csv");
    truth << "#timestamp, x, y, z, qw, qx, qy, qz\n";
    for (std::size_t i = 0; i < greys.size(); ++i) {
      truth << fmt::format("{},{},0,0,1,0,0,0\n", stamp(static_cast<int>(i)), i);
      cv::imwrite((folder / "mav0/cam2/data" / (std::to_string(stamp(static_cast<int>(i))) + ".png")).string(),
                  cv::Mat(32, 64, CV_8UC1, cv::Scalar(greys[i])));
    }
    std::ofstream sequence(folder / "sequence.yaml");
    sequence << "%YAML:1.0\nroute: made up\nvisits:\n";
    for (const auto& visit : visits) {
      sequence << fmt::format("  - {{visit: 0, id: {}, t_ns: {}, x: 1.0}}\n", visit.place, stamp(visit.second));
    }
  }
  ~PlainRecording() {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }
  PlainRecording(const PlainRecording&) = delete;
  PlainRecording& operator=(const PlainRecording&) = delete;

  static std::int64_t stamp(int second) { return 1'700'000'000'000'000'000 + 1'000'000'000LL * second; }

  const std::filesystem::path folder;
};

}  // namespace panvo::evaluation
