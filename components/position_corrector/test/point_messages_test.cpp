// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/point_messages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "corrector_on_topics.hpp"

namespace panvo::position_corrector {
namespace {

/// The offset of a field of a point, which must exist.
std::size_t offset_of(const sensor_msgs::msg::PointCloud2& cloud, const std::string& name) {
  for (const auto& field : cloud.fields()) {
    if (field.name() == name) return field.offset();
  }
  ADD_FAILURE() << name;
  return 0;
}

float value_of(const sensor_msgs::msg::PointCloud2& cloud, std::size_t point, const std::string& name) {
  float value = 0.0F;
  std::memcpy(&value, &cloud.data()[point * cloud.point_step() + offset_of(cloud, name)], sizeof value);
  return value;
}

TEST_F(CorrectorOnTopics, TellsAReaderWhichPointsOfTheLandmarkItSees) {
  const auto& clouds = harness.collect(kLandmarkPoints);
  publish_landmark(2, 2);
  publish_odometry(200.0, 1.0);
  publish_panorama(turned(place(2), 270));  // a quarter of a turn to the left
  ASSERT_EQ(clouds.size(), 1U);
  const auto& cloud = *clouds[0];
  EXPECT_EQ(conversions::to_ns(cloud.header().stamp()), kPeriod_ns);
  EXPECT_EQ(cloud.header().frame_id(), "panorama");
  ASSERT_GE(cloud.width(), 12U);
  ASSERT_EQ(cloud.data().size(), std::size_t{cloud.width()} * cloud.point_step());
  std::uint32_t agreeing = 0;
  for (std::size_t i = 0; i < cloud.width(); ++i) {
    std::uint32_t landmark = 0;
    std::memcpy(&landmark, &cloud.data()[i * cloud.point_step() + offset_of(cloud, "landmark")], sizeof landmark);
    EXPECT_EQ(landmark, 2U);
    if (cloud.data()[i * cloud.point_step() + offset_of(cloud, "state")] != 1) continue;
    ++agreeing;
    // what was ahead is seen at the right: the column grows by a quarter of the width
    const float shift = value_of(cloud, i, "u") - value_of(cloud, i, "place_u");
    EXPECT_NEAR(shift - std::floor(shift), 0.25F, 0.01F);
    EXPECT_NEAR(value_of(cloud, i, "v"), value_of(cloud, i, "place_v"), 0.01F);
    const float x = value_of(cloud, i, "x"), z = value_of(cloud, i, "z");
    EXPECT_NEAR(std::remainder(std::atan2(x, z) / (2.0 * M_PI) + 0.5 - value_of(cloud, i, "u"), 1.0), 0.0, 0.01);
  }
  EXPECT_EQ(agreeing, corrections.at(0)->inliers());
}

}  // namespace
}  // namespace panvo::position_corrector
