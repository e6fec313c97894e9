// SPDX-License-Identifier: Apache-2.0
#include "messages/camera_topic.hpp"

#include <gmock/gmock.h>

#include "panvo/calibration/calibration_error.hpp"

namespace panvo::calibration {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;

auto camera(const std::string& name, const std::string& topic) {
  return AllOf(Field(&CameraTopic::name, name), Field(&CameraTopic::topic, topic));
}

TEST(CameraTopics, AreNamedByTheirOrderOrByThemselves) {
  const std::vector<std::string> pair{"left", "right"};
  EXPECT_THAT(parse_topics({"/a", "/b"}, pair), ElementsAre(camera("left", "/a"), camera("right", "/b")));
  EXPECT_THAT(parse_topics({"right:=/b", "left:=a"}, pair), ElementsAre(camera("right", "/b"), camera("left", "/a")));
  EXPECT_THAT(parse_topics({"/rig/head_0/image_raw", "up:=/x", "/head_1/image_raw/compressed"}, {}),
              ElementsAre(camera("head_0", "/rig/head_0/image_raw"), camera("up", "/x"),
                          camera("head_1", "/head_1/image_raw/compressed")));
}

TEST(CameraTopics, AreRefusedWithTheReason) {
  const auto refusal = [](const std::vector<std::string>& topics, const std::vector<std::string>& names) {
    try {
      parse_topics(topics, names);
    } catch (const CalibrationError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(refusal({"/a"}, {"left", "right"}), HasSubstr("1 given, expected 2"));
  EXPECT_THAT(refusal({"/a/image_raw"}, {}), HasSubstr("two or more"));
  EXPECT_THAT(refusal({"left:=/a", "middle:=/b"}, {"left", "right"}), HasSubstr("the cameras are left and right"));
  EXPECT_THAT(refusal({"/x/a/image_raw", "/y/a/image_raw"}, {}), AllOf(HasSubstr("camera 'a'"), HasSubstr("NAME:=/y")));
  EXPECT_THAT(refusal({"/a", "/b"}, {}), HasSubstr("NAME:=/a"));
  EXPECT_THAT(refusal({"../up:=/a", "/b"}, {}), HasSubstr("NAME:=/a"));
  EXPECT_THAT(refusal({"left:=", "/b"}, {}), HasSubstr("NAME:=TOPIC"));
}

}  // namespace
}  // namespace panvo::calibration
