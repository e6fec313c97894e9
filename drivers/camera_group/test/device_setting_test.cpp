// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_group/device_setting.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

namespace panvo::camera_group {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(DeviceSettings, KeepTheirOrderAndAreForAllOrForOne) {
  const std::vector<std::string> lines{"UserSetLoad=", "left: Gain = 3", "right:Gain=4", "Name=a=b",
                                       "a b = Manual Mode"};
  using S = DeviceSetting;
  EXPECT_THAT(settings_of("features", lines, "left", {"left", "right"}),
              ElementsAre(S{"UserSetLoad", ""}, S{"Gain", "3"}, S{"Name", "a=b"}, S{"a b", "Manual Mode"}));
  EXPECT_THAT(settings_of("features", lines, "right", {"left", "right"}),
              ElementsAre(S{"UserSetLoad", ""}, S{"Gain", "4"}, S{"Name", "a=b"}, S{"a b", "Manual Mode"}));
}

TEST(DeviceSettings, AreRefusedWhereTheyAreNoneWithHowToWriteThem) {
  const auto problem = [](const std::string& line) -> std::string {
    try {
      settings_of("controls", {line}, "left", {"left", "right"});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  for (const char* line : {"gain", "=3", "left:=3", ""})
    EXPECT_THAT(problem(line), AllOf(HasSubstr("controls: '"), HasSubstr("write name=value, or left:name=value")))
        << line;
  EXPECT_THAT(problem("middle:gain=3"), HasSubstr("unknown camera 'middle'; cameras: left, right"));
}

}  // namespace
}  // namespace panvo::camera_group
