// SPDX-License-Identifier: Apache-2.0
// Two simulated GigE cameras show a rendered walk; the odometry is compared with that from the same images in files.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <vector>

#include "panvo/test/temporary_folder.hpp"
#include "process.hpp"
#include "rendered_walk.hpp"
#include "walk_paths.hpp"

namespace panvo::test {
namespace {

/// Command that runs `command` in a separate network namespace with 127.0.0.1 and 127.0.0.2.
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
  if (find_program("unshare").empty() || find_program("ip").empty()) GTEST_SKIP() << "unshare or ip is not installed";
  if (const Finished tried = run(in_own_network("true")); tried.status != 0)
    GTEST_SKIP() << "cannot create a network namespace: " << tried.output;

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

  // Simulated cameras take images whenever they are scheduled, so images within half a period form a pair.
  // The shell ends after panvo, and the simulator with the shell.
  const std::string simulator = std::string(GIGE_SIMULATOR) + " --pictures " + walk +
                                " --pictures-hz 5 GVL@127.0.0.1 GVR@127.0.0.2 >/dev/null & simulator=$!; ";
  const std::string panvo =
      std::string(PANVO_RUN) + " " SYSTEMS "/gige_stereo.yaml left:=GVL right:=GVR rig:=" + folder.path().string() +
      " width:=320 height:=240 rate:=5.0 --set aravis_camera.pair_tolerance_ms=90.0 --out " + live +
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

  const auto seen = read_tum(path);
  const double max_m = max_distance(seen, expected);
  const auto came =
      std::count_if(expected.begin(), expected.end(), [&](const auto& point) { return distance(point, seen) < 0.02; });
  std::printf("%zu poses from cameras, %zu from files, %td of them matched; largest difference of the paths %.1f mm\n",
              seen.size(), expected.size(), came, 1e3 * max_m);
  EXPECT_LT(max_m, 0.02);
  EXPECT_EQ(came, std::ssize(expected)) << cameras.output();
}

}  // namespace
}  // namespace panvo::test
