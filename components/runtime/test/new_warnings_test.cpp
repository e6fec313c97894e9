// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/new_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace panvo::runtime {
namespace {

TEST(NewWarnings, AreSaidWhenTheyBegin) {
  std::vector<std::string> said;
  const Logger log("camera", [&](LogLevel level, const std::string& component, const std::string& text) {
    EXPECT_EQ(level, LogLevel::kWarning);
    EXPECT_EQ(component, "camera");
    said.push_back(text);
  });
  NewWarnings warnings(log);
  warnings.say("no image for 1.5 s");
  warnings.say("no image for 12 s");
  warnings.say("image of 3 {px}");
  warnings.say("no image for 2 s");
  EXPECT_THAT(said, testing::ElementsAre("no image for 1.5 s", "image of 3 {px}", "no image for 2 s"));
}

}  // namespace
}  // namespace panvo::runtime
