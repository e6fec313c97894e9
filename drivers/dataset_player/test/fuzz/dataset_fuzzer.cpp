// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: the first byte selects two files of a data set, the rest is their text, separated by a NUL. They must
// be rejected with a DatasetError, or make a recording whose poses and stamps fit into messages.
#include <array>
#include <cstdlib>
#include <string>

#include "panvo/dataset_player/dataset.hpp"
#include "panvo/dataset_player/passes.hpp"
#include "panvo/interfaces/stamp_range.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace {

using namespace panvo::dataset_player;

constexpr std::array<std::array<const char*, 2>, 8> kPairs{{{"calib.txt", "poses.txt"},
                                                            {"times.txt", "poses.txt"},
                                                            {"mav0/cam0/data.csv", "mav0/cam1/data.csv"},
                                                            {"mav0/cam0/sensor.yaml", "mav0/cam1/sensor.yaml"},
                                                            {"mav0/cam2/data.csv", "mav0/cam2/sensor.yaml"},
                                                            {"mav0/imu0/data.csv", "mav0/imu0/sensor.yaml"},
                                                            {"mav0/vicon0/data.csv", "mav0/vicon0/sensor.yaml"},
                                                            {"left.yaml", "right.yaml"}}};

/// A data set for each pair, in shared memory, to avoid disk writes.
struct Datasets {
  panvo::test::TemporaryFolder folder{"/dev/shm"};

  Datasets() {
    for (std::size_t kind = 0; kind < kPairs.size(); ++kind) {
      const auto write = [&](const std::string& name, const std::string& text) {
        folder.write(std::to_string(kind) + "/" + name, text);
      };
      const std::string image = "P5 2 2 255\n    ";
      if (kind == 7) {
        write("left/0.pgm", image);
        write("right/0.pgm", image);
      } else if (kind < 2) {
        for (const char* name : {"image_0/0.pgm", "image_0/1.pgm", "image_1/0.pgm", "image_1/1.pgm"})
          write(name, image);
        write("calib.txt", "P0: 2 0 1 0 0 2 1 0 0 0 1 0\nP1: 2 0 1 -1 0 2 1 0 0 0 1 0\n");
      } else {
        for (const std::string camera : {"0", "1", "2"}) {
          write("mav0/cam" + camera + "/data/1.pgm", image);
          if (camera == "2") continue;
          write("mav0/cam" + camera + "/data.csv", "1,1.pgm\n2000000000,1.pgm\n");
          write("mav0/cam" + camera + "/sensor.yaml",
                "T_BS: [0, 0, 1, 0, -1, 0, 0, -" + camera + ", 0, -1, 0, 0, 0, 0, 0, 1]\n" +
                    "resolution: [2, 2]\nintrinsics: [2, 2, 1, 1]\ndistortion_coefficients: [0, 0, 0, 0]\n");
        }
      }
    }
  }
};

void expect_place(const Eigen::Isometry3d& pose) {
  if (!(pose.matrix().cwiseAbs().maxCoeff() <= 1e9)) std::abort();  // nor NaN
}

void play(const Dataset& dataset) {
  if (dataset.stereo) expect_place(dataset.stereo->base_from_left);
  if (dataset.stereo) expect_place(dataset.stereo->base_from_right());
  if (dataset.panorama) expect_place(dataset.panorama->base_from_panorama);
  for (const auto& truth : dataset.ground_truth) expect_place(truth.map_from_base);
  const Passes passes(timeline(dataset, {}), 4);
  std::int64_t before_ns = 0;
  for (std::uint64_t i = 0; i < passes.size(); ++i) {
    const auto stamp_ns = passes[i].stamp_ns;
    if (stamp_ns < before_ns || stamp_ns >= panvo::interfaces::kEndOfStamps_ns) std::abort();
    before_ns = stamp_ns;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  static const Datasets datasets;
  const std::size_t kind = data[0] % kPairs.size();
  std::string text(reinterpret_cast<const char*>(data + 1), size - 1);
  const auto root = datasets.folder / std::to_string(kind);
  for (const char* file : kPairs[kind]) {
    const auto end = text.find('\0');
    if (text.empty()) {
      std::filesystem::remove(root / file);
    } else {
      datasets.folder.write(root / file, text.substr(0, end));
    }
    text.erase(0, end == std::string::npos ? end : end + 1);
  }
  try {
    play(open_dataset(root));
  } catch (const DatasetError&) {
  }
  return 0;
}
