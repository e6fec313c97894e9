// SPDX-License-Identifier: Apache-2.0
// Command lines of panvo_junctions and panvo_compass_score.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <string>

namespace panvo::evaluation {
namespace {

class PanoramaProgram : public ::testing::TestWithParam<const char*> {
 protected:
  /// Exit status with the arguments.
  static int call(const std::string& arguments) {
    const std::string command = std::string(GetParam()) + " " + arguments + " > /dev/null 2>&1 < /dev/null";
    return WEXITSTATUS(std::system(command.c_str()));
  }
};

TEST_P(PanoramaProgram, FailsOnBadUsageAndExplainsItself) {
  EXPECT_EQ(call(""), 2);
  EXPECT_EQ(call("--nonsense"), 2);
  EXPECT_EQ(call("--help"), 0);
}

TEST_P(PanoramaProgram, TellsBadInputFromBadUsage) { EXPECT_EQ(call("/dev"), 1); }

INSTANTIATE_TEST_SUITE_P(Each, PanoramaProgram, ::testing::Values(PANVO_JUNCTIONS, PANVO_COMPASS_SCORE));

}  // namespace
}  // namespace panvo::evaluation
