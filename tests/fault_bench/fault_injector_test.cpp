// SPDX-License-Identifier: Apache-2.0
// The injector on synthetic topics: which messages pass, and under which name.
#include <gtest/gtest.h>

#include "fault.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/testing.hpp"

namespace panvo::test {
namespace {

using interfaces::Topic;
using nav_msgs::msg::Odometry;
using sensor_msgs::msg::Image;

constexpr Topic<Image> kCleanLeft{"clean/left", topics::kStereoLeftImageRaw.qos};
constexpr Topic<Image> kCleanRight{"clean/right", topics::kStereoRightImageRaw.qos};
constexpr Topic<Odometry> kCleanOdometry{"clean/odometry", topics::kOdometryBinocular.qos};
constexpr double kSpan_s = 20.0;
constexpr int kBegin_s = 1000;

struct FaultInjector : testing::Test {
  void load(const std::string& kind) {
    harness.load("panvo_fault_injector", "FaultInjectorComponent",
                 {{"kind", kind}, {"seed", "1"}, {"span_s", std::to_string(kSpan_s)}});
  }

  static std::int64_t stamp_ns(double t_s) { return kBegin_s * 1'000'000'000LL + static_cast<std::int64_t>(t_s * 1e9); }

  void show(double t_s) {
    for (const auto* topic : {&kCleanLeft, &kCleanRight}) {
      const auto image = conversions::make_image(stamp_ns(t_s), "eye", "mono8", 8, 6);
      conversions::pixels(*image).setTo(cv::Scalar(100));
      harness.publish(*topic, std::shared_ptr<const Image>(image));
    }
  }

  /// Middle of the fault's time interval.
  static double middle_s(const char* kind) {
    const auto window = fault_window(fault_kind(kind), 1, kSpan_s);
    return 0.5 * (window.from_s + window.to_s);
  }

  runtime::ComponentHarness harness;
};

TEST_F(FaultInjector, WithoutAFaultHandsOnTheVeryMessages) {
  const auto& clean = harness.collect(kCleanLeft);
  const auto& left = harness.collect(topics::kStereoLeftImageRaw);
  const auto& odometry = harness.collect(topics::kOdometryBinocular);
  load("none");
  show(0.0);
  harness.publish(kCleanOdometry, Odometry{});
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(&left[0]->data(), &clean[0]->data()) << "copied";
  EXPECT_EQ(odometry.size(), 1U);
}

TEST_F(FaultInjector, SpoilsImagesWithinTheWindowOnlyAndKeepsTheirFrames) {
  const auto& left = harness.collect(topics::kStereoLeftImageRaw);
  const auto& right = harness.collect(topics::kStereoRightImageRaw);
  load("both_black");
  for (const double t_s : {0.0, middle_s("both_black"), kSpan_s}) show(t_s);
  ASSERT_EQ(left.size(), 3U);
  ASSERT_EQ(right.size(), 3U);
  EXPECT_EQ(left[0]->data()[0], 100);
  EXPECT_EQ(left[1]->data()[0], 0);
  EXPECT_EQ(right[1]->data()[0], 0);
  EXPECT_EQ(left[2]->data()[0], 100);
  EXPECT_EQ(left[1]->header().frame_id(), "eye");
  EXPECT_EQ(conversions::stamp_ns(*left[1]), stamp_ns(middle_s("both_black")));
}

TEST_F(FaultInjector, StopsAComponentByTheTimeOfTheRecordingWhateverItsMessagesSay) {
  const auto& odometry = harness.collect(topics::kOdometryBinocular);
  load("odometry_stopped");
  for (const double t_s : {0.0, middle_s("odometry_stopped"), kSpan_s}) {
    show(t_s);
    harness.publish(kCleanOdometry, Odometry{});
  }
  EXPECT_EQ(odometry.size(), 2U);
}

TEST_F(FaultInjector, RefusesAKindThatThereIsNotAndNamesThoseThereAre) {
  try {
    load("melted");
    FAIL() << "an unknown kind was accepted";
  } catch (const runtime::ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("both_frozen"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace panvo::test
