// SPDX-License-Identifier: Apache-2.0
/// Runs panvo_bag as a process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "panvo/test/temporary_folder.hpp"
#include "test_bag.hpp"

namespace panvo::recorder {
namespace {

using namespace test;
using panvo::test::TemporaryFolder;
using testing::HasSubstr;

struct Finished {
  int status = -1;
  std::string output;  // stdout and stderr
};

Finished run(const std::string& arguments) {
  Finished finished;
  std::FILE* pipe = ::popen((std::string(PANVO_BAG) + " " + arguments + " 2>&1").c_str(), "r");
  char part[4096];
  while (std::fgets(part, sizeof part, pipe)) {
    finished.output += part;
  }
  finished.status = WEXITSTATUS(::pclose(pipe));
  return finished;
}

class Command : public testing::Test {
 protected:
  void SetUp() override {
    BagWriter writer(folder_ / "bag");
    write_numbered(writer, 11, 100);
    writer.count_dropped("/data", 2);
  }

  TemporaryFolder folder_;
  const std::string bag_ = (folder_ / "bag").string();
};

TEST_F(Command, InfoTellsWhatIsInABag) {
  const auto finished = run("info " + bag_);
  EXPECT_EQ(finished.status, 0);
  for (const char* part :
       {"Files:             bag_0.db3\n", "Duration:          0.100000000s\n", "(1700000000.000000000)\n",
        "Messages:          11\n", "Dropped:           2\n", "ROS Distro:        jazzy\n",
        "Topic: /data | Type: test_msgs/msg/Bytes | Count: 11 | Serialization Format: cdr"}) {
    EXPECT_THAT(finished.output, HasSubstr(part));
  }
}

TEST_F(Command, InfoTellsItToScripts) {
  const auto json = nlohmann::json::parse(run("info --json " + bag_).output);
  EXPECT_EQ(json["messages"], 11);
  EXPECT_EQ(json["dropped"], 2);
  EXPECT_EQ(json["duration_ns"], 10 * kStep);
  EXPECT_EQ(json["topics"][0]["name"], "/data");
  EXPECT_EQ(json["topics"][0]["count"], 11);
}

TEST_F(Command, InfoToScriptsIsUtf8WhateverTheBagIsCalled) {
  const auto bag = folder_ / "caf\xe9";  // Latin-1
  std::filesystem::rename(folder_ / "bag", bag);
  EXPECT_THAT(std::string(nlohmann::json::parse(run("info --json " + bag.string()).output)["bag"]),
              testing::EndsWith("caf\xef\xbf\xbd"));
}

TEST_F(Command, DiffEndsWithOneWhereBagsDiffer) {
  EXPECT_EQ(run("copy " + bag_ + " " + (folder_ / "copy").string()).status, 0);
  EXPECT_EQ(run("diff --times " + bag_ + " " + (folder_ / "copy").string()).status, 0);
  {
    BagWriter writer(folder_ / "other");
    write_numbered(writer, 10, 100);
  }
  const auto finished = run("diff " + bag_ + " " + (folder_ / "other").string());
  EXPECT_EQ(finished.status, 1);
  EXPECT_THAT(finished.output, HasSubstr("/data: ends after 10 equal messages"));
}

TEST_F(Command, ConvertMakesMcapOfSqliteAndBack) {
  const auto converted = (folder_ / "converted").string();
  EXPECT_EQ(run("convert --compression zstd " + bag_ + " " + converted).status, 0);
  EXPECT_THAT(run("info " + converted).output,
              testing::AllOf(HasSubstr("Storage id:        mcap"), HasSubstr("Dropped:           2\n")));
  EXPECT_EQ(run("convert " + converted + " " + (folder_ / "back").string()).status, 0);
  EXPECT_THAT(run("info " + (folder_ / "back").string()).output, HasSubstr("Storage id:        sqlite3"));
  EXPECT_EQ(run("diff --times " + bag_ + " " + (folder_ / "back").string()).status, 0);
  EXPECT_EQ(run("convert --storage tape " + bag_ + " " + (folder_ / "tape").string()).status, 2);
}

TEST_F(Command, SliceTakesSecondsAndStamps) {
  const auto part = (folder_ / "part").string();
  EXPECT_THAT(run("slice --from 0.02 --to 1700000000.05 " + bag_ + " " + part).output, HasSubstr("3 messages copied"));
  EXPECT_EQ(run("slice --from 5 --to 4 " + bag_ + " " + (folder_ / "none").string()).status, 2);
}

TEST_F(Command, ReindexMakesACheckedBagSound) {
  std::filesystem::remove(folder_ / "bag" / "metadata.yaml");
  EXPECT_EQ(run("check " + bag_).status, 1);
  EXPECT_EQ(run("reindex " + bag_).status, 0);
  const auto finished = run("check " + bag_);
  EXPECT_EQ(finished.status, 0) << finished.output;
  EXPECT_THAT(finished.output, HasSubstr("11 messages readable, 0 lost: sound"));
}

TEST_F(Command, EndsWithTwoAndANameWhereItCannotBeDone) {
  const auto finished = run("info " + (folder_ / "none").string());
  EXPECT_EQ(finished.status, 2);
  EXPECT_THAT(finished.output, HasSubstr("none: does not exist"));
  EXPECT_EQ(run("diff " + bag_).status, 2);
  EXPECT_EQ(run("inform " + bag_).status, 2);
  EXPECT_EQ(run("--help").status, 0);
}

}  // namespace
}  // namespace panvo::recorder
