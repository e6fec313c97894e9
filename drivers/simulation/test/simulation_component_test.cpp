// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "panvo/conversions/camera_info.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_buffer.hpp"
#include "panvo/interfaces/node_topics.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/testing.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::simulation {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr const char* kPackage = "panvo_simulation";
constexpr const char* kPlugin = "SimulationComponent";

class SimulationComponent : public ::testing::Test {
 protected:
  std::string rig(const std::string& panorama) const {
    return folder_.write("rig.yaml", "stereo: {size_px: [80, 60]}\npanorama: " + panorama + "\n");
  }
  std::map<std::string, std::string> parameters(const std::string& panorama) const {
    return {
        {"route", PANVO_CONFIG "/routes/short.yaml"}, {"rig", rig(panorama)}, {"start_s", "8"}, {"duration_s", "0.4"}};
  }

  panvo::test::TemporaryFolder folder_;
  runtime::ComponentHarness harness_;
};

/// Of what a panorama of 128x64 pixels shows 60 degrees below the horizon.
double blue_to_red_below(const sensor_msgs::msg::Image& panorama) {
  double red = 0.0, blue = 0.0;
  for (std::size_t i = 128 * 3 * 53; i < 128 * 3 * 54; i += 3)
    red += panorama.data()[i], blue += panorama.data()[i + 2];
  return blue / red;
}

TEST_F(SimulationComponent, PublishesWhatAVehicleWithThisRigWould) {
  const auto& left = harness_.collect(topics::kStereoLeftImageRaw);
  const auto& right = harness_.collect(topics::kStereoRightImageRaw);
  const auto& left_info = harness_.collect(topics::kStereoLeftCameraInfo);
  const auto& right_info = harness_.collect(topics::kStereoRightCameraInfo);
  const auto& panorama = harness_.collect(topics::kPanorama);
  const auto& truth = harness_.collect(topics::kGroundTruth);
  const auto& clock = harness_.collect(topics::kClock);
  const auto& tf = harness_.collect(topics::kTfStatic);
  harness_.load(kPackage, kPlugin, parameters("{size_px: [128, 64]}"));
  EXPECT_THAT(harness_.container().run(), IsEmpty());

  ASSERT_THAT(left, SizeIs(11));  // 25 Hz for 0.4 s, both ends
  ASSERT_THAT(right, SizeIs(11));
  ASSERT_THAT(left_info, SizeIs(11));
  ASSERT_THAT(panorama, SizeIs(3));
  ASSERT_THAT(truth, SizeIs(11));
  ASSERT_THAT(clock, SizeIs(11));
  EXPECT_EQ(left[0]->encoding(), "mono8");
  EXPECT_EQ(panorama[0]->encoding(), "rgb8");
  EXPECT_EQ(panorama[0]->width(), 128u);
  EXPECT_GT(blue_to_red_below(*panorama.back()), 1.5);  // the paint of the vehicle's roof
  for (std::size_t i = 0; i < left.size(); ++i) {
    EXPECT_EQ(conversions::stamp_ns(*left[i]), conversions::stamp_ns(*right[i]));
    EXPECT_EQ(conversions::stamp_ns(*left[i]), conversions::stamp_ns(*left_info[i]));
    EXPECT_EQ(conversions::stamp_ns(*left[i]), conversions::stamp_ns(*truth[i]));
    EXPECT_EQ(conversions::stamp_ns(*left[i]), conversions::to_ns(clock[i]->clock()));
  }
  EXPECT_EQ(conversions::stamp_ns(*left[1]) - conversions::stamp_ns(*left[0]), 40'000'000);
  // It drives at several metres per second along its own x axis.
  EXPECT_GT(truth[5]->twist().twist().linear().x(), 2.0);
  EXPECT_NEAR(truth[5]->twist().twist().linear().y(), 0.0, 0.2);

  const auto stereo =
      conversions::to_stereo(*conversions::to_camera(*left_info[0]), *conversions::to_camera(*right_info[0]));
  ASSERT_TRUE(stereo);
  EXPECT_NEAR(stereo->baseline_m, 0.12, 1e-9);
  ASSERT_THAT(tf, SizeIs(1));
  conversions::TransformBuffer transforms;
  EXPECT_THAT(transforms.add_static(*tf[0]), IsEmpty());
  EXPECT_TRUE(transforms.lookup("base_link", left[0]->header().frame_id())
                  ->translation()
                  .isApprox(Eigen::Vector3d(1.9, 0.06, 1.3)));
  EXPECT_TRUE(transforms.lookup("base_link", panorama[0]->header().frame_id()));
}

TEST_F(SimulationComponent, TheVehicleIsThatOfItsRig) {
  const auto& panorama = harness_.collect(topics::kPanorama);
  const auto& truth = harness_.collect(topics::kGroundTruth);
  harness_.load(kPackage, kPlugin, parameters("{size_px: [128, 64]}\nvehicle: {has_body: false, speed_m_per_s: 0.6}"));
  EXPECT_THAT(harness_.container().run(), IsEmpty());
  EXPECT_LT(blue_to_red_below(*panorama.back()), 1.4);  // asphalt under a blue sky
  ASSERT_THAT(truth, SizeIs(11));
  EXPECT_NEAR(truth[5]->twist().twist().linear().x(), 0.6, 0.02);  // on the straight road before the loop
}

TEST_F(SimulationComponent, PublishesEachHeadOfARigOfSeveral) {
  const auto& whole = harness_.collect(topics::kPanorama);
  const auto& second = harness_.collect(topics::kPanoramaHeadImageRaw[1]);
  const auto& info = harness_.collect(topics::kPanoramaHeadCameraInfo[1]);
  const auto& third = harness_.collect(topics::kPanoramaHeadImageRaw[2]);
  harness_.load(kPackage, kPlugin, parameters("{kind: dual_fisheye, size_px: [96, 96]}"));
  EXPECT_THAT(harness_.container().run(), IsEmpty());
  EXPECT_THAT(whole, IsEmpty());
  EXPECT_THAT(third, IsEmpty());
  ASSERT_THAT(second, SizeIs(3));
  ASSERT_THAT(info, SizeIs(3));
  EXPECT_EQ(info[0]->distortion_model(), "equidistant");
  EXPECT_EQ(info[0]->header().frame_id(), second[0]->header().frame_id());
}

TEST_F(SimulationComponent, SaysWhatItCannotSimulate) {
  const auto refusal = [&](std::map<std::string, std::string> parameters) -> std::string {
    try {
      harness_.load(kPackage, kPlugin, parameters);
    } catch (const runtime::ConfigError& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_THAT(refusal({}), HasSubstr("route"));
  EXPECT_THAT(refusal({{"junctions", "[gate, moon]"}}), HasSubstr("moon"));
  EXPECT_THAT(refusal({{"route", PANVO_CONFIG "/routes/short.yaml"}, {"effects", "[snow]"}}),
              AllOf(HasSubstr("snow"), HasSubstr("rain")));
}

}  // namespace
}  // namespace panvo::simulation
