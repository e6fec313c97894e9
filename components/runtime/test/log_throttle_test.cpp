// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/log_throttle.hpp"
#include "panvo/interfaces/topics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "panvo/runtime/logger.hpp"
#include "panvo/runtime/testing.hpp"

namespace panvo::runtime {
namespace {

using testing::ElementsAre;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// Lines of a logger with a clock controlled by the test.
struct WrittenLog {
  std::int64_t now_ns = 0;
  std::vector<std::string> lines;
  Logger log{"camera", [this](LogLevel, const std::string&, const std::string& text) { lines.push_back(text); },
             [this] { return now_ns; }};
};

TEST(LogThrottle, WritesAlternatingWarningsOnceEach) {
  WrittenLog written;
  for (int i = 0; i < 100; ++i) {
    written.log.warn_throttled("left", "left camera_info is missing");
    written.log.warn_throttled("right", "right camera_info is missing");
    written.log.warn_throttled("stages", "no image for {} s", i);
  }
  EXPECT_THAT(written.lines,
              ElementsAre("left camera_info is missing", "right camera_info is missing", "no image for 0 s"));
}

TEST(LogThrottle, WritesAgainAfterTenSecondsWithTheNumberOfThoseBetween) {
  WrittenLog written;
  for (int i = 0; i <= 25; ++i) {
    written.now_ns = i * kSecond_ns / 2;
    written.log.warn_throttled("size", "image {}", i);
  }
  written.now_ns = 1000 * kSecond_ns;
  written.log.info_throttled("size", "image of the right size");
  EXPECT_THAT(written.lines, ElementsAre("image 0", "image 20 (19 more like this in the last 10 s)",
                                         "image of the right size (5 more like this in the last 990 s)"));
}

TEST(LogThrottle, TellsKeysApartThatDifferInANumberOnly) {
  WrittenLog written;
  for (const int id : {3, 7, 3}) written.log.warn_throttled("landmark " + std::to_string(id), "landmark {}", id);
  EXPECT_THAT(written.lines, ElementsAre("landmark 3", "landmark 7"));
}

TEST(LogThrottle, StaysSilentWhenTimeGoesBack) {
  LogThrottle throttle;
  EXPECT_EQ(throttle.admit("size", 100 * kSecond_ns), "");
  EXPECT_EQ(throttle.admit("size", 0), std::nullopt);
  EXPECT_EQ(throttle.admit("size", 100 * kSecond_ns), std::nullopt);
}

TEST(LogThrottle, BoundsTheKeysThatItRemembers) {
  LogThrottle throttle;
  std::size_t written = 0;
  for (std::size_t i = 0; i < 10 * LogThrottle::kMaxKeys; ++i) {
    written += throttle.admit("landmark " + std::to_string(i), 0) ? 1 : 0;
  }
  EXPECT_EQ(written, LogThrottle::kMaxKeys + 1);
  // After ten seconds new keys are accepted again.
  EXPECT_EQ(throttle.admit("landmark 5000", LogThrottle::kInterval_ns), "");
  EXPECT_EQ(throttle.admit("landmark 6000", LogThrottle::kInterval_ns), "");
}

/// Logs for every message that it is unusable, with the topic.
class Complainer final : public Component {
 public:
  explicit Complainer(Context& context) {
    context.input(topics::kLandmarkPoses, [&context](const auto&) {
      context.log().warn_throttled("unusable", "{} is of no use", context.resolved_name(topics::kLandmarkPoses));
    });
  }
};

TEST(LogThrottle, CountsByTheStampsOfWhatIsReplayed) {
  ComponentHarness harness;
  harness.add<Complainer>("complainer");
  for (int i = 0; i <= 20; ++i) {
    panvo_msgs::msg::LandmarkPoses message;
    message.header().stamp().sec(100 + i);
    harness.publish(topics::kLandmarkPoses, message);
  }
  EXPECT_THAT(harness.log(),
              ElementsAre("warning complainer: /landmarks/poses is of no use",
                          "warning complainer: /landmarks/poses is of no use (9 more like this in the last 10 s)",
                          "warning complainer: /landmarks/poses is of no use (9 more like this in the last 10 s)"));
}

TEST(ResolvedName, IsTheOneThatTheTopicIsRemappedTo) {
  Container container({.replay = true});
  ComponentDescription description;
  description.package = "panvo_complainer";
  description.name = "complainer";
  description.name_space = "/robot";
  description.remaps = {{"landmarks/poses", "map/poses"}};
  std::string name;
  container.add(description, [&name](Context& context) {
    name = context.resolved_name(topics::kLandmarkPoses);
    return std::make_unique<Component>();
  });
  EXPECT_EQ(name, "/robot/map/poses");
}

}  // namespace
}  // namespace panvo::runtime
