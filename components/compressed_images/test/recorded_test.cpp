// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "panvo/runtime/testing.hpp"
#include "pictures.hpp"
#include "sensor_msgs/msg/CompressedImage.h"

namespace panvo::compressed_images {
namespace {

using sensor_msgs::msg::CompressedImage;
using sensor_msgs::msg::Image;

std::filesystem::path bag() {
  const char* data = std::getenv("PANVO_DATA");
  return std::filesystem::path(data ? data : PANVO_DEFAULT_DATA) / "bags" / "sample.db3";
}

TEST(RecordedImages, AreDecodedAsAnotherDecoderDoes) {
  if (!std::filesystem::exists(bag())) GTEST_SKIP() << bag() << " is missing: set PANVO_DATA";
  runtime::ComponentHarness harness;
  const auto& files = harness.collect(interfaces::Topic<CompressedImage>{"/image/compressed"});
  const auto& decoded = harness.collect(interfaces::Topic<Image>{"/image/decoded"});
  harness.load("panvo_compressed_images", "ImageDecoderComponent", {{"topics", "[/image]"}});
  harness.load("panvo_recorder", "BagPlayerComponent", {{"directory", bag().string()}});
  ASSERT_THAT(harness.container().run(), testing::IsEmpty());
  ASSERT_THAT(files, testing::SizeIs(1));
  ASSERT_THAT(decoded, testing::SizeIs(1));
  EXPECT_EQ(files[0]->format(), "bgr8; jpeg compressed bgr8");
  EXPECT_EQ(decoded[0]->header(), files[0]->header());

  const cv::Mat witness = cv::imdecode(files[0]->data(), cv::IMREAD_COLOR);
  ASSERT_EQ(witness.size(), cv::Size(640, 480));
  auto expected = conversions::make_image(0, "", "bgr8", witness.cols, witness.rows);
  witness.copyTo(conversions::pixels(*expected));
  EXPECT_THAT(largest_difference(*decoded[0], *expected), testing::AllOf(testing::Ge(0), testing::Le(4)));
}

}  // namespace
}  // namespace panvo::compressed_images
