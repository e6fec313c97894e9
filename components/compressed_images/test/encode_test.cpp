// SPDX-License-Identifier: Apache-2.0
#include "panvo/compressed_images/encode.hpp"

#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>

#include "panvo/compressed_images/decode.hpp"
#include "panvo/conversions/time.hpp"
#include "pictures.hpp"

namespace panvo::compressed_images {
namespace {

using ::testing::HasSubstr;

constexpr Encoding kPng{.kind = Encoding::Kind::kPng};

TEST(Encode, WritesTheHeaderAndTheFormatAsRos2Does) {
  const auto grey = encode(*picture("mono8"), {});
  ASSERT_TRUE(grey) << grey.reason();
  EXPECT_EQ(conversions::stamp_ns(**grey), kStampNs);
  EXPECT_EQ((*grey)->header().frame_id(), "left_camera");
  EXPECT_EQ((*grey)->format(), "mono8; jpeg compressed ");
  EXPECT_EQ((*encode(*picture("rgb8"), {}))->format(), "rgb8; jpeg compressed bgr8");
  EXPECT_EQ((*encode(*picture("rgb8"), kPng))->format(), "rgb8; png compressed bgr8");
}

TEST(Encode, MakesFilesThatAnotherProgramReads) {
  for (const char* encoding : {"bgr8", "rgb8"}) {
    for (const auto& way : {Encoding{.jpeg_quality = 100}, kPng}) {
      const auto image = picture(encoding);
      const auto file = encode(*image, way);
      ASSERT_TRUE(file) << file.reason();
      EXPECT_EQ(max_difference(*image, *picture(encoding)), 0) << "a published image must not be changed";
      const cv::Mat read = cv::imdecode((*file)->data(), cv::IMREAD_UNCHANGED);
      ASSERT_EQ(read.size(), cv::Size(64, 48));
      const int red = std::string(encoding) == "rgb8" ? 0 : 2;
      EXPECT_NEAR(read.at<cv::Vec3b>(20, 30)[2], image->data()[3 * (20 * 64 + 30) + red], 3) << encoding;
    }
  }
}

TEST(Encode, KeepsEveryPixelAsPng) {
  for (const char* encoding : {"mono8", "mono16", "bgr8", "bgra8"}) {
    const auto image = picture(encoding);
    const auto file = encode(*image, kPng);
    ASSERT_TRUE(file) << file.reason();
    EXPECT_EQ(max_difference(**decode(**file, Output::kSame), *image), 0) << encoding;
  }
}

TEST(Encode, LosesLittleAsJpeg) {
  for (const char* encoding : {"mono8", "bgr8", "rgb8"}) {
    const auto image = picture(encoding);
    const auto file = encode(*image, {});
    ASSERT_TRUE(file) << file.reason();
    const auto again = decode(**file, Output::kSame);
    ASSERT_TRUE(again) << again.reason();
    EXPECT_THAT(max_difference(**again, *image), ::testing::AllOf(::testing::Ge(0), ::testing::Le(8))) << encoding;
    EXPECT_LT((*file)->data().size(), image->data().size() / 2);
  }
}

TEST(Encode, TakesRowsWithGapsBetweenThem) {
  const auto image = picture("mono8");
  sensor_msgs::msg::Image gaps = *image;
  gaps.step(80);
  gaps.data().assign(80 * 48, 0);
  conversions::view(*image)->copyTo(conversions::pixels(gaps));
  EXPECT_EQ((*encode(gaps, {}))->data(), (*encode(*image, {}))->data());
  EXPECT_EQ((*encode(gaps, kPng))->data(), (*encode(*image, kPng))->data());
}

TEST(Encode, RefusesWhatTheFileCannotHoldAndWhatIsNoImage) {
  EXPECT_THAT(encode(*picture("mono16"), {}).reason(), HasSubstr("choose png"));
  auto image = *picture("mono8");
  image.data().resize(10);
  EXPECT_THAT(encode(image, {}).reason(), HasSubstr("holds 10 bytes"));
}

}  // namespace
}  // namespace panvo::compressed_images
