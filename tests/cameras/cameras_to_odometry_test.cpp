// SPDX-License-Identifier: Apache-2.0
// From cameras to odometry: two simulated GigE cameras show a rendered walk; what comes of it is compared with the same pictures played from files.
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <sstream>
#include <vector>

#include "process.hpp"
#include "rendered_walk.hpp"

namespace panvo::test {
namespace {

struct Position {
  double x, y, z;
};

std::vector<Position> read_tum(const std::string& file) {
  std::vector<Position> positions;
  std::istringstream lines(read_file(file));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string stamp;
    Position position{};
    if (words >> stamp >> position.x >> position.y >> position.z) positions.push_back(position);
  }
  return positions;
}

double distance(const Position& a, const Position& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

/// The rendered walk's camera as a camera_info file; `tx` is the last number of the projection's first row.
void write_calibration(const std::string& file, double tx) {
  std::ofstream(file) << "image_width: 320\nimage_height: 240\ncamera_name: rendered\n"
                         "camera_matrix: {rows: 3, cols: 3, data: [240, 0, 160, 0, 240, 120, 0, 0, 1]}\n"
                         "distortion_model: plumb_bob\n"
                         "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n"
                         "rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}\n"
                         "projection_matrix: {rows: 3, cols: 4, data: [240, 0, 160, "
                      << tx << ", 0, 240, 120, 0, 0, 0, 1, 0]}\n";
}

/// Runs a command line in a network of its own with 127.0.0.1 and 127.0.0.2.
std::vector<std::string> in_own_network(const std::string& command) {
  return {find_program("unshare"),
          "--user",
          "--map-root-user",
          "--net",
          "sh",
          "-c",
          "ip link set lo up && ip address add 127.0.0.2/8 dev lo; " + command};
}

TEST(CamerasToOdometry, GiveThePathThatTheSamePicturesGiveFromFiles) {
  if (find_program("unshare").empty() || find_program("ip").empty()) GTEST_SKIP() << "there is no unshare or no ip";
  if (const Finished tried = run(in_own_network("true")); tried.status != 0)
    GTEST_SKIP() << "no network namespace can be made here: " << tried.output;

  const TemporaryFolder folder;
  const std::string walk = folder / "walk", direct = folder / "direct", live = folder / "live";
  RenderedWalk{.frames = 30}.write(walk);
  write_calibration(folder / "left.yaml", 0.0);
  write_calibration(folder / "right.yaml", -240 * 0.2);

  const Finished played = run({PANVO_RUN, SYSTEMS "/stereo.yaml", "--dataset", walk, "--replay", "--out", direct});
  ASSERT_EQ(played.status, 0) << played.output;
  const auto expected = read_tum(direct + "/odometry_binocular.tum");
  ASSERT_EQ(expected.size(), 30u);
  ASSERT_GT(expected.back().x, 2.5) << "29 steps of 0.1 m";

  // The simulator ends with the shell, the shell when panvo has ended.
  const std::string simulator = std::string(GIGE_SIMULATOR) + " --pictures " + walk +
                                " --pictures-hz 5 GVL@127.0.0.1 GVR@127.0.0.2 >/dev/null & simulator=$!; ";
  const std::string panvo =
      std::string(PANVO_RUN) + " " SYSTEMS "/gige_stereo.yaml left:=GVL right:=GVR rig:=" + folder.path().string() +
      " width:=320 height:=240 rate:=5.0 --out " + live +
      " & panvo=$!; trap 'kill -INT $panvo' TERM; wait $panvo; wait $panvo; kill $simulator; wait";
  Process cameras(in_own_network(simulator + panvo));
  const std::string path = live + "/odometry_binocular.tum";
  const bool is_there = eventually(
      [&] {
        const auto positions = std::filesystem::exists(path) ? read_tum(path) : std::vector<Position>{};
        return !positions.empty() && distance(positions.back(), expected.back()) < 0.02;
      },
      std::chrono::seconds(120));
  cameras.signal(SIGTERM);
  cameras.wait(std::chrono::seconds(30));
  ASSERT_TRUE(is_there) << cameras.output() << read_file(path);

  double largest_m = 0.0;
  const auto seen = read_tum(path);
  for (const auto& position : expected) {
    double nearest_m = 1e9;
    for (const auto& other : seen) nearest_m = std::min(nearest_m, distance(position, other));
    largest_m = std::max(largest_m, nearest_m);
  }
  std::printf("from cameras %zu poses, from files %zu; the paths differ by at most %.1f mm\n", seen.size(),
              expected.size(), 1e3 * largest_m);
  EXPECT_LT(largest_m, 0.02);
}

}  // namespace
}  // namespace panvo::test
