// SPDX-License-Identifier: Apache-2.0
// Processes of a system are killed, restarted or stopped: the others continue, and data flows again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "panvo/runtime/test_domain.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "process.hpp"
#include "rendered_walk.hpp"

namespace panvo::test {
namespace {

using testing::HasSubstr;
using Words = std::vector<std::string>;

constexpr std::chrono::seconds kLimit(100);
constexpr int kFrames = 150;  // fifteen seconds at recorded speed

/// Whether no file in the folder was written within `time`.
bool is_untouched(const std::filesystem::path& folder, std::chrono::seconds time) {
  const auto since = std::filesystem::file_time_type::clock::now() - time;
  return std::ranges::none_of(std::filesystem::directory_iterator(folder), [&](const auto& entry) {
    std::error_code gone;
    return entry.last_write_time(gone) > since || gone;
  });
}

class SplitFaults : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    data_ = new TemporaryFolder;
    RenderedWalk{.frames = kFrames}.write(data_->path() / "walk");
  }
  static void TearDownTestSuite() { delete data_; }

  Words command(const Words& words) const {
    Words all = before_;
    all.push_back(PANVO_RUN);
    all.insert(all.end(), words.begin(), words.end());
    all.insert(all.end(), {"--domain", std::to_string(runtime::test_domain())});
    return all;
  }

  Words cameras(const std::string& rate = "1") const {
    return command({SYSTEMS "/stereo_split.yaml", shared_images_, "--container", "cameras", "--dataset",
                    *data_ / "walk", "--rate", rate, "--await", "/stereo/left/image_rect", "--await",
                    "/stereo/right/image_rect"});
  }
  Words odometry(const std::string& out) const {
    return command({SYSTEMS "/stereo_split.yaml", shared_images_, "--container", "odometry", "--out", folder_ / out});
  }

  std::size_t poses_in(const std::string& out) const {
    const std::string poses = read_file(folder_ / out / "odometry_binocular.tum");
    return static_cast<std::size_t>(std::count(poses.begin(), poses.end(), '\n'));
  }
  bool gets_poses(const std::string& out, std::size_t count) const {
    return eventually([&] { return poses_in(out) >= count; }, kLimit);
  }

  inline static TemporaryFolder* data_ = nullptr;
  TemporaryFolder folder_;
  Words before_;  // the words before a command, for its environment
  std::string shared_images_ = "shared_images_mb:=64";
};

/// With images sent, or in memory shared by both processes.
class SplitFaultsOfImages : public SplitFaults, public testing::WithParamInterface<const char*> {
 protected:
  SplitFaultsOfImages() { shared_images_ = GetParam(); }
};
INSTANTIATE_TEST_SUITE_P(Images, SplitFaultsOfImages, testing::Values("shared_images_mb:=0", "shared_images_mb:=64"),
                         [](const auto& which) { return which.index == 0 ? "sent" : "shared"; });

TEST_P(SplitFaultsOfImages, AKilledReaderOfImagesDoesNotDisturbTheCamerasAndItsSuccessorGetsThem) {
  Process first(odometry("first"));
  Process source(cameras());
  ASSERT_TRUE(gets_poses("first", 10)) << first.output() << source.output();
  first.signal(SIGKILL);
  first.wait();
  Process second(odometry("second"));
  EXPECT_TRUE(gets_poses("second", 10)) << second.output() << source.output();
  EXPECT_EQ(source.wait(kLimit), 0) << source.output();
  EXPECT_THAT(source.output(), HasSubstr(std::to_string(kFrames) + "/" + std::to_string(kFrames) + " frames"));
}

TEST_P(SplitFaultsOfImages, KilledCamerasLeaveTheOdometryRunningAndTheirSuccessorsAreHeard) {
  Process computing(odometry("out"));
  Process first(cameras());
  ASSERT_TRUE(gets_poses("out", 10)) << computing.output() << first.output();
  first.signal(SIGKILL);
  first.wait();
  const std::size_t before = poses_in("out");
  Process second(cameras());
  EXPECT_TRUE(gets_poses("out", before + 10)) << computing.output() << second.output();
  computing.signal(SIGINT);
  EXPECT_EQ(computing.wait(kLimit), 0) << computing.output();
}

TEST_F(SplitFaults, AKilledDiscoveryServerStopsNoDataAndWithABackupItsSuccessorBringsNewcomersTogether) {
  const std::string program = find_program("fast-discovery-server");
  if (program.empty()) GTEST_SKIP() << "fast-discovery-server is not installed (package fastdds-tools)";
  const std::string port = std::to_string(11811 + getpid() % 1000);
  const std::string env = find_program("env");
  // With a backup, the server stores its clients in its folder: they do not notice its replacement and do not register
  // again.
  const auto kept = folder_ / "server";
  std::filesystem::create_directory(kept);
  const Words serve{env, "--chdir=" + kept.string(), program, "-i", "0", "-l", "127.0.0.1", "-p", port, "-b"};
  before_ = {env, "ROS_DISCOVERY_SERVER=127.0.0.1:" + port};
  Process server(serve);
  Process first(odometry("first"));
  // Slow, so that the cameras play to the end of this test: newcomers may get nothing from a server of Fast DDS 2.9 whose backup holds
  // a client that has left since.
  Process source(cameras("0.2"));
  // The server of Fast DDS 2.9 may write to a client before it has opened a channel to it, which ends it by an assertion.
  const auto is_aborted = [&] { return server.output().find("OutputTrafficManager") != std::string::npos; };
  ASSERT_TRUE(eventually([&] { return poses_in("first") >= 10 || is_aborted(); }, kLimit))
      << first.output() << source.output() << server.output();
  if (is_aborted()) GTEST_SKIP() << "fast-discovery-server ends by an assertion of its own:\n" << server.output();
  // The server of Fast DDS 2.9 rewrites its files whenever a client joins; if killed meanwhile, it may lose all
  // clients.
  ASSERT_TRUE(eventually([&] { return is_untouched(kept, std::chrono::seconds(1)); }));
  server.signal(SIGKILL);
  server.wait();
  const std::size_t before = poses_in("first");
  EXPECT_TRUE(gets_poses("first", before + 10)) << "no data without the server\n" << first.output();
  Process successor(serve);
  const Finished newcomer =
      run({before_[0], before_[1], "ROS_DOMAIN_ID=" + std::to_string(runtime::test_domain()), PANVO_GRAPH, "topic",
           "echo", "/diagnostics", "--once", "--timeout", std::to_string(kLimit.count())},
          kLimit + std::chrono::seconds(10));
  if (newcomer.status != 0 && successor.wait(std::chrono::seconds(1)) > 0) {
    GTEST_SKIP() << "fast-discovery-server ends when it starts from its backup, as in Fast DDS 3.1:\n"
                 << successor.output();
  }
  EXPECT_EQ(newcomer.status, 0) << newcomer.output;
}

TEST_F(SplitFaults, ASubscriberOfEverythingThatStandsStillStopsNothing) {
  Process recorder(command({SYSTEMS "/record.yaml", "output:=" + (folder_ / "bag").string()}));
  // At rate 0, a frame is played after the previous one has been processed, and none is dropped.
  Process computing(command({SYSTEMS "/stereo.yaml", "--dataset", *data_ / "walk", "--rate", "0", "--out",
                             folder_ / "out", "--await", "/stereo/left/image_rect", "--await", "/odometry/binocular"}));
  ASSERT_TRUE(gets_poses("out", 10)) << computing.output();
  recorder.signal(SIGSTOP);
  EXPECT_EQ(computing.wait(kLimit), 0) << computing.output();
  recorder.signal(SIGCONT);
  EXPECT_EQ(poses_in("out"), std::size_t{kFrames}) << computing.output();
  EXPECT_THAT(computing.output(), HasSubstr("0 messages dropped"));
  recorder.signal(SIGINT);
  EXPECT_EQ(recorder.wait(kLimit), 0) << recorder.output();
}

/// Docker containers have a small /dev/shm (64 MB); writing to memory without space behind it kills the process.
class SplitFaultsOfSmallMemory : public SplitFaults, public testing::WithParamInterface<const char*> {};
INSTANTIATE_TEST_SUITE_P(Sizes, SplitFaultsOfSmallMemory, testing::Values("4k", "64k", "1m"),
                         [](const auto& size) { return std::string(size.param); });

TEST_P(SplitFaultsOfSmallMemory, ImagesAreSentWhereThereIsNoRoomToShareThemAndThatIsSaid) {
  const std::string unshare = find_program("unshare");
  if (unshare.empty() || geteuid() != 0) GTEST_SKIP() << "a separate /dev/shm needs root and the program unshare";
  before_ = {unshare,
             "--mount",
             "sh",
             "-c",
             "mount -t tmpfs -o size=" + std::string(GetParam()) + " small /dev/shm && exec \"$@\"",
             "sh"};
  const Finished split = run(
      command({SYSTEMS "/stereo_split.yaml", "--dataset", *data_ / "walk", "--rate", "4", "--out", folder_ / "out"}),
      kLimit);
  EXPECT_EQ(split.status, 0) << split.output;
  EXPECT_GE(poses_in("out"), std::size_t{kFrames} * 9 / 10) << split.output;
  EXPECT_THAT(split.output, HasSubstr("/dev/shm"));
}

TEST_F(SplitFaults, ASecondRunOfTheSameNamesIsRefusedAndTheFirstGoesOn) {
  const auto stereo = [&](const std::string& rate, const std::string& out) {
    return command({SYSTEMS "/stereo.yaml", "--dataset", *data_ / "walk", "--rate", rate, "--out", folder_ / out});
  };
  Process first(stereo("1", "first"));
  ASSERT_TRUE(gets_poses("first", 10)) << first.output();
  const Finished second = run(stereo("1", "second"), kLimit);
  EXPECT_EQ(second.status, 2) << second.output;
  EXPECT_THAT(second.output, testing::AllOf(HasSubstr("/binocular_odometry"), HasSubstr("/panvo"),
                                            HasSubstr("ROS_DOMAIN_ID"), HasSubstr("--local")));
  EXPECT_EQ(poses_in("second"), 0U);
  Words alone = stereo("0", "alone");
  alone.push_back("--local");
  EXPECT_EQ(run(alone, kLimit).status, 0);
  EXPECT_EQ(first.wait(kLimit), 0) << first.output();
  EXPECT_EQ(poses_in("first"), std::size_t{kFrames}) << first.output();
}

TEST_F(SplitFaults, AContainerThatIsKilledIsStartedAgainWhereAskedFor) {
  Process system(command({SYSTEMS "/stereo_split.yaml", "--dataset", *data_ / "walk", "--rate", "1", "--out",
                          folder_ / "out", "--respawn"}));
  ASSERT_TRUE(gets_poses("out/odometry", 10)) << system.output();
  kill(child_of(system, "odometry"), SIGKILL);
  EXPECT_TRUE(gets_poses("out/odometry_2", 10)) << system.output();
  EXPECT_EQ(system.wait(kLimit), 0) << system.output();
  EXPECT_THAT(system.output(), HasSubstr("restarting container odometry"));
  // The results of both processes are kept separately.
  EXPECT_GE(poses_in("out"), 10U);
  EXPECT_FALSE(read_file(folder_ / "out" / "odometry_2_odometry_binocular.tum").empty());
}

TEST_F(SplitFaults, AContainerIsStartedAgainWhereItsSystemFileSaysSo) {
  std::ofstream(folder_ / "again.yaml") << R"(launch:
- node_container:
    name: both
    respawn: true
    respawn_delay: 0.1
    composable_node:
    - {pkg: panvo_stereo_rectifier, plugin: StereoRectifierComponent, name: stereo_rectifier}
    - {pkg: panvo_binocular_odometry, plugin: BinocularOdometryComponent, name: binocular_odometry}
)";
  Process system(command({folder_ / "again.yaml", "--container", "both", "--dataset", *data_ / "walk", "--rate", "1",
                          "--out", folder_ / "out"}));
  ASSERT_TRUE(gets_poses("out/both", 10)) << system.output();
  kill(child_of(system, "both"), SIGKILL);
  EXPECT_TRUE(gets_poses("out/both_2", 10)) << system.output();
  system.signal(SIGINT);
  EXPECT_EQ(system.wait(kLimit), 128 + SIGINT) << system.output();
  EXPECT_THAT(read_file(folder_ / "out" / "summary.json"), HasSubstr("\"interrupted\": true"));
}

TEST_F(SplitFaults, ALoneContainerIsStartedAgainToo) {
  Process system(command({SYSTEMS "/stereo.yaml", "--dataset", *data_ / "walk", "--rate", "1", "--out", folder_ / "out",
                          "--respawn", "--respawn-delay", "0.1"}));
  ASSERT_TRUE(gets_poses("out/panvo", 10)) << system.output();
  kill(child_of(system, "panvo"), SIGKILL);
  EXPECT_TRUE(gets_poses("out/panvo_2", 10)) << system.output();
  system.signal(SIGINT);
  EXPECT_EQ(system.wait(kLimit), 128 + SIGINT) << system.output();
  EXPECT_THAT(read_file(folder_ / "out" / "summary.json"), HasSubstr("\"interrupted\": true"));
}

TEST_F(SplitFaults, WithoutTheProcessOfPlacesTheOdometryGoesOnAndTheEndSaysWhatWasLost) {
  Process system(command(
      {SYSTEMS "/enhanced_vo_split.yaml", "--dataset", *data_ / "walk", "--rate", "1", "--out", folder_ / "out"}));
  ASSERT_TRUE(gets_poses("out/motion", 10)) << system.output();
  const pid_t places = child_of(system, "places");
  ASSERT_NE(places, 0) << system.output();
  kill(places, SIGKILL);
  EXPECT_EQ(system.wait(kLimit), 1) << system.output();
  EXPECT_THAT(system.output(), HasSubstr("container places is lost"));
  EXPECT_THAT(system.output(), HasSubstr(std::to_string(kFrames) + "/" + std::to_string(kFrames) + " frames"));
  EXPECT_GE(poses_in("out"), std::size_t{kFrames - 10}) << system.output();
  EXPECT_FALSE(read_file(folder_ / "out" / "odometry_enhanced.tum").empty());
}

TEST_F(SplitFaults, TheProcessOfPlacesIsStartedAgainWhereAskedFor) {
  Process system(command({SYSTEMS "/enhanced_vo_split.yaml", "--dataset", *data_ / "walk", "--rate", "1", "--out",
                          folder_ / "out", "--respawn", "--respawn-delay", "0.1"}));
  ASSERT_TRUE(gets_poses("out/motion", 10)) << system.output();
  const pid_t places = child_of(system, "places");
  ASSERT_NE(places, 0) << system.output();
  kill(places, SIGKILL);
  EXPECT_TRUE(eventually([&] {
    const pid_t successor = child_of(system, "places");
    return successor != 0 && successor != places;
  })) << system.output();
  EXPECT_EQ(system.wait(kLimit), 0) << system.output();
  EXPECT_THAT(system.output(), HasSubstr("restarting container places"));
}

}  // namespace
}  // namespace panvo::test
