// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>

#include "panvo/recorder/bag_copy.hpp"
#include "panvo/recorder/bag_reader.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "test_bag.hpp"

namespace panvo::recorder {
namespace {

using namespace test;
using panvo::test::TemporaryFolder;
using testing::HasSubstr;

/// Runs recording_child and reads its output.
class Child {
 public:
  Child(const std::filesystem::path& bag, std::size_t message_bytes, Storage storage,
        const std::string& file_limit = "0") {
    int ends[2];
    if (::pipe(ends) != 0) {
      throw std::runtime_error("no pipe");
    }
    pid_ = ::fork();
    if (pid_ == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      ::close(ends[0]);
      ::close(ends[1]);
      const auto size = std::to_string(message_bytes);
      ::execl(PANVO_RECORDING_CHILD, PANVO_RECORDING_CHILD, bag.c_str(), size.c_str(), to_text(storage).c_str(),
              file_limit.c_str(), nullptr);
      ::_exit(127);
    }
    ::close(ends[1]);
    output_ = ::fdopen(ends[0], "r");
  }
  ~Child() {
    kill();
    std::fclose(output_);
  }

  std::string read_line() {
    char line[4096] = "";
    return std::fgets(line, sizeof line, output_) ? std::string(line) : std::string();
  }
  std::string read_last_line() {
    std::string last;
    for (auto line = read_line(); !line.empty(); line = read_line()) {
      last = line;
    }
    return last;
  }
  void kill() {
    if (pid_ > 0) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
      pid_ = -1;
    }
  }

 private:
  pid_t pid_ = -1;
  std::FILE* output_ = nullptr;
};

void expect_first_messages(const std::filesystem::path& bag, std::size_t size, std::uint64_t at_least) {
  BagReader reader(bag);
  const auto messages = read_all(reader);
  EXPECT_GE(messages.size(), at_least);
  EXPECT_EQ(wrong_in_first_numbered(messages, size), "");
  EXPECT_LE(reader.lost_messages(), 1u) << "the one that was being written";
  EXPECT_EQ(reader.metadata().message_count, messages.size());
  EXPECT_EQ(reader.metadata().topics.at(0).message_count, messages.size());
}

class KilledRecorder : public testing::TestWithParam<Storage> {};
class FullDisk : public testing::TestWithParam<Storage> {
 protected:
  static std::string ending() { return GetParam() == Storage::kMcap ? "mcap" : "db3"; }
};

TEST_P(KilledRecorder, LeavesEveryCommittedMessage) {
  // Kills after the first commit, the second, ...
  for (int commits = 1; commits <= 10; ++commits) {
    const TemporaryFolder folder;
    std::uint64_t committed = 0;
    {
      Child child(folder / "bag", 100'000, GetParam());
      for (int i = 0; i < commits; ++i) {
        committed = std::strtoull(child.read_line().c_str(), nullptr, 10);
      }
      child.kill();
    }
    ASSERT_GT(committed, 0u);
    expect_first_messages(folder / "bag", 100'000, committed);
  }
}

TEST_P(KilledRecorder, LeavesABagThatReindexMakesWhole) {
  const TemporaryFolder folder;
  {
    Child child(folder / "bag", 1000, GetParam());
    child.read_line();
    child.read_line();
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "bag" / "metadata.yaml"));
  std::vector<std::string> warnings;
  const auto metadata = reindex_bag(folder / "bag", warnings);
  BagReader reader(folder / "bag");
  EXPECT_FALSE(any_contains(reader.warnings(), "metadata.yaml"));
  EXPECT_EQ(reader.metadata().message_count, metadata.message_count);
  expect_first_messages(folder / "bag", 1000, 20);
}

TEST_P(FullDisk, StopsTheRecordingWithAnErrorAndLeavesWhatWasCommitted) {
  // Limits reached within a page, within a batch, and early.
  for (const char* limit : {"3000000", "1700123", "1000000"}) {
    const TemporaryFolder folder;
    Child child(folder / "bag", 20'000, GetParam(), limit);
    const auto last = child.read_last_line();
    EXPECT_THAT(last, HasSubstr("bag_0." + ending() + ": cannot be written (File too large)")) << limit;
    EXPECT_THAT(last, HasSubstr("free some space"));
    const std::uint64_t committed = std::strtoull(last.c_str(), nullptr, 10);
    EXPECT_GT(committed, 0u);
    EXPECT_THAT(last, HasSubstr(std::to_string(committed) + " messages committed before stay readable"));
    expect_first_messages(folder / "bag", 20'000, committed);
  }
}

TEST_P(FullDisk, IsToldWhenThereIsNoRoomForTheBagAtAll) {
  const TemporaryFolder folder;
  Child child(folder / "bag", 1000, GetParam(), "10");
  EXPECT_THAT(child.read_last_line(), HasSubstr("bag_0." + ending() + ": cannot be written (File too large)"));
  EXPECT_THAT(error_of([&] { BagReader reader(folder / "bag"); }), HasSubstr("bag_0." + ending()));
}

INSTANTIATE_TEST_SUITE_P(Storages, KilledRecorder, testing::Values(Storage::kSqlite3, Storage::kMcap),
                         [](const auto& storage) { return to_text(storage.param); });
INSTANTIATE_TEST_SUITE_P(Storages, FullDisk, testing::Values(Storage::kSqlite3, Storage::kMcap),
                         [](const auto& storage) { return to_text(storage.param); });

}  // namespace
}  // namespace panvo::recorder
