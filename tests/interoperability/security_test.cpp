// SPDX-License-Identifier: Apache-2.0
// Keys made by `panvo secure`: who has them hears and is heard; who has none, or another's, neither reads nor writes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "panvo/runtime/test_domain.hpp"
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
    if (find_program("openssl").empty()) GTEST_SKIP() << "there is no program openssl (package openssl)";
    make_keystore("keys");
    RenderedWalk{.frames = 20}.write(folder_.path() / "walk");
  }

  void make_keystore(const std::string& name) const {
    const Finished made = run({PANVO, "secure", folder_ / name, "/talker", "/listener"});
    ASSERT_EQ(made.status, 0) << made.output;
  }

  static Words joined(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  Words keys(const std::string& keystore, const std::string& enclave) const {
    return {"--secure", folder_ / keystore, "--enclave", enclave};
  }

  /// Records the odometry that it hears; `name` of the bag.
  Words listener(const std::string& name, const Words& with_keys) const {
    return joined({PANVO_RUN, CONFIG "/systems/record.yaml", "output:=" + (folder_ / name),
                   std::string("topics:=") + kTopic, "--domain", domain_},
                  with_keys);
  }

  /// Publishes twenty poses once somebody listens.
  Words talker(const Words& with_keys) const {
    return joined({PANVO_RUN, CONFIG "/systems/stereo.yaml", "--dataset", folder_ / "walk", "--rate", "1", "--await",
                   kTopic, "--domain", domain_},
                  with_keys);
  }

  /// Whether it heard anything. How much is not asked: who exchanges keys may miss the first messages.
  static void expect_heard(Process& listener, bool is_heard) {
    listener.signal(SIGINT);
    EXPECT_EQ(listener.wait(kLimit), 0) << listener.output();
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

TEST_F(Security, ASplitSystemWithKeysComputesItsOdometry) {
  const Finished split = run(joined({PANVO_RUN, CONFIG "/systems/stereo_split.yaml", "--dataset", folder_ / "walk",
                                     "--rate", "1", "--domain", domain_, "--out", folder_ / "out"},
                                    keys("keys", "/talker")),
                             kLimit);
  EXPECT_EQ(split.status, 0) << split.output;
  const std::string poses = read_file(folder_.path() / "out" / "odometry_binocular.tum");
  EXPECT_GE(std::count(poses.begin(), poses.end(), '\n'), 18) << split.output;
}

TEST_F(Security, KeysThatAreNotThereAreNamedWithTheRemedy) {
  const Finished run_without = run(talker(keys("keys", "/nobody")), kLimit);
  EXPECT_EQ(run_without.status, 2);
  EXPECT_THAT(run_without.output, AllOf(HasSubstr("enclaves/nobody/"), HasSubstr("panvo secure")));
  EXPECT_EQ(run_without.output.find("panvo secure"), run_without.output.rfind("panvo secure")) << "is said once";
}

TEST_F(Security, KeysThatAreThereAreKept) {
  const auto key = folder_.path() / "keys" / "enclaves" / "talker" / "key.pem";
  const std::string before = read_file(key);
  ASSERT_FALSE(before.empty());
  make_keystore("keys");
  EXPECT_EQ(read_file(key), before);
  using std::filesystem::perms;
  EXPECT_EQ(status(key).permissions() & (perms::group_all | perms::others_all), perms::none);
}

}  // namespace
}  // namespace panvo::test
