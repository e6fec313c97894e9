// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/camera.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace panvo::vision {
namespace {

using ::testing::SizeIs;

TEST(PinholeCamera, ProjectsWhatItUnprojects) {
  const PinholeCamera camera{400.0, 410.0, 320.0, 240.0, 640, 480};
  const Eigen::Vector2d pixel(17.25, 401.5);
  EXPECT_LT((camera.project(7.0 * camera.unproject(pixel)) - pixel).norm(), 1e-12);
}

TEST(PinholeCamera, ContainsItsCornersButNotBeyond) {
  const PinholeCamera camera{400.0, 410.0, 320.0, 240.0, 640, 480};
  EXPECT_TRUE(camera.contains({0.0, 0.0}));
  EXPECT_TRUE(camera.contains({639.0, 479.0}));
  EXPECT_FALSE(camera.contains({639.1, 100.0}));
  EXPECT_FALSE(camera.contains({4.0, 100.0}, 5.0));
}

TEST(RectifiedStereo, HasABaselineThatIsAPositiveNumber) {
  for (const double baseline_m : {0.0, -0.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT(validate(RectifiedStereo{{400, 400, 320, 240, 640, 480}, baseline_m}), SizeIs(1));
  }
}

}  // namespace
}  // namespace panvo::vision
