// SPDX-License-Identifier: Apache-2.0
// The V4L2 driver on another kernel's cameras: each test starts Debian's kernel in QEMU and runs many scenarios there. Skipped, with the reason, where
// QEMU, the kernel or what prepares it is not to be had.
#include <gtest/gtest.h>

#include <algorithm>

#include "process.hpp"

namespace panvo::test {
namespace {

class VirtualMachine : public ::testing::Test {
 protected:
  void SetUp() override {
    const Finished checked = run({PYTHON, "-B", VIRTUAL_MACHINE, "check"}, std::chrono::seconds(290));
    if (checked.status != 0) GTEST_SKIP() << "there can be no virtual machine here: " << checked.output;
  }

  /// Runs a program inside; the machine is switched off after `limit`.
  Finished inside(const std::vector<std::string>& modules, const std::vector<std::string>& words,
                  std::chrono::seconds limit) {
    std::vector<std::string> command{PYTHON, "-B", VIRTUAL_MACHINE, "run", "--limit", std::to_string(limit.count())};
    for (const auto& module : modules) command.insert(command.end(), {"--module", module});
    command.push_back(exchange_.path().string());
    command.insert(command.end(), words.begin(), words.end());
    return run(command, limit + std::chrono::seconds(20));
  }

  TemporaryFolder exchange_;
};

TEST_F(VirtualMachine, DriverHoldsOnTheKernelsSimulatedCameras) {
  const Finished finished = inside({"vivid=n_devs=2;node_types=0x1,0x1;num_inputs=1,1;input_types=0x0,0x0"},
                                   {VIVID_SCENARIOS}, std::chrono::seconds(75));
  EXPECT_EQ(finished.status, 0) << finished.output;
}

TEST_F(VirtualMachine, DriverHoldsOnUsbCameras) {
  const Finished finished = inside({"vivid=none"}, {USB_SCENARIOS}, std::chrono::seconds(100));
  EXPECT_EQ(finished.status, 0) << finished.output;
}

}  // namespace
}  // namespace panvo::test
