// SPDX-License-Identifier: Apache-2.0
#include "parameters.hpp"

#include <gmock/gmock.h>

#include "panvo/runtime/errors.hpp"

namespace panvo::v4l2_camera {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

Parameters with_layout(const std::string& layout, const std::vector<std::string>& cameras = {}) {
  Parameters parameters;
  parameters.layout = layout;
  parameters.cameras = cameras;
  return parameters;
}

std::vector<std::string> topics_of(const camera_group::CameraSet<CameraSettings>& group) {
  std::vector<std::string> topics;
  for (const auto& image : group.images) topics.emplace_back(image.role.images.name);
  return topics;
}

std::string problem_of(const Parameters& parameters) {
  try {
    cameras_of(parameters);
  } catch (const runtime::ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Layouts, SayWhatIsPublishedOfHowManyCameras) {
  EXPECT_THAT(topics_of(cameras_of(with_layout("mono"))), ElementsAre("camera/image_raw"));
  EXPECT_THAT(topics_of(cameras_of(with_layout("panorama"))), ElementsAre("panorama/image"));
  EXPECT_THAT(topics_of(cameras_of(with_layout("dual_fisheye"))), ElementsAre("panorama/head_0/image_raw"));
  for (const char* layout : {"side_by_side", "top_bottom", "byte_interleaved"}) {
    const auto group = cameras_of(with_layout(layout, {"S1"}));
    EXPECT_THAT(topics_of(group), ElementsAre("stereo/left/image_raw", "stereo/right/image_raw")) << layout;
    ASSERT_THAT(group.devices, SizeIs(1)) << layout;
    EXPECT_THAT(group.devices[0].frame_ids, ElementsAre("stereo_left_optical", "stereo_right_optical")) << layout;
    EXPECT_NE(group.devices[0].parts.parts, ImageParts::kOne) << layout;
  }
  const auto pair = cameras_of(with_layout("stereo", {"S1", "S2"}));
  ASSERT_THAT(pair.devices, SizeIs(2));
  EXPECT_EQ(pair.devices[1].name, "right");
  EXPECT_THAT(pair.devices[1].frame_ids, ElementsAre("stereo_right_optical"));
  EXPECT_THAT(cameras_of(with_layout("rig", {"A", "B", "C"})).images, SizeIs(3));
}

TEST(Layouts, AreRefusedWithTheWrongNumberOfCameras) {
  EXPECT_THAT(problem_of(with_layout("stereo", {"S1"})), AllOf(HasSubstr("two cameras"), HasSubstr("panvo devices")));
  EXPECT_THAT(problem_of(with_layout("side_by_side", {"S1", "S2"})), HasSubstr("side_by_side has one camera; 2 given"));
  EXPECT_THAT(problem_of(with_layout("stereo", {"S1", "S1"})), HasSubstr("S1 is named twice"));
}

TEST(ParametersOfCameras, BecomeTheirSettings) {
  Parameters parameters = with_layout("byte_interleaved", {"S1"});
  parameters.swap_eyes = true;
  parameters.interleaved = "bayer_gbrg8";
  parameters.pixel_format = "Y16";
  parameters.frame_rate_hz = 20.0;
  parameters.encoding = "grey";
  parameters.clock = "arrival";
  parameters.watchdog_s = 0.5;
  parameters.controls = {"White Balance, Automatic=3"};
  const auto settings = cameras_of(parameters).devices.at(0);
  EXPECT_EQ(settings.parts.parts, ImageParts::kByteInterleaved);
  EXPECT_TRUE(settings.parts.swap);
  EXPECT_EQ(settings.parts.interleaved, camera_stream::PixelFormat::kBayerGB8);
  EXPECT_EQ(settings.format.pixel_format, "Y16");
  EXPECT_TRUE(settings.format.prefers_grey);
  EXPECT_EQ(settings.output, camera_stream::ImageOutput::kGrey);
  EXPECT_EQ(settings.stamps, StampSource::kArrival);
  EXPECT_EQ(settings.watchdog_ns, 500'000'000);
  EXPECT_THAT(settings.controls, ElementsAre(camera_group::DeviceSetting{"white_balance_automatic", "3"}));
}

TEST(ParametersOfCameras, AreRefusedWhereTheyMakeNoSense) {
  Parameters parameters;
  parameters.controls = {"gain", "left:gain=3"};
  parameters.calibration = "nowhere";
  EXPECT_THAT(problem_of(parameters), AllOf(HasSubstr("'gain' is not a setting; write name=value"),
                                            HasSubstr("nowhere/camera.yaml: cannot be opened")));
  parameters.controls = {"left:gain=3"};
  EXPECT_THAT(problem_of(parameters), HasSubstr("unknown camera 'left'; cameras: camera"));
}

}  // namespace
}  // namespace panvo::v4l2_camera
