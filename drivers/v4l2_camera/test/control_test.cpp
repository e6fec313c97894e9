// SPDX-License-Identifier: Apache-2.0
#include "panvo/v4l2_camera/control.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

namespace panvo::v4l2_camera {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

MATCHER_P2(Sets, name, value, "") { return arg.name == name && arg.value == value; }

const Control kGain{.name = "gain", .least = 10, .most = 100, .step = 5};
const Control kExposure{.name = "auto_exposure",
                        .kind = Control::Kind::kMenu,
                        .choices = {{1, "Manual Mode"}, {3, "Aperture Priority Mode"}}};

TEST(ControlNames, AreTheCamerasInLowerCase) {
  EXPECT_EQ(control_name("White Balance, Automatic"), "white_balance_automatic");
  EXPECT_EQ(control_name("Exposure Time, Absolute "), "exposure_time_absolute");
  EXPECT_EQ(control_name("gain"), "gain");
  EXPECT_EQ(control_name(" - "), "");
}

TEST(ControlValues, AreNumbersWithinTheCamerasRange) {
  EXPECT_EQ(*control_value(kGain, "15"), 15);
  EXPECT_EQ(control_value(kGain, "101").reason(), "is out of range, 10 to 100");
  EXPECT_EQ(control_value(kGain, "5").reason(), "is out of range, 10 to 100");
  EXPECT_THAT(control_value(kGain, "12").reason(), HasSubstr("use 10 plus a multiple of 5"));
  EXPECT_EQ(control_value(kGain, "much").reason(), "is not a whole number");
  EXPECT_EQ(control_value(kGain, "15x").reason(), "is not a whole number");
}

TEST(ControlValues, AreChoicesByTheirTextOrNumber) {
  EXPECT_EQ(*control_value(kExposure, "Manual Mode"), 1);
  EXPECT_EQ(*control_value(kExposure, "manual_mode"), 1);
  EXPECT_EQ(*control_value(kExposure, "3"), 3);
  EXPECT_EQ(control_value(kExposure, "2").reason(),
            "is not a valid choice; choices: 1 (Manual Mode), 3 (Aperture Priority Mode)");
}

TEST(ControlValues, AreTrueOrFalseOfSwitchesAndNoneOfWhatCanOnlyBeRead) {
  const Control light{.name = "light", .kind = Control::Kind::kSwitch};
  EXPECT_EQ(*control_value(light, "true"), 1);
  EXPECT_EQ(*control_value(light, "0"), 0);
  EXPECT_EQ(control_value(light, "on").reason(), "is neither true nor false");
  EXPECT_EQ(control_value({.name = "temperature", .is_read_only = true}, "3").reason(), "is read-only");
  EXPECT_EQ(*control_value({.name = "reset", .kind = Control::Kind::kButton}, ""), 1);
}

}  // namespace
}  // namespace panvo::v4l2_camera
