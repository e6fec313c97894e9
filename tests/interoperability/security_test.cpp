// SPDX-License-Identifier: Apache-2.0
// Keys created by `panvo secure`: only processes with keys of the same keystore can read and write.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "panvo/runtime/test_domain.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "process.hpp"
#include "rendered_walk.hpp"

namespace panvo::test {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using Words = std::vector<std::string>;

constexpr std::chrono::seconds kLimit(100);
constexpr const char* kTopic = "/odometry/binocular";

class Security : public testing::Test {
 protected:
  void SetUp() override {
    if (find_program("openssl").empty()) GTEST_SKIP() << "openssl is not installed (package openssl)";
    make_keystore("keys");
    RenderedWalk{.frames = 20}.write(folder_ / "walk");
  }

  void make_keystore(const std::string& name) const {
    const Finished made = run({PANVO, "secure", folder_ / name, "/talker", "/listener"});
    ASSERT_EQ(made.status, 0) << made.output;
  }

  /// One enclave per container of stereo_split, with minimal permissions.
  void make_system_keystore(const std::string& name) const {
    const Finished made = run({PANVO, "secure", folder_ / name, "--system", CONFIG "/systems/stereo_split.yaml",
                               "--dataset", folder_ / "walk"});
    ASSERT_EQ(made.status, 0) << made.output;
  }

  static Words joined(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  Words keys(const std::string& keystore, const std::string& enclave) const {
    return {"--secure", folder_ / keystore, "--enclave", enclave};
  }

  /// Command that records received odometry into the bag `name`.
  Words listener(const std::string& name, const Words& with_keys) const {
    return joined({PANVO_RUN, CONFIG "/systems/record.yaml", "output:=" + (folder_ / name).string(),
                   std::string("topics:=") + kTopic, "namespace:=/" + name, "--domain", domain_},
                  with_keys);
  }

  /// Command that publishes twenty poses once a reader is connected.
  Words talker(const Words& with_keys) const {
    return joined({PANVO_RUN, CONFIG "/systems/stereo.yaml", "--dataset", folder_ / "walk", "--rate", "1", "--await",
                   kTopic, "--domain", domain_},
                  with_keys);
  }

  /// Checks whether the listener received anything. The count does not matter: the first messages may be lost during
  /// the key exchange.
  static void expect_heard(Process& listener, bool is_heard) {
    listener.signal(SIGINT);
    EXPECT_EQ(listener.wait(kLimit), is_heard ? 0 : 1) << listener.output();  // 1: nothing recorded
    EXPECT_THAT(listener.output(), ContainsRegex(is_heard ? "recorded [1-9][0-9]* messages" : "recorded 0 messages"));
  }

  TemporaryFolder folder_;
  const std::string domain_ = std::to_string(runtime::test_domain());
};

TEST_F(Security, OnlyWhoHasKeysOfTheSameKeystoreReadsWhatIsWrittenWithKeys) {
  make_keystore("others");
  Process with_keys(listener("with_keys", keys("keys", "/listener")));
  Process without(listener("without", {}));
  Process with_others(listener("with_others", keys("others", "/listener")));
  const Finished talked = run(talker(keys("keys", "/talker")), kLimit);
  EXPECT_EQ(talked.status, 0) << talked.output;
  expect_heard(with_keys, true);
  expect_heard(without, false);
  expect_heard(with_others, false);
}

TEST_F(Security, WhatIsWrittenWithoutKeysIsReadOnlyByWhoHasNone) {
  Process with_keys(listener("with_keys", keys("keys", "/listener")));
  Process without(listener("without", {}));
  const Finished talked = run(talker({}), kLimit);
  EXPECT_EQ(talked.status, 0) << talked.output;
  expect_heard(without, true);
  expect_heard(with_keys, false);
}

/// Results of a whole system in one process on the walk. Its own readers and writers must not connect over DDS, which
/// would deliver every message twice.
struct WholeRun {
  std::string poses, qualities, output;
  int status = -1;
};

WholeRun run_whole(const std::filesystem::path& out, Words words) {
  words.insert(words.end(), {"--out", out.string()});
  const Finished finished = run(words, kLimit);
  return {read_file(out / "odometry_binocular.tum"), read_file(out / "odometry_binocular_covariance.csv"),
          finished.output, finished.status};
}

TEST_F(Security, AWholeSystemWithKeysGivesWhatItGivesWithout) {
  const Words system{PANVO_RUN, CONFIG "/systems/stereo.yaml", "--dataset", folder_ / "walk", "--rate", "1", "--domain",
                     domain_};
  // A listener makes the system write to DDS, which would also reach the system's own readers if they were not
  // excluded.
  Process plain_listener(listener("plain_bag", {}));
  const WholeRun plain = run_whole(folder_ / "plain", joined(system, {"--await", kTopic}));
  expect_heard(plain_listener, true);
  Process listener_with_keys(listener("secure_bag", keys("keys", "/listener")));
  const WholeRun secure =
      run_whole(folder_ / "secure", joined(joined(system, {"--await", kTopic}), keys("keys", "/talker")));
  expect_heard(listener_with_keys, true);
  ASSERT_EQ(plain.status, 0) << plain.output;
  EXPECT_EQ(secure.status, 0) << secure.output;
  EXPECT_THAT(plain.output, HasSubstr("20 poses out"));
  EXPECT_THAT(secure.output,
              HasSubstr("20 stereo frames in, 20 poses out, 0 of them without a measured motion, 0 messages dropped"));
  EXPECT_EQ(secure.poses, plain.poses);
  EXPECT_EQ(secure.qualities, plain.qualities);
}

TEST_F(Security, ASplitSystemWithKeysComputesItsOdometry) {
  const Finished split = run(joined({PANVO_RUN, CONFIG "/systems/stereo_split.yaml", "--dataset", folder_ / "walk",
                                     "--rate", "1", "--domain", domain_, "--out", folder_ / "out"},
                                    keys("keys", "/talker")),
                             kLimit);
  EXPECT_EQ(split.status, 0) << split.output;
  const std::string poses = read_file(folder_ / "out" / "odometry_binocular.tum");
  EXPECT_GE(std::count(poses.begin(), poses.end(), '\n'), 18) << split.output;
}

TEST_F(Security, ASystemWithNoMoreRightsThanItNeedsComputesItsOdometry) {
  make_system_keystore("least");
  const Finished split = run(joined({PANVO_RUN, CONFIG "/systems/stereo_split.yaml", "--dataset", folder_ / "walk",
                                     "--rate", "1", "--domain", domain_, "--out", folder_ / "out"},
                                    {"--secure", folder_ / "least"}),
                             kLimit);
  EXPECT_EQ(split.status, 0) << split.output;
  const std::string poses = read_file(folder_ / "out" / "odometry_binocular.tum");
  EXPECT_GE(std::count(poses.begin(), poses.end(), '\n'), 18) << split.output;
}

TEST_F(Security, AnEnclaveMayNotPublishWhatItsContainerDoesNot) {
  make_system_keystore("least");
  const std::string rights = folder_.read("least/enclaves/stereo_split/cameras/permissions.xml");
  EXPECT_THAT(rights, AllOf(HasSubstr("<topic>rt/stereo/left/image_rect</topic>"),
                            HasSubstr("<topic>rq/stereo_rectifier/*Request</topic>"),
                            testing::Not(HasSubstr("rt/odometry")), testing::Not(HasSubstr("<topic>*</topic>"))));
  // The container and the odometry of stereo.yaml have other names than this enclave permits.
  const Finished refused =
      run(joined({PANVO_RUN, CONFIG "/systems/stereo.yaml", "--dataset", folder_ / "walk", "--domain", domain_},
                 keys("least", "/stereo_split/cameras")),
          kLimit);
  EXPECT_EQ(refused.status, 2) << refused.output;
  EXPECT_THAT(refused.output, HasSubstr("service /panvo/_container/load_node"));
}

TEST_F(Security, WhoseKeysWereRevokedIsNotHeardAndOthersAre) {
  std::filesystem::copy(folder_ / "keys", folder_ / "stolen",
                        std::filesystem::copy_options::recursive | std::filesystem::copy_options::copy_symlinks);
  const Finished revoked = run({PANVO, "secure", "revoke", folder_ / "keys", "/talker"});
  ASSERT_EQ(revoked.status, 0) << revoked.output;
  {
    Process before(listener("before", keys("stolen", "/listener")));  // has the old files, without the revocation
    Process after(listener("after", keys("keys", "/listener")));
    const Finished talked = run(talker(keys("stolen", "/talker")), kLimit);
    EXPECT_EQ(talked.status, 0) << talked.output;
    expect_heard(before, true);
    expect_heard(after, false);
  }
  make_keystore("keys");  // new keys for the talker
  Process again(listener("again", keys("keys", "/listener")));
  const Finished talked = run(talker(keys("keys", "/talker")), kLimit);
  EXPECT_EQ(talked.status, 0) << talked.output;
  expect_heard(again, true);
}

TEST_F(Security, KeysThatAreNotThereAreNamedWithTheRemedy) {
  const Finished run_without = run(talker(keys("keys", "/nobody")), kLimit);
  EXPECT_EQ(run_without.status, 2);
  EXPECT_THAT(run_without.output, AllOf(HasSubstr("enclaves/nobody/"), HasSubstr("panvo secure")));
  EXPECT_EQ(run_without.output.find("panvo secure"), run_without.output.rfind("panvo secure"))
      << "the remedy is printed once";
}

TEST_F(Security, KeysThatAreThereAreKept) {
  const auto key = folder_ / "keys" / "enclaves" / "talker" / "key.pem";
  const std::string before = read_file(key);
  ASSERT_FALSE(before.empty());
  make_keystore("keys");
  EXPECT_EQ(read_file(key), before);
  using std::filesystem::perms;
  EXPECT_EQ(status(key).permissions() & (perms::group_all | perms::others_all), perms::none);
}

TEST_F(Security, AKeyThatOthersMayReadIsRefusedWithTheRemedy) {
  const auto key = folder_ / "keys" / "enclaves" / "talker" / "key.pem";
  std::filesystem::permissions(key, std::filesystem::perms::group_read, std::filesystem::perm_options::add);
  const Finished refused = run(talker(keys("keys", "/talker")), kLimit);
  EXPECT_EQ(refused.status, 2) << refused.output;
  EXPECT_THAT(refused.output, AllOf(HasSubstr(key.string()), HasSubstr("chmod 600")));
}

TEST_F(Security, KeysMadeInACheckoutAreNotSeenByGit) {
  const std::string git = find_program("git");
  if (git.empty()) GTEST_SKIP() << "git is not installed";
  ASSERT_EQ(run({git, "-C", folder_.path(), "init", "--quiet"}).status, 0);
  make_keystore("in_checkout");
  const Finished seen = run({git, "-C", folder_.path(), "status", "--porcelain", "--untracked-files=all"});
  EXPECT_THAT(seen.output, testing::Not(HasSubstr("in_checkout"))) << seen.output;
}

}  // namespace
}  // namespace panvo::test
