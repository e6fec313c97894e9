// SPDX-License-Identifier: Apache-2.0
#include "live_cameras.hpp"
#include "panvo/aravis_camera/device_list.hpp"

namespace panvo::aravis_camera::testing {
namespace {

using camera_stream::FoundDevice;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;

/// Aravis's built-in simulated camera, within this process, without protocol and network.
class SimulatedCamera : public LiveCameras {};

TEST_F(SimulatedCamera, StreamsAsARealOneDoes) {
  load({{"simulated", {"true"}},
        {"cameras", {"Fake_1"}},
        {"width", {"320"}},
        {"height", {"240"}},
        {"frame_rate_hz", {"50"}}});
  ASSERT_TRUE(eventually([&] { return count(kMono) >= 20 && counter("camera", "frames") > 0; })) << log();
  unload();
  const auto pictures = seen(kMono);
  EXPECT_EQ(pictures.front().width, 320);
  EXPECT_EQ(pictures.front().encoding, "mono8");
  for (std::size_t i = 1; i < pictures.size(); ++i) ASSERT_GT(pictures[i].stamp_ns, pictures[i - 1].stamp_ns);
}

TEST_F(SimulatedCamera, IsLoadedAndUnloadedAgainAndAgain) {
  for (int i = 1; i <= 5; ++i) {
    const auto before = count(kMono);
    load({{"simulated", {"true"}}, {"cameras", {"Fake_1"}}, {"width", {"64"}}, {"height", {"48"}}});
    ASSERT_TRUE(eventually([&] { return count(kMono) > before; })) << log();
    unload();
  }
}

TEST_F(SimulatedCamera, IsListedWithWhatItCanDo) {
  enable_simulated_camera();
  const auto devices = find_devices();
  EXPECT_THAT(devices, Contains(AllOf(Field(&FoundDevice::serial, "1"), Field(&FoundDevice::formats, Contains("Mono8")),
                                      Field(&FoundDevice::sizes, HasSubstr("up to 2048 x 2048 px")))));
}

}  // namespace
}  // namespace panvo::aravis_camera::testing
