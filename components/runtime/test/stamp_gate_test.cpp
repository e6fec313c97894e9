// SPDX-License-Identifier: Apache-2.0
// What components get of messages whose stamps jump.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <string>

#include "context_state.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/testing.hpp"

namespace panvo::runtime {
namespace {

using Image = sensor_msgs::msg::Image;
using ImagePtr = std::shared_ptr<const Image>;
using Seconds = std::vector<std::int32_t>;
using testing::ElementsAre;
using testing::ElementsAreArray;

Seconds counted(std::int32_t first, int count) {
  Seconds seconds(static_cast<std::size_t>(count));
  std::iota(seconds.begin(), seconds.end(), first);
  return seconds;
}

Seconds operator+(Seconds before, const Seconds& after) {
  before.insert(before.end(), after.begin(), after.end());
  return before;
}

/// Passes rectified images on from raw ones, as a stage does.
struct RelayStage : Component {
  explicit RelayStage(Context& context)
      : left(context.output(topics::kStereoLeftImageRect)), right(context.output(topics::kStereoRightImageRect)) {
    context.input(topics::kStereoLeftImageRaw, [this](const ImagePtr& image) { left.publish(image); });
    context.input(topics::kStereoRightImageRaw, [this](const ImagePtr& image) { right.publish(image); });
  }
  Output<Image> left, right;
};

/// Records the stamps of received pairs, and of left images by two further inputs.
struct StampSink : Component {
  explicit StampSink(Context& context) {
    context.input_pair(topics::kStereoLeftImageRect, topics::kStereoRightImageRect,
                       [](const auto& left, const auto&) { pairs.push_back(left->header().stamp().sec()); });
    for (auto& own : lefts) {
      own.clear();
      context.input(topics::kStereoLeftImageRect,
                    [&own](const ImagePtr& left) { own.push_back(left->header().stamp().sec()); });
    }
    pairs.clear();
    state = &context.state();
  }
  static std::uint64_t rejected(const std::string& topic) {
    const auto all = state->rejections.snapshot();
    const auto found = all.find(topic);
    return found == all.end() ? 0 : found->second.messages;
  }
  static inline Seconds pairs, lefts[2];
  static inline Context::State* state = nullptr;
};

/// Sends a pair each second, stamped by a clock that may be set; through another component or at once.
class StampedPairs {
 public:
  explicit StampedPairs(bool by_relay)
      : left_(by_relay ? topics::kStereoLeftImageRaw : topics::kStereoLeftImageRect),
        right_(by_relay ? topics::kStereoRightImageRaw : topics::kStereoRightImageRect) {
    if (by_relay) harness_.add<RelayStage>("relay_stage");
    harness_.add<StampSink>("stamp_sink");
  }

  void send(const Seconds& seconds) {
    for (const std::int32_t second : seconds) {
      Image image;
      image.header().stamp().sec(second);
      image.width(1);
      image.height(1);
      image.step(1);
      image.encoding("mono8");
      image.data({0});
      harness_.publish(left_, image);
      harness_.publish(right_, image);
      arrival_ns_ += 1'000'000'000;
    }
  }
  Container& container() { return harness_.container(); }
  bool log_contains(const std::string& text) const { return harness_.log_contains(text); }

 private:
  std::int64_t arrival_ns_ = 0;
  ComponentHarness harness_{{.replay = true, .clock = [this] { return arrival_ns_; }}};
  const interfaces::Topic<Image> left_, right_;
};

TEST(StampGate, DropsAPairOfAnotherTime) {
  StampedPairs pairs(false);
  pairs.send({1'000, 1'001, 1'002, 1'063, 1'004});
  EXPECT_THAT(StampSink::pairs, ElementsAre(1'000, 1'001, 1'002, 1'004));
  EXPECT_TRUE(pairs.log_contains("/stereo/left/image_rect: dropped a message with a stamp ahead"));
}

TEST(StampGate, DropsAFewPairsOfAnotherTime) {
  for (const std::int32_t other : {1'063, 500}) {
    StampedPairs pairs(true);
    pairs.send(counted(1'000, 5) + counted(other, 4) + counted(1'009, 5));
    EXPECT_THAT(StampSink::pairs, ElementsAreArray(counted(1'000, 5) + counted(1'009, 5)));
    EXPECT_FALSE(pairs.log_contains("clock changed"));
  }
}

TEST(StampGate, LosesNoPairOnTheWayThroughComponentsWhenAClockIsSet) {
  for (const std::int32_t now : {1'063, 500}) {
    StampedPairs pairs(true);
    pairs.send(counted(1'000, 5) + counted(now, 4));
    EXPECT_THAT(StampSink::pairs, ElementsAreArray(counted(1'000, 5))) << "the others wait";
    pairs.send(counted(now + 4, 2));
    EXPECT_THAT(StampSink::pairs, ElementsAreArray(counted(1'000, 5) + counted(now, 6)));
    EXPECT_TRUE(pairs.log_contains("/stereo/left/image_rect: its sender's clock changed"));
    EXPECT_FALSE(pairs.log_contains("dropped"));
  }
}

TEST(StampGate, LosesOnlyWhatIsOfNeitherTimeWhenAClockIsSet) {
  StampedPairs pairs(true);
  pairs.send(counted(1'000, 5) + Seconds{2'000'000} + counted(500, 6));
  EXPECT_THAT(StampSink::pairs, ElementsAreArray(counted(1'000, 5) + counted(500, 6)));
}

TEST(StampGate, GivesTheNewTimeToEachInputOfATopic) {
  StampedPairs pairs(false);
  const Seconds sent = counted(1'000, 5) + counted(500, 6);
  pairs.send(sent);
  for (const auto& own : StampSink::lefts) EXPECT_THAT(own, ElementsAreArray(sent));
}

/// Of a component that got three pairs of another time last, which wait.
struct StampGateWithWaiting : testing::Test {
  StampGateWithWaiting() { pairs.send(counted(1'000, 5) + counted(500, 3)); }
  void expect_counted() const {
    EXPECT_EQ(StampSink::rejected("/stereo/left/image_rect"), 9U) << "by three inputs";
    EXPECT_EQ(StampSink::rejected("/stereo/right/image_rect"), 3U);
  }
  StampedPairs pairs{false};
};

TEST_F(StampGateWithWaiting, CountsNoneOfThem) {
  EXPECT_EQ(StampSink::rejected("/stereo/left/image_rect"), 0U);
  EXPECT_EQ(StampSink::rejected("/stereo/right/image_rect"), 0U);
}

TEST_F(StampGateWithWaiting, DropsAndCountsThemWhenDeactivatedAndReleasesNoneLater) {
  StampSink::state->set_active(false);
  expect_counted();
  pairs.send(counted(503, 2));
  expect_counted();
  StampSink::state->set_active(true);
  pairs.send(counted(505, 6));
  EXPECT_THAT(StampSink::pairs, ElementsAreArray(counted(1'000, 5) + counted(505, 6)));
  expect_counted();
}

TEST_F(StampGateWithWaiting, DropsAndCountsThemAtTheEndOfTheRun) {
  EXPECT_THAT(pairs.container().run(), testing::IsEmpty());
  EXPECT_THAT(StampSink::pairs, ElementsAreArray(counted(1'000, 5)));
  expect_counted();
}

TEST_F(StampGateWithWaiting, TellsThatTheyAreDroppedWhenUnloaded) {
  EXPECT_FALSE(pairs.log_contains("dropped"));
  EXPECT_TRUE(pairs.container().unload("stamp_sink"));
  EXPECT_TRUE(pairs.log_contains("/stereo/right/image_rect: dropped a message with a stamp behind its neighbours"));
}

}  // namespace
}  // namespace panvo::runtime
