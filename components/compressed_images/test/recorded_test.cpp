// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>

#include "panvo/runtime/testing.hpp"
#include "panvo/test/recorded_data.hpp"
#include "pictures.hpp"
#include "sensor_msgs/msg/CompressedImage.h"

namespace panvo::compressed_images {
namespace {

using sensor_msgs::msg::CompressedImage;
using sensor_msgs::msg::Image;

TEST(RecordedImages, AreDecodedAsAnotherDecoderDoes) {
  const auto bag = panvo::test::recorded_data("bags/sample.db3");
  PANVO_NEEDS_RECORDING(bag);
  runtime::ComponentHarness harness;
  const auto& files = harness.collect(interfaces::Topic<CompressedImage>{"/image/compressed"});
  const auto& decoded = harness.collect(interfaces::Topic<Image>{"/image/decoded"});
  harness.load("panvo_compressed_images", "ImageDecoderComponent", {{"topics", "[/image]"}});
  harness.load("panvo_recorder", "BagPlayerComponent", {{"directory", bag.string()}});
  ASSERT_THAT(harness.container().run(), testing::IsEmpty());
  ASSERT_THAT(files, testing::SizeIs(1));
  ASSERT_THAT(decoded, testing::SizeIs(1));
  EXPECT_EQ(files[0]->format(), "bgr8; jpeg compressed bgr8");
  EXPECT_EQ(decoded[0]->header(), files[0]->header());

  const cv::Mat witness = cv::imdecode(files[0]->data(), cv::IMREAD_COLOR);
  ASSERT_EQ(witness.size(), cv::Size(640, 480));
  auto expected = conversions::make_image(0, "", "bgr8", witness.cols, witness.rows);
  witness.copyTo(conversions::pixels(*expected));
  EXPECT_THAT(max_difference(*decoded[0], *expected), testing::AllOf(testing::Ge(0), testing::Le(4)));
}

}  // namespace
}  // namespace panvo::compressed_images
