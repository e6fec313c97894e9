// SPDX-License-Identifier: Apache-2.0
// The next process frees what a killed process has left in /dev/shm, and nothing else.
#include "panvo/runtime/shm_leftovers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <set>
#include <sstream>

#include "panvo/runtime/test_domain.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "process.hpp"

namespace panvo::test {
namespace {

namespace fs = std::filesystem;
using runtime::remove_shm_leftovers;

/// Paths of the shared memory segments for images that a process has mapped.
std::set<std::string> segments_of(const Process& process) {
  std::set<std::string> segments;
  std::ifstream maps("/proc/" + std::to_string(process.id()) + "/maps");
  for (std::string line; std::getline(maps, line);) {
    const auto path = line.find("/dev/shm/fast_datasharing_");
    if (path != std::string::npos) segments.insert(line.substr(path));
  }
  return segments;
}

bool is_gone(const std::set<std::string>& segments) {
  for (const auto& segment : segments) {
    if (fs::exists(segment)) return false;
  }
  return true;
}

/// A container that reads images and runs until it is terminated, in a separate DDS domain.
std::vector<std::string> live_system() {
  return {PANVO_RUN, SYSTEMS "/stereo.yaml", "--domain", std::to_string(runtime::test_domain())};
}

/// The segments of a container that was killed.
std::set<std::string> left_by_a_killed_one() {
  Process killed(live_system());
  EXPECT_TRUE(eventually([&] { return segments_of(killed).size() >= 2; })) << killed.output();
  const auto left = segments_of(killed);
  killed.signal(SIGKILL);
  killed.wait();
  return left;
}

TEST(ShmLeftovers, AreFreedByTheNextRunWhichSaysSo) {
  if (!fs::is_directory("/dev/shm")) GTEST_SKIP() << "/dev/shm does not exist";
  auto left = left_by_a_killed_one();
  ASSERT_GE(left.size(), 2U);
  std::string said;
  ASSERT_TRUE(eventually([&] {  // segments younger than some seconds are not freed
    Process next(live_system());
    const bool has_begun = eventually([&] { return segments_of(next).size() >= 2; }, std::chrono::seconds(20));
    const bool is_freed = has_begun && is_gone(left);
    const auto says_so = [&] { return next.output().find("freed") != std::string::npos; };
    const bool is_said = is_freed && eventually(says_so, std::chrono::seconds(5));
    said = next.output();
    if (is_freed && !is_said) left = left_by_a_killed_one();  // panvo of somebody else on this machine was first
    return is_said;
  })) << "it said: "
      << said;
}

TEST(ShmLeftovers, LeaveWhatIsOfSomethingElseOrJustBeingMade) {
  const TemporaryFolder folder;
  const std::vector<std::string> names{"fast_datasharing_0123",        "fast_datasharing_0123_el",
                                       "fast_datasharing_0124",        "fastrtps_0123456789abcdef",
                                       "fastrtps_0123456789abcdef_el", "fastrtps_port7410_el",
                                       "sem.fastrtps_port7410_mutex"};
  for (const auto& name : names) std::ofstream(folder / name) << "memory";
  EXPECT_EQ(remove_shm_leftovers(folder.path()).segments, 0U);
  for (const auto& name : names) EXPECT_TRUE(fs::exists(folder / name)) << name;
}

TEST(ShmLeftovers, WithoutAFolderAreNone) { EXPECT_EQ(remove_shm_leftovers("/nowhere").segments, 0U); }

}  // namespace
}  // namespace panvo::test
