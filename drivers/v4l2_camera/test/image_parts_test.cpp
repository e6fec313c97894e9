// SPDX-License-Identifier: Apache-2.0
#include "panvo/v4l2_camera/image_parts.hpp"

#include <gmock/gmock.h>

#include <numeric>

namespace panvo::v4l2_camera {
namespace {

using camera_stream::ImageOutput;
using camera_stream::PixelFormat;
using camera_stream::RawImage;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

std::vector<std::uint8_t> counted(std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  return bytes;
}

/// The pixels of a part as published.
std::vector<std::uint8_t> published(const RawImage& part) {
  const auto image = camera_stream::to_image(part, ImageOutput::kAsSent, "frame");
  EXPECT_TRUE(image) << image.reason();
  return image ? (*image)->data() : std::vector<std::uint8_t>{};
}

TEST(ImagesSideBySide, AreTheLeftAndTheRightHalfOfEachRow) {
  const auto bytes = counted(8);                               // 0 1 | 2 3
  ImageSplitter splitter({.parts = ImageParts::kSideBySide});  // 4 5 | 6 7
  const auto parts = splitter.split({PixelFormat::kMono8, 4, 2, 0, bytes});
  ASSERT_TRUE(parts) << parts.reason();
  ASSERT_THAT(*parts, SizeIs(2));
  EXPECT_THAT(published((*parts)[0]), ElementsAre(0, 1, 4, 5));
  EXPECT_THAT(published((*parts)[1]), ElementsAre(2, 3, 6, 7));
}

TEST(ImagesSideBySide, LeaveOutGapsBetweenRowsAndKeepPixelsOfSeveralBytesWhole) {
  const auto bytes = counted(2 * 14);  // two halves of two three-byte pixels, rows of 14 bytes
  ImageSplitter splitter({.parts = ImageParts::kSideBySide});
  const auto parts = splitter.split({PixelFormat::kBgr8, 4, 2, 14, bytes});
  ASSERT_TRUE(parts) << parts.reason();
  EXPECT_THAT(published((*parts)[0]), ElementsAre(0, 1, 2, 3, 4, 5, 14, 15, 16, 17, 18, 19));
  EXPECT_THAT(published((*parts)[1]), ElementsAre(6, 7, 8, 9, 10, 11, 20, 21, 22, 23, 24, 25));
}

TEST(ImagesSideBySide, AreExchangedWhereTheRightOneComesFirst) {
  const auto bytes = counted(4);
  ImageSplitter splitter({.parts = ImageParts::kSideBySide, .swap = true});
  const auto parts = splitter.split({PixelFormat::kMono8, 4, 1, 0, bytes});
  ASSERT_TRUE(parts);
  EXPECT_THAT(published((*parts)[0]), ElementsAre(2, 3));
  EXPECT_THAT(published((*parts)[1]), ElementsAre(0, 1));
}

TEST(ImagesSideBySide, AreNoneOfAnImageThatCannotBeHalved) {
  const auto bytes = counted(64);
  ImageSplitter splitter({.parts = ImageParts::kSideBySide});
  EXPECT_THAT(splitter.split({PixelFormat::kMono8, 5, 2, 0, bytes}).reason(), HasSubstr("5 px wide, which is odd"));
  EXPECT_THAT(splitter.split({PixelFormat::kYuyv, 6, 2, 0, bytes}).reason(), HasSubstr("odd number of YUV422_8"));
  EXPECT_THAT(splitter.split({PixelFormat::kMono8, 8, 9, 0, bytes}).reason(), HasSubstr("holds 64 bytes where"));
  EXPECT_THAT(splitter.split({PixelFormat::kMono12p, 8, 2, 0, bytes}).reason(), HasSubstr("share bytes"));
}

TEST(ImagesOneAboveTheOther, AreTheUpperAndTheLowerRows) {
  const auto bytes = counted(8);
  ImageSplitter splitter({.parts = ImageParts::kTopBottom});
  const auto parts = splitter.split({PixelFormat::kMono8, 2, 4, 0, bytes});
  ASSERT_TRUE(parts) << parts.reason();
  EXPECT_THAT(published((*parts)[0]), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(published((*parts)[1]), ElementsAre(4, 5, 6, 7));
  EXPECT_THAT(splitter.split({PixelFormat::kMono8, 2, 3, 0, bytes}).reason(), HasSubstr("3 px high"));
  EXPECT_THAT(splitter.split({PixelFormat::kBayerRG8, 2, 2, 0, bytes}).reason(), HasSubstr("odd number of BayerRG8"))
      << "the lower half would start within the pattern";
}

TEST(InterleavedImages, AreTheFirstAndTheSecondByteOfEachPixel) {
  const auto bytes = counted(12);
  for (const auto format : {PixelFormat::kMono16, PixelFormat::kYuyv, PixelFormat::kUyvy}) {
    ImageSplitter splitter({.parts = ImageParts::kByteInterleaved});
    const auto parts = splitter.split({format, 2, 3, 0, bytes});
    ASSERT_TRUE(parts) << parts.reason();
    EXPECT_EQ((*parts)[0].width, 2);
    EXPECT_EQ((*parts)[0].height, 3);
    EXPECT_THAT(published((*parts)[0]), ElementsAre(0, 2, 4, 6, 8, 10));
    EXPECT_THAT(published((*parts)[1]), ElementsAre(1, 3, 5, 7, 9, 11));
  }
}

TEST(InterleavedImages, LeaveOutGapsMayBeExchangedAndBayerPatterns) {
  const auto bytes = counted(2 * 6);
  ImageSplitter splitter({.parts = ImageParts::kByteInterleaved, .swap = true, .interleaved = PixelFormat::kBayerGB8});
  const auto parts = splitter.split({PixelFormat::kMono16, 2, 2, 6, bytes});
  ASSERT_TRUE(parts) << parts.reason();
  EXPECT_EQ((*parts)[0].format, PixelFormat::kBayerGB8);
  EXPECT_THAT(published((*parts)[0]), ElementsAre(1, 3, 7, 9));
  EXPECT_THAT(published((*parts)[1]), ElementsAre(0, 2, 6, 8));
}

TEST(InterleavedImages, NeedPixelsOfTwoBytes) {
  const auto bytes = counted(16);
  ImageSplitter splitter({.parts = ImageParts::kByteInterleaved});
  EXPECT_THAT(splitter.split({PixelFormat::kMono8, 4, 4, 0, bytes}).reason(), HasSubstr("set pixel_format to Y16"));
}

TEST(AWholeImage, StaysWhole) {
  const auto bytes = counted(6);
  ImageSplitter splitter({});
  const auto parts = splitter.split({PixelFormat::kMono8, 3, 2, 0, bytes});
  ASSERT_TRUE(parts);
  ASSERT_THAT(*parts, SizeIs(1));
  EXPECT_EQ((*parts)[0].bytes.data(), bytes.data());
}

}  // namespace
}  // namespace panvo::v4l2_camera
