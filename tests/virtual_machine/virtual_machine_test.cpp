// SPDX-License-Identifier: Apache-2.0
// The V4L2 driver on cameras of another kernel: each test starts Debian's kernel in QEMU and runs many scenarios there.
// Skipped with a reason if QEMU, the kernel or a tool to prepare it is missing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "panvo/test/temporary_folder.hpp"
#include "process.hpp"
#include "rendered_walk.hpp"
#include "walk_paths.hpp"

namespace panvo::test {
namespace {

class VirtualMachine : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::string(SANITIZER).empty())
      GTEST_SKIP() << "an emulated processor is too slow for the sanitizer " << SANITIZER;
    const Finished checked = run({PYTHON, "-B", VIRTUAL_MACHINE, "check"}, std::chrono::seconds(290));
    if (checked.status != 0) GTEST_SKIP() << "no virtual machine available: " << checked.output;
  }

  /// Runs a program in the virtual machine, which is stopped after `limit`.
  Finished inside(const std::vector<std::string>& modules, const std::vector<std::string>& words,
                  std::chrono::seconds limit) {
    std::vector<std::string> command{PYTHON, "-B", VIRTUAL_MACHINE, "run", "--limit", std::to_string(limit.count())};
    for (const auto& module : modules) command.insert(command.end(), {"--module", module});
    command.push_back(exchange_.path().string());
    if (const char* plugins = std::getenv("PANVO_PLUGIN_PATH"))
      command.insert(command.end(), {"/usr/bin/env", std::string("PANVO_PLUGIN_PATH=") + plugins});
    command.insert(command.end(), words.begin(), words.end());
    return run(command, limit + std::chrono::seconds(20));
  }

  TemporaryFolder exchange_;
};

/// The poses measured from images. A delayed camera repeats an image; such a pose is extrapolated, not measured.
std::vector<Position> measured(const std::vector<Position>& poses, const std::string& quality_file) {
  std::ifstream file(quality_file);
  std::vector<Position> shown;
  std::string line;
  std::getline(file, line);  // column names: stamp_ns,reliable,...
  for (const auto& pose : poses) {
    EXPECT_TRUE(std::getline(file, line)) << quality_file << " has fewer lines than the trajectory has poses";
    if (line.find(",1,") == line.find(',')) shown.push_back(pose);
  }
  return shown;
}

TEST_F(VirtualMachine, DriverHoldsOnTheKernelsSimulatedCameras) {
  const Finished finished = inside({"vivid=n_devs=2;node_types=0x1,0x1;num_inputs=1,1;input_types=0x0,0x0"},
                                   {VIVID_SCENARIOS}, std::chrono::seconds(250));
  EXPECT_EQ(finished.status, 0) << finished.output;
}

TEST_F(VirtualMachine, DriverHoldsOnUsbCameras) {
  const Finished finished = inside({"vivid=none"}, {USB_SCENARIOS}, std::chrono::seconds(250));
  EXPECT_EQ(finished.status, 0) << finished.output;
}

TEST_F(VirtualMachine, UsbCameraGivesThePathThatTheSamePicturesGiveFromFiles) {
  const std::string walk = exchange_ / "walk", direct = exchange_ / "direct";
  RenderedWalk{.frames = 30}.write(walk);
  write_calibration(exchange_ / "left.yaml", 0.0);
  write_calibration(exchange_ / "right.yaml", -240 * 0.2);
  const Finished played = run({PANVO_RUN, SYSTEMS "/stereo.yaml", "--dataset", walk, "--replay", "--out", direct});
  ASSERT_EQ(played.status, 0) << played.output;
  const auto expected = read_tum(direct + "/odometry_binocular.tum");
  ASSERT_EQ(expected.size(), 30u);
  ASSERT_GT(expected.back().x, 2.5) << "29 steps of 0.1 m";

  const Finished finished = inside({"vivid=none"}, {WALK_SCENARIO}, std::chrono::seconds(200));
  ASSERT_EQ(finished.status, 0) << finished.output;
  const std::string through = exchange_ / "through";
  const Finished replayed =
      run({PANVO_RUN, SYSTEMS "/stereo.yaml", "--bag", exchange_ / "bag", "--replay", "--out", through});
  ASSERT_EQ(replayed.status, 0) << replayed.output;
  const auto seen = measured(read_tum(through + "/odometry_binocular.tum"), through + "/quality.csv");
  constexpr double kSame_m = 0.01;
  const double max_m = max_distance(seen, expected);
  const auto missing = std::count_if(expected.begin(), expected.end(),
                                     [&](const Position& step) { return distance(step, seen) > kSame_m; });
  std::printf(
      "%zu poses from the USB camera, %zu from files; largest difference of the paths %.1f mm; %td steps not seen\n",
      seen.size(), expected.size(), 1e3 * max_m, missing);
  EXPECT_LT(max_m, kSame_m) << finished.output;
  EXPECT_LE(missing, 6) << "steps whose images a stalled machine loses\n" << finished.output;
  EXPECT_LT(distance(expected.back(), seen), kSame_m) << "end of the walk";
}

}  // namespace
}  // namespace panvo::test
