// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "panvo/conversions/image.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/interfaces/node_topics.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/testing.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::panorama_stitcher {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::int64_t kPeriod_ns = 200'000'000;
constexpr int kSize = 64;

/// Two fisheyes of 200 degrees back to back, and a panorama of 64 x 32 px.
class PanoramaStitcherComponentTest : public ::testing::Test {
 protected:
  PanoramaStitcherComponentTest() {
    folder_.write("lens.yaml", R"(image_width: 64
image_height: 64
camera_matrix: [18.0, 0.0, 31.5, 0.0, 18.0, 31.5, 0.0, 0.0, 1.0]
distortion_model: equidistant
distortion_coefficients: [0.0, 0.0, 0.0, 0.0]
)");
    folder_.write("panorama.yaml", R"(panorama: {blend_deg: 6}
heads:
- {name: front, camera_info: lens.yaml}
- {name: back, camera_info: lens.yaml, yaw_deg: 180}
)");
  }

  void load(std::map<std::string, std::string> parameters = {}) {
    parameters.emplace("rig", (folder_ / "panorama.yaml").string());
    parameters.emplace("columns", "64");
    harness_.load("panvo_panorama_stitcher", "PanoramaStitcherComponent", parameters);
  }

  void publish(std::size_t head, std::int64_t stamp_ns, int grey, int size = kSize,
               const std::string& encoding = "mono8") {
    const auto image =
        conversions::make_image(stamp_ns, "panorama_head_" + std::to_string(head) + "_optical", encoding, size, size);
    cv::Mat pixels = conversions::pixels(*image);
    pixels.setTo(cv::Scalar::all(grey));
    pixels.row(0).setTo(cv::Scalar::all(grey / 2));  // so that it is not constant
    harness_.publish(topics::kPanoramaHeadImageRaw[head], std::shared_ptr<const sensor_msgs::msg::Image>(image));
  }

  std::string newest_report() const {
    if (reports_.empty()) return "none";
    const auto& status = reports_.back()->status().front();
    std::string text = std::to_string(status.level()) + " " + status.message();
    for (const auto& value : status.values()) text += "\n" + value.key() + ": " + value.value();
    return text;
  }

  std::string refusal() {
    try {
      load();
    } catch (const runtime::ConfigError& error) {
      return error.what();
    }
    return "accepted";
  }

  panvo::test::TemporaryFolder folder_;
  runtime::ComponentHarness harness_;
  const std::vector<std::shared_ptr<const sensor_msgs::msg::Image>>& panoramas_ = harness_.collect(topics::kPanorama);
  const std::vector<std::shared_ptr<const diagnostic_msgs::msg::DiagnosticArray>>& reports_ =
      harness_.collect(topics::kDiagnostics);
  const std::vector<std::shared_ptr<const tf2_msgs::msg::TFMessage>>& transforms_ = harness_.collect(topics::kTfStatic);
};

int grey_at(const sensor_msgs::msg::Image& panorama, int column) {
  return conversions::view(panorama)->at<uchar>(16, column);
}

TEST_F(PanoramaStitcherComponentTest, PublishesAPanoramaUnderTheHeadsStamp) {
  load();
  publish(0, 1'700'000'000'000'000'007, 100);
  EXPECT_THAT(panoramas_, IsEmpty());
  publish(1, 1'700'000'000'000'000'007, 200);
  ASSERT_THAT(panoramas_, SizeIs(1));
  const auto& panorama = *panoramas_[0];
  EXPECT_EQ(conversions::stamp_ns(panorama), 1'700'000'000'000'000'007);
  EXPECT_EQ(panorama.header().frame_id(), "panorama_optical");
  EXPECT_EQ(panorama.encoding(), "mono8");
  EXPECT_EQ(panorama.width(), 64u);
  EXPECT_EQ(panorama.height(), 32u);
  EXPECT_EQ(grey_at(panorama, 32), 100) << "ahead";
  EXPECT_EQ(grey_at(panorama, 0), 200) << "behind";
  EXPECT_EQ(grey_at(panorama, 48), 150) << "to the right, on the seam";
}

TEST_F(PanoramaStitcherComponentTest, SaysWhereThePanoramaIsOnTheFirstHead) {
  load();
  for (std::int64_t i = 1; i < 4; ++i) {
    publish(0, i * kPeriod_ns, 100);
    publish(1, i * kPeriod_ns, 100);
  }
  ASSERT_THAT(transforms_, SizeIs(1));
  const auto& transform = transforms_[0]->transforms().front();
  EXPECT_EQ(transform.header().frame_id(), "panorama_head_0_optical");
  EXPECT_EQ(transform.child_frame_id(), "panorama_optical");
}

TEST_F(PanoramaStitcherComponentTest, TurnsColourGreyIfAskedTo) {
  load({{"output", "mono8"}});
  publish(0, kPeriod_ns, 100, kSize, "rgb8");
  publish(1, kPeriod_ns, 100, kSize, "rgb8");
  ASSERT_THAT(panoramas_, SizeIs(1));
  EXPECT_EQ(panoramas_[0]->encoding(), "mono8");
  EXPECT_EQ(grey_at(*panoramas_[0], 32), 100);
}

TEST_F(PanoramaStitcherComponentTest, GoesOnWithoutAHeadThatIsMissingAndNamesIt) {
  load({{"missing_after", "2"}});
  for (std::int64_t i = 1; i < 20; ++i) publish(0, i * kPeriod_ns, 100);
  ASSERT_FALSE(panoramas_.empty());
  EXPECT_EQ(grey_at(*panoramas_.back(), 32), 100);
  EXPECT_EQ(grey_at(*panoramas_.back(), 0), 0);
  EXPECT_TRUE(harness_.log_contains("head 'back' is missing"));
  EXPECT_THAT(newest_report(), AllOf(HasSubstr("1 heads: 'back' missing"), HasSubstr("head front: seen"),
                                     HasSubstr("panorama/head_0/image_raw unpaired: 2")));
  for (std::int64_t i = 20; i < 23; ++i) {
    publish(1, i * kPeriod_ns, 200);
    publish(0, i * kPeriod_ns, 100);
  }
  EXPECT_EQ(grey_at(*panoramas_.back(), 0), 200);
  EXPECT_TRUE(harness_.log_contains("head 'back' is seen again"));
}

TEST_F(PanoramaStitcherComponentTest, GoesOnWithoutAHeadThatStaysDarkAndNamesIt) {
  load({{"missing_after", "3"}});
  for (std::int64_t i = 1; i < 10; ++i) {
    publish(0, i * kPeriod_ns, 100);
    publish(1, i * kPeriod_ns, 3);
    if (i == 2) {
      EXPECT_EQ(grey_at(*panoramas_.back(), 0), 3) << "a single dark image does not make a head dark";
    }
  }
  EXPECT_EQ(grey_at(*panoramas_.back(), 0), 0);
  EXPECT_EQ(grey_at(*panoramas_.back(), 48), 100) << "the other head covers this direction";
  EXPECT_TRUE(harness_.log_contains("head 'back' is dark, is black"));
  EXPECT_THAT(newest_report(), HasSubstr("'back' dark"));
}

TEST_F(PanoramaStitcherComponentTest, LeavesOutImagesOfAnotherCalibration) {
  load();
  publish(0, kPeriod_ns, 100, 32);
  publish(0, 2 * kPeriod_ns, 100, 32);
  publish(1, kPeriod_ns, 100);
  EXPECT_THAT(panoramas_, IsEmpty());
  EXPECT_TRUE(harness_.log_contains(
      "panorama/head_0/image_raw is 32 x 32 px, but head 'front' is calibrated for images of 64 x 64 px"));
  EXPECT_EQ(harness_.log().size(), 1u) << "logged once";
  publish(0, 3 * kPeriod_ns, 100);
  publish(1, 3 * kPeriod_ns, 100);
  EXPECT_THAT(panoramas_, SizeIs(1));
}

TEST_F(PanoramaStitcherComponentTest, RefusesHeadsOfDifferentEncodings) {
  load();
  publish(0, kPeriod_ns, 100, kSize, "rgb8");
  publish(1, kPeriod_ns, 100, kSize, "bgr8");
  EXPECT_THAT(panoramas_, IsEmpty());
  EXPECT_TRUE(harness_.log_contains("have encodings bgr8 and rgb8"));
}

TEST_F(PanoramaStitcherComponentTest, RefusesRigsThatCannotBeStitched) {
  folder_.write("panorama.yaml", "panorama:\n  seen_elevation_deg: [-90, 90]\nheads: [{camera_info: lens.yaml}]\n");
  EXPECT_THAT(refusal(),
              AllOf(HasSubstr("panorama.yaml:2: panorama.seen_elevation_deg: no head sees"), HasSubstr("narrow")));
  folder_.write("panorama.yaml", "heads: [{camera_info: lens.yaml, yaw: 3}]\n");
  EXPECT_THAT(refusal(), HasSubstr("panorama.yaml:1: heads[0].yaw is not a known key; did you mean yaw_deg?"));
}

TEST_F(PanoramaStitcherComponentTest, AsksForARig) {
  try {
    load({{"rig", ""}});
    FAIL() << "accepted";
  } catch (const runtime::ConfigError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("rig"), HasSubstr("config/rigs")));
  }
}

}  // namespace
}  // namespace panvo::panorama_stitcher
