// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>

#include "panvo/aravis_camera/device_list.hpp"
#include "panvo/aravis_camera/ptp_stamps.hpp"
#include "parameters.hpp"
#include "software_trigger.hpp"

namespace panvo::aravis_camera {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr std::int64_t kSecond = 1'000'000'000;

TEST(PtpStamps, AreTheHostsButForTheLeapSeconds) {
  const std::int64_t host_ns = 1'700'000'000 * kSecond + 123'456'789;
  PtpStamps utc;
  EXPECT_EQ(utc.to_host_ns(host_ns, host_ns + 20'000'000), host_ns);
  EXPECT_EQ(utc.problem(), "");
  PtpStamps tai;
  for (int i = 0; i < 100; ++i) {
    const std::int64_t taken_ns = host_ns + i * kSecond / 30;
    EXPECT_EQ(tai.to_host_ns(taken_ns + 37 * kSecond, taken_ns + 20'000'000), taken_ns);
  }
  EXPECT_EQ(tai.problem(), "");
}

TEST(PtpStamps, AreNotTrustedWhereTheHostFollowsAnotherClock) {
  const std::int64_t host_ns = 1'700'000'000 * kSecond;
  PtpStamps half_a_second, hours;
  half_a_second.to_host_ns(host_ns - kSecond * 45 / 100, host_ns);
  EXPECT_THAT(half_a_second.problem(), HasSubstr("differ by -0.450 s"));
  hours.to_host_ns(host_ns - 7200 * kSecond, host_ns);
  EXPECT_THAT(hours.problem(), HasSubstr("phc2sys"));
}

TEST(PtpStamps, AreTheTimeOfArrivalUntilTheCameraHasFoundItsMaster) {
  const std::int64_t host_ns = 1'700'000'000 * kSecond, way_ns = 20'000'000;
  PtpStamps stamps;
  EXPECT_EQ(stamps.to_host_ns(12 * kSecond, host_ns), host_ns) << "the camera counts from its start";
  EXPECT_THAT(stamps.problem(), HasSubstr("phc2sys"));
  const std::int64_t taken_ns = host_ns + kSecond;
  EXPECT_EQ(stamps.to_host_ns(taken_ns + 37 * kSecond, taken_ns + way_ns), taken_ns);
  EXPECT_EQ(stamps.problem(), "");
  EXPECT_EQ(stamps.to_host_ns(taken_ns + 38 * kSecond, taken_ns + 2 * kSecond), taken_ns + kSecond) << "a busy host";
  EXPECT_EQ(stamps.problem(), "");
}

TEST(SoftwareTrigger, IsDueOncePerPeriodAndTogetherWithOthers) {
  SoftwareTrigger one(20.0), other(20.0);
  int times = 0;
  for (std::int64_t t = 7'000'000; t < kSecond; t += 1'000'000) {
    const bool is_due = one.is_due(t);
    EXPECT_EQ(other.is_due(t), is_due);
    if (is_due) {
      EXPECT_EQ(t % 50'000'000, 0);
    }
    times += is_due;
  }
  EXPECT_EQ(times, 19);
  EXPECT_EQ(one.until_due_ns(70'000'000), 30'000'000);
}

TEST(Cameras, AreMeantByWhateverTheyAreKnownBy) {
  const Announced device{"Maker-1", "Maker", "Cam", "0815", "10.0.0.2", "00:11:22:33:44:55", "GigEVision"};
  for (const char* selector : {"Maker-1", "Cam", "0815", "10.0.0.2", "00:11:22:33:44:55"})
    EXPECT_TRUE(is_meant(device, selector)) << selector;
  EXPECT_FALSE(is_meant(device, "Maker"));
  EXPECT_FALSE(is_meant(device, ""));
  EXPECT_THAT(to_text({device}), HasSubstr("0815 (Maker Cam at 10.0.0.2)"));
  EXPECT_EQ(to_text({}), "none");
}

TEST(Cameras, GetTheirSettingsFromTheParameters) {
  Parameters parameters;
  parameters.layout = "stereo";
  parameters.cameras = {"L", "R"};
  parameters.features = {"right:Gain=4"};
  parameters.trigger = "line";
  parameters.clock = "ptp";
  parameters.packet_delay_ns = 1000;
  const auto cameras = cameras_of(parameters);
  ASSERT_THAT(cameras.devices, SizeIs(2));
  const auto& [left, right] = std::tie(cameras.devices[0], cameras.devices[1]);
  EXPECT_EQ(left.camera.camera, "L");
  EXPECT_EQ(right.name, "right");
  EXPECT_THAT(left.camera.features, SizeIs(0));
  EXPECT_THAT(right.camera.features, testing::ElementsAre(camera_group::DeviceSetting{"Gain", "4"}));
  EXPECT_EQ(left.camera.trigger, Trigger::kLine);
  EXPECT_EQ(left.stamps, StampSource::kPtp);
  EXPECT_TRUE(left.camera.ptp);
  EXPECT_EQ(left.camera.packet_delay_ns, 1000);
  ASSERT_THAT(cameras.images, SizeIs(2));
  EXPECT_EQ(cameras.images[1].role.name, "right");
}

}  // namespace
}  // namespace panvo::aravis_camera
