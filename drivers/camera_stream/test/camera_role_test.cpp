// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_stream/camera_role.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

namespace panvo::camera_stream {
namespace {

using ::testing::HasSubstr;

TEST(CameraRole, OfEachLayoutHasItsTopics) {
  EXPECT_EQ(roles_of(Layout::kMono, 1).at(0).images.name, "camera/image_raw");
  EXPECT_EQ(roles_of(Layout::kPanorama, 1).at(0).images.name, "panorama/image");
  const auto stereo = roles_of(Layout::kStereo, 2);
  EXPECT_EQ(stereo.at(0).images.name, "stereo/left/image_raw");
  EXPECT_EQ(stereo.at(1).infos.name, "stereo/right/camera_info");
  EXPECT_EQ(stereo.at(1).frame_id, "stereo_right_optical");
  const auto rig = roles_of(Layout::kRig, 6);
  ASSERT_EQ(rig.size(), 6u);
  EXPECT_EQ(rig[5].name, "head_5");
  EXPECT_EQ(rig[5].images.name, "panorama/head_5/image_raw");
}

TEST(CameraRole, SaysHowManyCamerasALayoutHas) {
  const auto problem = [](Layout layout, std::size_t cameras) -> std::string {
    try {
      roles_of(layout, cameras);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(problem(Layout::kStereo, 1), HasSubstr("two cameras, left and right; 1 given"));
  EXPECT_THAT(problem(Layout::kMono, 2), HasSubstr("one camera; 2 given"));
  EXPECT_THAT(problem(Layout::kRig, 7), HasSubstr("one to six heads; 7 given"));
  EXPECT_EQ(layout_of("rig"), Layout::kRig);
  EXPECT_THROW(layout_of("ring"), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::camera_stream
