// SPDX-License-Identifier: Apache-2.0
// Stores written by another process that is killed, runs out of space or holds a lock.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "made_up_landmark.hpp"
#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::landmarks {
namespace {

using namespace test;
using panvo::test::TemporaryFolder;
using testing::HasSubstr;

/// Runs storing_child and reads its output.
class Child {
 public:
  Child(const std::filesystem::path& store, const std::string& what, const std::string& file_limit = "") {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    pid_ = ::fork();
    if (pid_ == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      ::close(ends[0]);
      ::close(ends[1]);
      ::execl(PANVO_STORING_CHILD, PANVO_STORING_CHILD, store.c_str(), what.c_str(),
              file_limit.empty() ? nullptr : file_limit.c_str(), nullptr);
      ::_exit(127);
    }
    ::close(ends[1]);
    output_ = ::fdopen(ends[0], "r");
  }
  ~Child() {
    kill();
    std::fclose(output_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  std::string read_line() {
    char line[4096] = "";
    return std::fgets(line, sizeof line, output_) ? std::string(line) : std::string();
  }
  void kill() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }

 private:
  pid_t pid_ = -1;
  std::FILE* output_ = nullptr;
};

/// Expects every landmark the child reported, and possibly the one it was adding.
void expect_landmarks(const std::filesystem::path& file, std::uint32_t told, std::size_t keypoints) {
  const LandmarkStore store(file);
  EXPECT_EQ(store.find_damage(), std::nullopt);
  EXPECT_GE(store.size(), told);
  std::uint32_t id = 0;
  for (auto landmark : store.landmarks()) {
    landmark.keypoints = store.keypoints(landmark.id);
    landmark.thumbnail = store.thumbnail(landmark.id);
    EXPECT_EQ(difference(landmark, made_up_landmark(++id, keypoints)), "");
  }
}

TEST(KilledProcess, LeavesEveryLandmarkThatItHadAdded) {
  for (std::uint32_t moment = 1; moment <= 12; ++moment) {
    const TemporaryFolder folder;
    std::uint32_t told = 0;
    {
      Child child(folder / "store", "300");
      while (told < moment) told = static_cast<std::uint32_t>(std::strtoul(child.read_line().c_str(), nullptr, 10));
      child.kill();
    }
    expect_landmarks(folder / "store", told, 300);
  }
}

TEST(KilledProcess, IsContinuedByTheNext) {
  const TemporaryFolder folder;
  std::uint32_t before = 0;
  {
    Child child(folder / "store", "300");
    child.read_line();
    child.read_line();
  }
  {
    LandmarkStore store(folder / "store", made_up_settings());
    before = static_cast<std::uint32_t>(store.size());
    EXPECT_GE(before, 2u);
    EXPECT_EQ(store.add(made_up_landmark(before + 1, 300)), before + 1);
  }
  expect_landmarks(folder / "store", before + 1, 300);
}

TEST(FullDisk, IsToldAndLeavesWhatWasAdded) {
  for (const char* limit : {"300000", "150123"}) {
    const TemporaryFolder folder;
    Child child(folder / "store", "100", limit);
    std::uint32_t told = 0;
    auto line = child.read_line();
    while (std::strtoul(line.c_str(), nullptr, 10) > 0) {
      told = static_cast<std::uint32_t>(std::strtoul(line.c_str(), nullptr, 10));
      line = child.read_line();
    }
    EXPECT_THAT(line, HasSubstr("store: cannot be written (File too large); free disk space")) << limit;
    EXPECT_GT(told, 0u);
    expect_landmarks(folder / "store", told, 100);
  }
}

TEST(FullDisk, IsToldWhereThereIsNoRoomForTheStoreAtAll) {
  const TemporaryFolder folder;
  Child child(folder / "store", "100", "2000");
  EXPECT_THAT(child.read_line(), HasSubstr("store: cannot be written (File too large)"));
}

TEST(LockOfAnotherProcess, IsToldAfterABoundedTime) {
  const TemporaryFolder folder;
  LandmarkStore writer(folder / "store", made_up_settings());
  writer.add(made_up_landmark(1));
  Child child(folder / "store", "lock");
  ASSERT_EQ(child.read_line(), "locked\n");
  const auto reading = error_of<StoreError>([&] { LandmarkStore reader(folder / "store"); });
  EXPECT_THAT(reading, HasSubstr("store: is locked by another process (waited 2 s); end that process"));
  EXPECT_THAT(error_of<StoreError>([&] { LandmarkStore second(folder / "store", made_up_settings()); }),
              HasSubstr("is locked by another process"));
  EXPECT_THAT(error_of<StoreError>([&] { writer.add(made_up_landmark(2)); }),
              HasSubstr("is locked by another process"));
  child.kill();
  EXPECT_EQ(writer.add(made_up_landmark(2)), 2u);
}

}  // namespace
}  // namespace panvo::landmarks
