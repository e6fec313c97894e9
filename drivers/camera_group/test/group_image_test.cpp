// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_group/group_image.hpp"

#include <gmock/gmock.h>

namespace panvo::camera_group {
namespace {

using camera_stream::Layout;
using camera_stream::roles_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(GroupImages, HaveTheCalibrationsOfAFolder) {
  std::vector<std::string> problems;
  const auto images = images_of(roles_of(Layout::kStereo, 2), PANVO_RIGS "/example", problems);
  EXPECT_THAT(problems, IsEmpty());
  ASSERT_EQ(images.size(), 2u);
  ASSERT_TRUE(images[0].calibration && images[1].calibration);
  EXPECT_EQ(images[0].calibration->p()[3], 0.0);
  EXPECT_LT(images[1].calibration->p()[3], 0.0) << "the right camera has the baseline";
  EXPECT_FALSE(images_of(roles_of(Layout::kStereo, 2), "", problems)[0].calibration);
}

TEST(GroupImages, WhoseCalibrationsAreMissingAreNamedAll) {
  std::vector<std::string> problems;
  images_of(roles_of(Layout::kStereo, 2), "nowhere", problems);
  EXPECT_THAT(problems, ElementsAre(HasSubstr("nowhere/left.yaml: cannot be opened"), HasSubstr("nowhere/right.yaml")));
}

}  // namespace
}  // namespace panvo::camera_group
