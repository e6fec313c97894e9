// SPDX-License-Identifier: Apache-2.0
// A system on two hosts gives the same odometry as one container: on one subnet, across a router, and with packet loss.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <iterator>

#include "panvo/test/temporary_folder.hpp"
#include "process.hpp"
#include "rendered_walk.hpp"
#include "tum_positions.hpp"
#include "two_hosts.hpp"

namespace panvo::test {
namespace {

using Words = std::vector<std::string>;

constexpr std::chrono::seconds kLimit(100);
// Newer images replace those for which a reader is too slow. Three frames per second, so that only the network matters,
// even on a machine that stalls for hundreds of milliseconds.
constexpr auto kSlowly = "0.3";
// Both sides must have discovered each other before the first image is sent.
const Words kAwaitReaders{"--await", "/stereo/left/image_rect", "--await", "/stereo/right/image_rect",
                          "--await", "/stereo/left/camera_info"};

class AcrossHosts : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto reason = TwoHosts::why_not(); !reason.empty()) GTEST_SKIP() << reason;
    RenderedWalk{.frames = 30}.write(folder_ / "walk");
    const Finished replayed =
        run({PANVO_RUN, CONFIG "/systems/stereo.yaml", "--dataset", walk_, "--out", folder_ / "one", "--replay"});
    ASSERT_EQ(replayed.status, 0) << replayed.output;
  }

  /// Runs stereo_split with cameras on host a and odometry on host b. `before`: command prefix that sets the
  /// environment.
  void run_split(const TwoHosts& hosts, const Words& before, const Words& more) {
    const auto words = [&](const Words& own) {
      Words all = before;
      all.insert(all.end(), {PANVO_RUN, CONFIG "/systems/stereo_split.yaml"});
      all.insert(all.end(), more.begin(), more.end());
      all.insert(all.end(), own.begin(), own.end());
      return all;
    };
    Process odometry(hosts.on_b(words({"--container", "odometry", "--out", folder_ / "split"})));
    Words camera_words =
        words({"--container", "cameras", "--dataset", walk_, "--rate", kSlowly, "--out", folder_ / "cameras"});
    camera_words.insert(camera_words.end(), kAwaitReaders.begin(), kAwaitReaders.end());
    Process cameras(hosts.on_a(camera_words));
    EXPECT_EQ(cameras.wait(kLimit), 0) << cameras.output() << odometry.output();
    odometry.signal(SIGINT);
    EXPECT_EQ(odometry.wait(kLimit), 0) << odometry.output();
    said_ = cameras.output() + odometry.output();
  }

  /// As for two processes in tests/recorded_topics: one or two frames may be lost, which changes the path by less than
  /// 5 cm. Some of the first `late` frames may be missing, because a writer does not know when a reader has discovered
  /// it; the path then starts later.
  void expect_the_odometry_of_one_container(std::size_t late = 3) {
    const auto expected = read_tum(folder_ / "one" / "odometry_binocular.tum");
    const auto got = read_tum(folder_ / "split" / "odometry_binocular.tum");
    ASSERT_EQ(expected.size(), 30U);
    EXPECT_GE(got.size(), (expected.size() - late) * 9 / 10) << said_;
    ASSERT_FALSE(got.empty());
    ASSERT_TRUE(expected.contains(got.begin()->first)) << got.begin()->first;
    const auto first = expected.find(got.begin()->first);
    EXPECT_LE(std::distance(expected.begin(), first), static_cast<std::ptrdiff_t>(late)) << said_;
    for (const auto& [stamp, position] : got) {
      ASSERT_TRUE(expected.contains(stamp)) << stamp;
      const Position& wanted = expected.at(stamp);
      const Position& origin = first->second;
      EXPECT_LT(distance(position, {wanted.x - origin.x, wanted.y - origin.y, wanted.z - origin.z}), 0.05) << stamp;
    }
  }

  TemporaryFolder folder_;
  const std::string walk_ = folder_ / "walk";
  std::string said_;
};

TEST_F(AcrossHosts, OnOneSubnetGiveTheOdometryOfOneContainerWithoutAnySetting) {
  const TwoHosts hosts({});
  run_split(hosts, {}, {});
  expect_the_odometry_of_one_container();
}

TEST_F(AcrossHosts, ThroughARouterGiveTheOdometryOfOneContainerByADiscoveryServer) {
  const std::string server_program = find_program("fast-discovery-server");
  if (server_program.empty()) GTEST_SKIP() << "fast-discovery-server is not installed (package fastdds-tools)";
  const TwoHosts hosts({.routed = true});
  const Process server(hosts.on_a({server_program, "-i", "0", "-l", hosts.address_of_a(), "-p", "11811"}));
  run_split(hosts, {find_program("env"), "ROS_DISCOVERY_SERVER=" + hosts.address_of_a() + ":11811"}, {});
  expect_the_odometry_of_one_container();
}

TEST_F(AcrossHosts, ThatLoseOnePacketOfAHundredGiveTheOdometryOfOneContainer) {
  TwoHosts hosts({.loss = 0.01});
  run_split(hosts, {}, {"--dds-profiles", CONFIG "/dds/lossy_network.xml"});
  // A lost announcement of a topic is repeated after about a second.
  expect_the_odometry_of_one_container(6);
  const std::string losses = hosts.say_losses();
  RecordProperty("losses", losses);
  EXPECT_THAT(losses, testing::Not(testing::HasSubstr("lost 0 of")));
}

TEST_F(AcrossHosts, ThatLoseOnePacketOfAHundredHaveEveryPoseOnBoth) {
  TwoHosts hosts({.loss = 0.01});
  const auto record = [&](const std::string& bag) -> Words {
    return {PANVO_RUN, CONFIG "/systems/record.yaml", "output:=" + (folder_ / bag).string(),
            "topics:=/odometry/binocular", "namespace:=" + bag};
  };
  Process near(hosts.on_a(record("near"))), far(hosts.on_b(record("far")));
  // At low rate: if the announcement of the topic is lost, a recorder receives the next one after a second, and then
  // the missed ones among the newest ten poses, which cover two seconds.
  const Finished odometry = run(hosts.on_a({PANVO_RUN, CONFIG "/systems/stereo.yaml", "--dataset", walk_, "--rate",
                                            "0.4", "--await", "/odometry/binocular:2"}),
                                kLimit);
  EXPECT_EQ(odometry.status, 0) << odometry.output;
  for (Process* recorder : {&near, &far}) {
    recorder->signal(SIGINT);
    EXPECT_EQ(recorder->wait(kLimit), 0) << recorder->output();
    EXPECT_THAT(recorder->output(), testing::HasSubstr("recorded 30 messages"));
  }
  const Finished compared = run({PANVO_BAG, "diff", folder_ / "near", folder_ / "far"});
  EXPECT_EQ(compared.status, 0) << compared.output;
  EXPECT_THAT(hosts.say_losses(), testing::Not(testing::HasSubstr("lost 0 of")));
}

TEST_F(AcrossHosts, MayLookAndChangeNothingWhileThisHostMaySteer) {
  const TwoHosts hosts({});
  Process system(hosts.on_a({PANVO_RUN, CONFIG "/systems/stereo.yaml"}));
  const auto graph = [](const Words& words) {
    Words all{PANVO_GRAPH};
    all.insert(all.end(), words.begin(), words.end());
    all.insert(all.end(), {"--timeout", "30"});
    return all;
  };
  ASSERT_TRUE(eventually([&] {
    return run(hosts.on_b(graph({"component", "running"})), kLimit).output.find("/stereo_rectifier") !=
           std::string::npos;
  })) << system.output();
  const Finished refused = run(hosts.on_b(graph({"component", "unload", "/panvo", "1"})), kLimit);
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.output, testing::HasSubstr("services: steer"));
  const Finished done = run(hosts.on_a(graph({"component", "unload", "/panvo", "1"})), kLimit);
  EXPECT_EQ(done.status, 0) << done.output;
  EXPECT_THAT(system.output(), testing::HasSubstr("a request from another host was refused"));
}

}  // namespace
}  // namespace panvo::test
