// SPDX-License-Identifier: Apache-2.0
#include "doctor/host_checks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "panvo/test/temporary_folder.hpp"

namespace panvo::runtime::doctor {
namespace {

using panvo::test::TemporaryFolder;
using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

auto is(Severity severity, const std::string& text) {
  return AllOf(Field(&Finding::severity, severity), Field(&Finding::text, HasSubstr(text)),
               Field(&Finding::remedy, severity == Severity::kOk ? testing::Matcher<std::string>(IsEmpty())
                                                                 : testing::Matcher<std::string>(Not(IsEmpty()))));
}

class OfAMadeUpMachine : public testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) {
    std::filesystem::create_directories((root / file).parent_path());
    root.write(root / file, text);
  }
  const TemporaryFolder root;
};

TEST_F(OfAMadeUpMachine, SocketBuffersMustHoldAnImage) {
  EXPECT_THAT(check_socket_buffers(root / "."), is(Severity::kOk, "does not tell"));
  write("proc/sys/net/core/rmem_max", "212992\n");
  write("proc/sys/net/core/wmem_max", "4194304\n");
  EXPECT_THAT(check_socket_buffers(root / "."), is(Severity::kWarning, "up to 208 kB for receiving"));
  write("proc/sys/net/core/rmem_max", "4194304\n");
  EXPECT_THAT(check_socket_buffers(root / "."), is(Severity::kOk, "up to 4096 kB for receiving, 4096 kB for sending"));
}

TEST_F(OfAMadeUpMachine, MemoryIsReadFromTheKernel) {
  write("proc/meminfo", "MemTotal:       2097152 kB\nMemFree: 1 kB\nMemAvailable:    524288 kB\n");
  EXPECT_THAT(check_machine(root / "."), is(Severity::kOk, "0.5 of 2.0 GB memory available"));
}

TEST_F(OfAMadeUpMachine, SharedMemoryMayBeMissing) {
  EXPECT_THAT(check_shared_memory(root / "."), is(Severity::kWarning, "missing or not writable"));
  std::filesystem::create_directories(root / "dev/shm");
  EXPECT_THAT(check_shared_memory(root / "."), Field(&Finding::text, HasSubstr("MB free")));
}

TEST_F(OfAMadeUpMachine, CamerasThatAreOnlyFilesOfAnotherUserAreNamed) {
  EXPECT_THAT(check_cameras(root / "."), ElementsAre(is(Severity::kOk, "0 video devices")));
  write("dev/video0", "");
  write("dev/video2", "");
  EXPECT_THAT(check_cameras(root / "."), ElementsAre(is(Severity::kOk, "2 video devices")));
  // Root may open whatever exists.
  std::filesystem::remove(root / "dev/video2");
  std::filesystem::create_symlink("nowhere", root / "dev/video2");
  EXPECT_THAT(check_cameras(root / "."), ElementsAre(is(Severity::kProblem, "/dev/video2")));
}

TEST(Network, NeedsLoopbackAndMulticast) {
  const NetworkInterface loopback{"lo", "127.0.0.1", true, false}, card{"eth0", "10.0.0.2", false, true},
      plain{"tun0", "10.1.0.2", false, false};
  EXPECT_THAT(check_network({card}), is(Severity::kProblem, "loopback"));
  EXPECT_THAT(check_network({loopback}), is(Severity::kWarning, "only the loopback"));
  EXPECT_THAT(check_network({loopback, plain}), is(Severity::kWarning, "no multicast on tun0 10.1.0.2"));
  EXPECT_THAT(check_network({loopback, plain, card}), is(Severity::kOk, "multicast on eth0 10.0.0.2"));
}

TEST(Network, OfThisMachineHasALoopback) {
  EXPECT_THAT(network_interfaces(), testing::Contains(Field(&NetworkInterface::address, "127.0.0.1")));
}

TEST(Clock, IsJudgedByTheKernel) {
  EXPECT_THAT(check_clock(true), is(Severity::kOk, "synchronised"));
  EXPECT_THAT(check_clock(false), is(Severity::kWarning, "not synchronised"));
  EXPECT_THAT(check_clock(std::nullopt), is(Severity::kOk, "does not tell"));
}

TEST(EnvironmentVariables, AreShownAndContradictionsNamed) {
  std::map<std::string, std::string> variables;
  const Environment environment = [&](const char* name) {
    const auto found = variables.find(name);
    return found == variables.end() ? std::nullopt : std::optional(found->second);
  };
  EXPECT_THAT(check_environment(environment), IsEmpty());
  variables = {{"ROS_DOMAIN_ID", "7"}, {"ROS_LOCALHOST_ONLY", "0"}, {"ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET"}};
  EXPECT_THAT(check_environment(environment),
              ElementsAre(is(Severity::kOk, "7"), is(Severity::kOk, "0"), is(Severity::kOk, "SUBNET")));
  variables = {{"ROS_LOCALHOST_ONLY", "1"}, {"ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET"}};
  EXPECT_THAT(check_environment(environment), testing::Contains(is(Severity::kWarning, "prevails")));
  variables = {{"FASTRTPS_DEFAULT_PROFILES_FILE", "/nowhere.xml"}};
  EXPECT_THAT(check_environment(environment), testing::Contains(is(Severity::kProblem, "/nowhere.xml cannot be read")));
}

}  // namespace
}  // namespace panvo::runtime::doctor
