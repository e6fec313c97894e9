// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_stream/raw_image.hpp"

#include <gmock/gmock.h>

#include <opencv2/imgproc.hpp>

#include "panvo/conversions/image.hpp"

namespace panvo::camera_stream {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

std::shared_ptr<sensor_msgs::msg::Image> image_of(PixelFormat format, int width, int height, const Bytes& bytes,
                                                  ImageOutput output = ImageOutput::kReadable, std::size_t step = 0) {
  const auto image = to_image({format, width, height, step, bytes}, output, "left");
  if (!image) {
    ADD_FAILURE() << image.reason();
    return std::make_shared<sensor_msgs::msg::Image>();
  }
  return *image;
}

std::vector<std::uint16_t> pixels16(const sensor_msgs::msg::Image& image) {
  const cv::Mat pixels = *conversions::view(image);
  return {pixels.begin<std::uint16_t>(), pixels.end<std::uint16_t>()};
}

TEST(RawImage, KeepsMono8AndLeavesOutTheGapsBetweenRows) {
  const auto image = image_of(PixelFormat::kMono8, 2, 2, {1, 2, 99, 3, 4}, ImageOutput::kReadable, 3);
  EXPECT_EQ(image->encoding(), "mono8");
  EXPECT_EQ(image->header().frame_id(), "left");
  EXPECT_EQ(image->step(), 2u);
  EXPECT_THAT(image->data(), ElementsAre(1, 2, 3, 4));
}

TEST(RawImage, ShiftsGreyOfFewerBitsUpTo16) {
  const Bytes largest10{0xff, 0x03, 0x01, 0x00}, largest12{0xff, 0x0f, 0x01, 0x00};
  EXPECT_THAT(pixels16(*image_of(PixelFormat::kMono10, 2, 1, largest10)), ElementsAre(0xffc0, 0x0040));
  EXPECT_THAT(pixels16(*image_of(PixelFormat::kMono12, 2, 1, largest12)), ElementsAre(0xfff0, 0x0010));
  EXPECT_THAT(pixels16(*image_of(PixelFormat::kMono16, 2, 1, largest12)), ElementsAre(0x0fff, 0x0001));
  EXPECT_EQ(image_of(PixelFormat::kMono12, 2, 1, largest12)->encoding(), "mono16");
}

TEST(RawImage, UnpacksPixelsOfTenAndTwelveBits) {
  // Twelve bits: 0xabc, 0x123. Ten bits: 0x2af, 0x123, 0x3ff, 0x001. Packed by hand according to the format
  // definitions.
  EXPECT_THAT(pixels16(*image_of(PixelFormat::kMono12p, 2, 1, {0xbc, 0x3a, 0x12})), ElementsAre(0xabc0, 0x1230));
  EXPECT_THAT(pixels16(*image_of(PixelFormat::kMono12Packed, 2, 1, {0xab, 0x3c, 0x12})), ElementsAre(0xabc0, 0x1230));
  EXPECT_THAT(pixels16(*image_of(PixelFormat::kMono10p, 4, 1, {0xaf, 0x8e, 0xf4, 0x7f, 0x00})),
              ElementsAre(0x2af << 6, 0x123 << 6, 0x3ff << 6, 0x001 << 6));
  EXPECT_THAT(pixels16(*image_of(PixelFormat::kMono10Packed, 2, 1, {0xab, 0x33, 0x48})),
              ElementsAre(0x2af << 6, 0x123 << 6));
}

TEST(RawImage, MakesEightBitsOfDeepGreyWhereAskedTo) {
  EXPECT_THAT(image_of(PixelFormat::kMono12, 2, 1, {0xf0, 0x0f, 0x00, 0x08}, ImageOutput::kGrey)->data(),
              ElementsAre(254, 128));
}

TEST(RawImage, ReadsEachBayerPatternWithTheRightColour) {
  // A red scene: only the red pixels of the pattern are bright.
  const struct {
    PixelFormat format;
    const char* encoding;
    int red_column, red_row;
  } patterns[] = {{PixelFormat::kBayerRG8, "bayer_rggb8", 0, 0},
                  {PixelFormat::kBayerGR8, "bayer_grbg8", 1, 0},
                  {PixelFormat::kBayerGB8, "bayer_gbrg8", 0, 1},
                  {PixelFormat::kBayerBG8, "bayer_bggr8", 1, 1}};
  for (const auto& pattern : patterns) {
    Bytes bytes(8 * 8, 0);
    for (int row = pattern.red_row; row < 8; row += 2) {
      for (int column = pattern.red_column; column < 8; column += 2)
        bytes[static_cast<std::size_t>(row * 8 + column)] = 200;
    }
    const auto image = image_of(pattern.format, 8, 8, bytes);
    EXPECT_EQ(image->encoding(), "bgr8");
    EXPECT_EQ(conversions::view(*image)->at<cv::Vec3b>(4, 4), cv::Vec3b(0, 0, 200)) << pattern.encoding;
    const auto sent = image_of(pattern.format, 8, 8, bytes, ImageOutput::kAsSent);
    EXPECT_EQ(sent->encoding(), pattern.encoding);
    EXPECT_EQ(sent->data(), bytes);
  }
}

TEST(RawImage, KnowsTheOrderOfYuvBytes) {
  const Bytes uyvy{128, 50, 128, 200}, yuyv{50, 128, 200, 128};
  EXPECT_THAT(image_of(PixelFormat::kUyvy, 2, 1, uyvy, ImageOutput::kGrey)->data(), ElementsAre(50, 200));
  EXPECT_THAT(image_of(PixelFormat::kYuyv, 2, 1, yuyv, ImageOutput::kGrey)->data(), ElementsAre(50, 200));
  EXPECT_EQ(image_of(PixelFormat::kUyvy, 2, 1, uyvy, ImageOutput::kAsSent)->encoding(), "yuv422");
  EXPECT_EQ(image_of(PixelFormat::kYuyv, 2, 1, yuyv, ImageOutput::kAsSent)->encoding(), "yuv422_yuy2");
  const auto colour = image_of(PixelFormat::kYuyv, 2, 1, yuyv);
  EXPECT_EQ(colour->encoding(), "bgr8");
  EXPECT_LT(colour->data()[0], colour->data()[3]);
}

TEST(RawImage, KeepsRgbAndBgrAndMakesGreyOfThem) {
  const Bytes red{200, 0, 0};
  EXPECT_EQ(image_of(PixelFormat::kRgb8, 1, 1, red)->encoding(), "rgb8");
  EXPECT_THAT(image_of(PixelFormat::kRgb8, 1, 1, red)->data(), ElementsAre(200, 0, 0));
  EXPECT_THAT(image_of(PixelFormat::kRgb8, 1, 1, red, ImageOutput::kGrey)->data(), ElementsAre(60));  // 0.299 * 200
  EXPECT_THAT(image_of(PixelFormat::kBgr8, 1, 1, red, ImageOutput::kGrey)->data(), ElementsAre(23));  // 0.114 * 200
}

TEST(RawImage, SaysWhatIsWrongWithABuffer) {
  const Bytes few(10, 0);
  const auto reason = [&](PixelFormat format, int width, int height, std::size_t step = 0) {
    return to_image({format, width, height, step, few}, ImageOutput::kReadable, "").reason();
  };
  EXPECT_THAT(reason(PixelFormat::kMono8, 4, 3), HasSubstr("holds 10 bytes where 4 x 3 px of Mono8 need 12"));
  EXPECT_THAT(reason(PixelFormat::kMono12p, 4, 2), HasSubstr("need 12"));
  EXPECT_THAT(reason(PixelFormat::kMono8, 0, 3), HasSubstr("not an image size"));
  EXPECT_THAT(reason(PixelFormat::kYuyv, 3, 1), HasSubstr("even width"));
  EXPECT_THAT(reason(PixelFormat::kMono8, 4, 1, 3), HasSubstr("rows of 3 bytes"));
  EXPECT_THAT(reason(PixelFormat::kMono12p, 2, 1, 8), HasSubstr("gaps"));
}

}  // namespace
}  // namespace panvo::camera_stream
