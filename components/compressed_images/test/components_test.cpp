// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "panvo/compressed_images/decode.hpp"
#include "panvo/compressed_images/encode.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/runtime/testing.hpp"
#include "pictures.hpp"

namespace panvo::compressed_images {
namespace {

using sensor_msgs::msg::CompressedImage;
using sensor_msgs::msg::Image;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr interfaces::Topic<CompressedImage> kCompressed{"cam/image/compressed", interfaces::qos::kSensorData};
constexpr interfaces::Topic<Image> kDecoded{"cam/image/decoded", interfaces::qos::kSensorData};
constexpr interfaces::Topic<Image> kImage{"cam/image", interfaces::qos::kSensorData};

const std::map<std::string, std::string> kTopics{{"topics", "[cam/image]"}};

TEST(ImageDecoderComponent, PublishesWhatItDecodes) {
  runtime::ComponentHarness harness;
  const auto& decoded = harness.collect(kDecoded);
  harness.load("panvo_compressed_images", "ImageDecoderComponent", kTopics);
  harness.publish(kCompressed, *encode(*picture("rgb8"), {}));
  ASSERT_THAT(decoded, SizeIs(1));
  EXPECT_EQ(decoded[0]->encoding(), "rgb8");
  EXPECT_EQ(conversions::stamp_ns(*decoded[0]), kStampNs);
}

TEST(ImageDecoderComponent, MakesGreyWhereItIsAskedTo) {
  runtime::ComponentHarness harness;
  const auto& decoded = harness.collect(kDecoded);
  harness.load("panvo_compressed_images", "ImageDecoderComponent", {{"topics", "[cam/image]"}, {"output", "mono8"}});
  harness.publish(kCompressed, *encode(*picture("rgb8"), {}));
  ASSERT_THAT(decoded, SizeIs(1));
  EXPECT_EQ(decoded[0]->encoding(), "mono8");
}

TEST(ImageDecoderComponent, LeavesDamagedImagesOutAndSaysSoOnce) {
  runtime::ComponentHarness harness;
  const auto& decoded = harness.collect(kDecoded);
  harness.load("panvo_compressed_images", "ImageDecoderComponent", kTopics);
  const auto whole = *encode(*picture("mono8"), {});
  CompressedImage damaged = *whole;
  damaged.data().resize(damaged.data().size() / 2);
  for (int i = 0; i < 3; ++i) harness.publish(kCompressed, damaged);
  EXPECT_THAT(decoded, IsEmpty());
  EXPECT_THAT(harness.log(), SizeIs(1));
  EXPECT_TRUE(harness.log_contains("warning compressed_images: cam/image/compressed is a damaged JPEG file"));
  harness.publish(kCompressed, whole);
  EXPECT_THAT(decoded, SizeIs(1));
  harness.publish(kCompressed, damaged);
  EXPECT_THAT(harness.log(), SizeIs(1));  // throttled: once in ten seconds
}

TEST(ImageEncoderComponent, PublishesWhatADecoderReads) {
  runtime::ComponentHarness harness;
  const auto& decoded = harness.collect(kDecoded);
  const auto& compressed = harness.collect(kCompressed);
  harness.load("panvo_compressed_images", "ImageDecoderComponent", kTopics);
  runtime::ComponentDescription encoder;
  encoder.package = "panvo_compressed_images";
  encoder.plugin = "ImageEncoderComponent";
  encoder.name = "encoder";
  encoder.name_space = "/";
  encoder.parameters["topics"] = {{"cam/image  cam/other"}, true, {"test", 0}};
  encoder.parameters["format"] = {{"png"}, false, {"test", 0}};
  harness.container().load(encoder);
  const auto image = picture("mono16");
  harness.publish(kImage, *image);
  ASSERT_THAT(compressed, SizeIs(1));
  EXPECT_EQ(compressed[0]->format(), "mono16; png compressed ");
  ASSERT_THAT(decoded, SizeIs(1));
  EXPECT_EQ(max_difference(*decoded[0], *image), 0);
}

}  // namespace
}  // namespace panvo::compressed_images
