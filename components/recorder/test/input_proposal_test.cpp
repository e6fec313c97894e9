// SPDX-License-Identifier: Apache-2.0
#include "panvo/recorder/input_proposal.hpp"

#include <gmock/gmock.h>

namespace panvo::recorder {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr const char* kImage = "sensor_msgs/msg/Image";
constexpr const char* kCompressedImage = "sensor_msgs/msg/CompressedImage";
constexpr const char* kInfo = "sensor_msgs/msg/CameraInfo";

BagTopic recorded(const std::string& name, const std::string& type, std::uint64_t count = 100) {
  BagTopic result;
  result.name = name;
  result.type = type;
  result.message_count = count;
  return result;
}

TEST(InputProposal, RenamesAPairWithItsCameraInfo) {
  const auto proposal = propose_inputs(
      {recorded("/camera/infra1/image_rect_raw", kImage), recorded("/camera/infra2/image_rect_raw", kImage),
       recorded("/camera/infra1/camera_info", kInfo), recorded("/camera/infra2/camera_info", kInfo),
       recorded("/camera/depth/image_rect_raw", kImage), recorded("/camera/color/image_raw", kImage)});
  EXPECT_TRUE(proposal.has_stereo);
  EXPECT_TRUE(proposal.has_camera_info);
  EXPECT_FALSE(proposal.has_panorama);
  EXPECT_THAT(proposal.renames, ElementsAre(TopicRename{"/camera/infra1/image_rect_raw", "/stereo/left/image_rect"},
                                            TopicRename{"/camera/infra2/image_rect_raw", "/stereo/right/image_rect"},
                                            TopicRename{"/camera/infra1/camera_info", "/stereo/left/camera_info"},
                                            TopicRename{"/camera/infra2/camera_info", "/stereo/right/camera_info"}));
}

TEST(InputProposal, PrefersRectifiedGreyImages) {
  const auto proposal = propose_inputs({recorded("/zed/zed_node/left_raw/image_raw_color", kImage),
                                        recorded("/zed/zed_node/right_raw/image_raw_color", kImage),
                                        recorded("/zed/zed_node/left/image_rect_color", kImage),
                                        recorded("/zed/zed_node/right/image_rect_color", kImage),
                                        recorded("/zed/zed_node/left/image_rect_gray", kImage),
                                        recorded("/zed/zed_node/right/image_rect_gray", kImage),
                                        recorded("/zed/zed_node/depth/depth_registered", kImage)});
  EXPECT_THAT(proposal.renames,
              ElementsAre(TopicRename{"/zed/zed_node/left/image_rect_gray", "/stereo/left/image_rect"},
                          TopicRename{"/zed/zed_node/right/image_rect_gray", "/stereo/right/image_rect"}));
  EXPECT_FALSE(proposal.has_camera_info);
}

TEST(InputProposal, KnowsThePairOfEarlyBagsAndThePanorama) {
  const auto proposal = propose_inputs(
      {recorded("/cam0/image_raw", "sensor_msgs/Image"), recorded("/cam1/image_raw", "sensor_msgs/Image"),
       recorded("/insta360/equirectangular/image", kImage), recorded("/insta360/dual_fisheye/image", kImage)});
  EXPECT_THAT(proposal.renames, ElementsAre(TopicRename{"/cam0/image_raw", "/stereo/left/image_raw"},
                                            TopicRename{"/cam1/image_raw", "/stereo/right/image_raw"},
                                            TopicRename{"/insta360/equirectangular/image", "/panorama/image"}));
  EXPECT_TRUE(proposal.has_panorama);
}

TEST(InputProposal, ReadsCompressedImagesOnlyIfTheyAreRaw) {
  const auto proposal =
      propose_inputs({recorded("/oak/left/image_rect/compressed", kCompressedImage),
                      recorded("/oak/right/image_rect/compressed", kCompressedImage),
                      recorded("/oak/left/image_raw/compressed", kCompressedImage),
                      recorded("/oak/right/image_raw/compressed", kCompressedImage),
                      recorded("/oak/left/camera_info", kInfo), recorded("/oak/right/camera_info", kInfo)});
  EXPECT_TRUE(proposal.is_compressed);
  EXPECT_TRUE(proposal.has_camera_info);
  ASSERT_EQ(proposal.renames.size(), 4u);
  EXPECT_EQ(proposal.renames[0], (TopicRename{"/oak/left/image_raw/compressed", "/stereo/left/image_raw/compressed"}));
}

TEST(InputProposal, LeavesPanvosOwnNamesAlone) {
  const auto proposal =
      propose_inputs({recorded("/stereo/left/image_raw", kImage), recorded("/stereo/right/image_raw", kImage),
                      recorded("/stereo/left/camera_info", kInfo), recorded("/stereo/right/camera_info", kInfo),
                      recorded("/panorama/image", kImage)});
  EXPECT_TRUE(proposal.has_stereo && proposal.has_camera_info && proposal.has_panorama);
  EXPECT_THAT(proposal.renames, IsEmpty());
}

TEST(InputProposal, DoesNotTakeOneCameraOrAnEmptyTopicForAPair) {
  EXPECT_FALSE(
      propose_inputs({recorded("/cam0/image_raw", kImage), recorded("/cam1/image_raw", kImage, 0)}).has_stereo);
  EXPECT_FALSE(propose_inputs({recorded("/left/image", kImage), recorded("/right/camera_info", kInfo)}).has_stereo);
  EXPECT_FALSE(propose_inputs({recorded("/leftover/image", kImage), recorded("/rightover/image", kImage)}).has_stereo);
  EXPECT_FALSE(propose_inputs({}).has_stereo);
}

}  // namespace
}  // namespace panvo::recorder
