// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <fstream>

#include "live_cameras.hpp"
#include "panvo/aravis_camera/device_list.hpp"
#include "panvo/runtime/errors.hpp"

namespace panvo::aravis_camera::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class CamerasInTrouble : public LiveCameras {
 protected:
  std::string load_error(const ParameterLines& parameters) {
    try {
      load(parameters);
    } catch (const runtime::ConfigError& error) {
      return error.what();
    }
    return "accepted";
  }
};

TEST_F(CamerasInTrouble, AWrongSerialNumberIsToldWithWhatIsThere) {
  start({"GVL@127.0.0.1", "GVR@127.0.0.2"});
  load({{"cameras", {"GVX"}}});
  ASSERT_TRUE(eventually([&] { return diagnostics("camera")["message"].find("GVX") != std::string::npos; })) << log();
  EXPECT_TRUE(log_contains("camera 'GVX' not found")) << log();
  EXPECT_TRUE(log_contains("GVL (Aravis Fake at 127.0.0.1)")) << log();
  EXPECT_TRUE(log_contains("GVR (Aravis Fake at 127.0.0.2)")) << log();
  EXPECT_EQ(diagnostics("camera")["level"], "2");
  EXPECT_GE(counter("camera", "failed tries to open"), 1u);
  EXPECT_EQ(count(kMono), 0u);
}

TEST_F(CamerasInTrouble, ACameraThatAnotherProgramHasIsSaidToBeInUseAndTakenWhenItIsFree) {
  start({"GVL@127.0.0.1"});
  load({{"cameras", {"GVL"}}});
  ASSERT_TRUE(eventually([&] { return count(kMono) > 5; })) << log();
  class Second : public CamerasInTrouble {
   public:
    void TestBody() override {}
    using CamerasInTrouble::count;
    using CamerasInTrouble::load;
    using CamerasInTrouble::log;
    using CamerasInTrouble::log_contains;
  } second;
  second.load({{"cameras", {"GVL"}}});
  ASSERT_TRUE(eventually([&] { return second.log_contains("GVL is in use: another program controls it"); }))
      << second.log();
  const auto before = count(kMono);
  EXPECT_TRUE(eventually([&] { return count(kMono) > before + 5; })) << "the first program continues\n" << log();
  EXPECT_EQ(second.count(kMono), 0u);
  unload();
  EXPECT_TRUE(eventually([&] { return second.count(kMono) > 5; })) << second.log();
}

TEST_F(CamerasInTrouble, ACameraInUseIsListedAsSuchAndNotDisturbed) {
  start({"GVL@127.0.0.1", "GVR@127.0.0.2"});
  load({{"cameras", {"GVL"}}});
  ASSERT_TRUE(eventually([&] { return count(kMono) > 5; })) << log();
  std::map<std::string, camera_stream::FoundDevice> devices;
  for (const auto& device : find_devices()) devices[device.serial] = device;
  EXPECT_EQ(devices["GVL"].problem, "is in use: another program controls it");
  EXPECT_EQ(devices["GVR"].problem, "");
  EXPECT_EQ(devices["GVR"].address, "127.0.0.2");
  EXPECT_EQ(devices["GVR"].protocol, "GigEVision");
  EXPECT_THAT(devices["GVR"].formats, ::testing::IsSupersetOf({"Mono8", "Mono16", "BayerRG8", "RGB8"}));
  EXPECT_EQ(devices["GVR"].sizes, "512 x 512, up to 2048 x 2048 px");
  EXPECT_EQ(devices["GVR"].rates, "25 Hz, 0.1 to 1000 Hz");
  const auto before = count(kMono);
  EXPECT_TRUE(eventually([&] { return count(kMono) > before + 20; })) << log();
  EXPECT_EQ(counter("camera", "reconnects"), 0u);
}

TEST_F(CamerasInTrouble, SettingsThatTheCameraRefusesAreNamedOneByOne) {
  start({"GVL@127.0.0.1"});
  load({{"cameras", {"GVL"}},
        {"pixel_format", {"Mono12p"}},
        {"clock", {"ptp"}},
        {"features",
         {"NoSuchThing=1", "GainRaw=99999", "GainAuto=Sometimes", "BinningHorizontal=x", "TestBoolean=maybe",
          "DeviceVendorName=x", "GainRaw=3"}}});
  ASSERT_TRUE(eventually([&] { return count(kMono) > 0 && counter("camera", "frames") > 0; })) << log();
  for (const char* text : {"features: NoSuchThing=1: the camera has no feature of that name",
                           "features: GainRaw=99999: is out of range, 0 to",
                           "features: GainAuto=Sometimes: is not a valid choice; choices: Off, Once, Continuous",
                           "features: BinningHorizontal=x: is not a whole number",
                           "features: TestBoolean=maybe: is neither true nor false", "features: DeviceVendorName=x:",
                           "pixel_format Mono12p: the camera has ", "clock ptp: the camera has no PTP"})
    EXPECT_TRUE(log_contains(text)) << text << "\n" << log();
  EXPECT_FALSE(log_contains("GainRaw=3:")) << log();
  EXPECT_EQ(counter("camera", "refused settings"), 8u);
  EXPECT_EQ(diagnostics("camera")["level"], "1");
}

TEST_F(CamerasInTrouble, ACalibrationForAnotherSizeIsToldAndNotPublished) {
  start({"GVL@127.0.0.1", "GVR@127.0.0.2"});
  load({{"layout", {"stereo"}},
        {"cameras", {"GVL", "GVR"}},
        {"width", {"128"}},
        {"height", {"96"}},
        {"calibration", {PANVO_RIGS "/example"}}});
  ASSERT_TRUE(eventually([&] { return count(kLeft) > 5 && diagnostics("left").contains("calibration"); })) << log();
  EXPECT_TRUE(log_contains("left: the calibration is for 640 x 480 px, the camera sends 128 x 96 px")) << log();
  EXPECT_EQ(count("/stereo/left/camera_info"), 0u);
}

TEST_F(CamerasInTrouble, ACalibrationThatFitsGoesWithEachImage) {
  start({"GVL@127.0.0.1", "GVR@127.0.0.2"});
  load({{"layout", {"stereo"}},
        {"cameras", {"GVL", "GVR"}},
        {"width", {"640"}},
        {"height", {"480"}},
        {"calibration", {PANVO_RIGS "/example"}},
        {"mount", {"1", "0", "1.5", "0", "0", "0"}}});
  ASSERT_TRUE(eventually([&] { return count(kRight) > 5; })) << log();
  unload();
  EXPECT_EQ(count("/stereo/left/camera_info"), count(kLeft));
  EXPECT_EQ(count("/stereo/right/camera_info"), count(kRight));
  EXPECT_EQ(count("/tf_static"), 1u);
}

TEST_F(CamerasInTrouble, ParametersThatMakeNoSenseAreRefusedAtOnce) {
  EXPECT_THAT(load_error({{"layout", {"stereo"}}, {"cameras", {"GVL"}}}),
              AllOf(HasSubstr("two cameras"), HasSubstr("panvo devices")));
  EXPECT_THAT(load_error({{"layout", {"stereo"}}, {"cameras", {"GVL", "GVL"}}}), HasSubstr("GVL is named twice"));
  EXPECT_THAT(load_error({{"features", {"Gain"}}}), HasSubstr("'Gain' is not a setting; write name=value"));
  EXPECT_THAT(load_error({{"features", {"left:Gain=1"}}}), HasSubstr("unknown camera 'left'; cameras: camera"));
  EXPECT_THAT(load_error({{"calibration", {"nowhere"}}}), HasSubstr("nowhere/camera.yaml: cannot be opened"));
  EXPECT_THAT(load_error({{"mount", {"1", "2"}}}), HasSubstr("mount: has 2 numbers"));
  EXPECT_THAT(load_error({{"trigger", {"hardware"}}}), HasSubstr("trigger"));
}

}  // namespace
}  // namespace panvo::aravis_camera::testing
