// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>

#include "mounting.hpp"
#include "panvo/aravis_camera/device_list.hpp"
#include "panvo/aravis_camera/ptp_stamps.hpp"
#include "panvo/conversions/pose.hpp"
#include "parameters.hpp"
#include "software_trigger.hpp"

namespace panvo::aravis_camera {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr std::int64_t kSecond = 1'000'000'000;

MATCHER_P2(Sets, name, value, "") { return arg.name == name && arg.value == value; }

TEST(FeaturesOfACamera, KeepTheirOrderAndAreForAllOrForOne) {
  const std::vector<std::string> lines{"UserSetLoad=", "left: Gain = 3", "right:Gain=4", "Name=a=b"};
  EXPECT_THAT(features_of(lines, "left", {"left", "right"}),
              testing::ElementsAre(Sets("UserSetLoad", ""), Sets("Gain", "3"), Sets("Name", "a=b")));
  EXPECT_THAT(features_of(lines, "right", {"left", "right"}),
              testing::ElementsAre(Sets("UserSetLoad", ""), Sets("Gain", "4"), Sets("Name", "a=b")));
}

TEST(FeaturesOfACamera, AreRefusedWhereTheyAreNone) {
  EXPECT_THROW(features_of({"Gain"}, "left", {"left"}), SettingsError);
  EXPECT_THROW(features_of({"=3"}, "left", {"left"}), SettingsError);
  EXPECT_THROW(features_of({"middle:Gain=3"}, "left", {"left", "right"}), SettingsError);
}

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
  EXPECT_EQ(to_text({}), "no camera answers");
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
  ASSERT_THAT(cameras, SizeIs(2));
  EXPECT_EQ(cameras[0].settings.camera.camera, "L");
  EXPECT_EQ(cameras[1].role.name, "right");
  EXPECT_THAT(cameras[0].settings.camera.features, SizeIs(0));
  EXPECT_THAT(cameras[1].settings.camera.features, SizeIs(1));
  EXPECT_EQ(cameras[0].settings.camera.trigger, Trigger::kLine);
  EXPECT_EQ(cameras[0].settings.stamps, StampSource::kPtp);
  EXPECT_TRUE(cameras[0].settings.camera.ptp);
  EXPECT_EQ(cameras[0].settings.camera.packet_delay_ns, 1000);
}

TEST(Mounting, PlacesTheLeftCameraAndTheRightOneByTheCalibration) {
  Parameters parameters;
  parameters.layout = "stereo";
  parameters.cameras = {"L", "R"};
  parameters.calibration = PANVO_RIGS "/example";
  const auto cameras = cameras_of(parameters);
  const auto message = mounting({1.0, 0.06, 1.5, 0, 0, 90}, cameras, 7);
  ASSERT_THAT(message.transforms(), SizeIs(2));
  const auto left = *conversions::to_isometry(message.transforms()[0].transform());
  const auto right = *conversions::to_isometry(message.transforms()[1].transform());
  EXPECT_EQ(message.transforms()[1].child_frame_id(), "stereo_right_optical");
  // Turned by 90 degrees to the left, the camera looks along +y; its right is +x, and the other camera 0.12 m that way.
  EXPECT_TRUE((left.linear() * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitY(), 1e-9));
  EXPECT_TRUE(left.translation().isApprox(Eigen::Vector3d(1.0, 0.06, 1.5)));
  EXPECT_TRUE((right.translation() - left.translation()).isApprox(Eigen::Vector3d(0.12, 0, 0), 1e-9))
      << right.translation();
}

TEST(Mounting, TakesSixNumbersForEachCamera) {
  Parameters parameters;
  parameters.layout = "rig";
  parameters.cameras = {"A", "B", "C"};
  const auto cameras = cameras_of(parameters);
  EXPECT_THAT(mounting({}, cameras, 0).transforms(), SizeIs(0));
  EXPECT_THAT(mounting(std::vector<double>(18, 0.0), cameras, 0).transforms(), SizeIs(3));
  EXPECT_THROW(mounting(std::vector<double>(12, 0.0), cameras, 0), SettingsError);
}

}  // namespace
}  // namespace panvo::aravis_camera
