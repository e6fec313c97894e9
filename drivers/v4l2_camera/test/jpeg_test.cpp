// SPDX-License-Identifier: Apache-2.0
#include "panvo/v4l2_camera/jpeg.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>

namespace panvo::v4l2_camera {
namespace {

using camera_stream::PixelFormat;
using ::testing::AnyOf;
using ::testing::HasSubstr;

constexpr int kWidth = 64, kHeight = 48;
using Bytes = std::vector<std::uint8_t>;

/// Green increases to the right; the left half is blue, the right half red.
cv::Mat picture() {
  cv::Mat pixels(kHeight, kWidth, CV_8UC3);
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const auto level = static_cast<std::uint8_t>(column * 3);
      pixels.at<cv::Vec3b>(row, column) = column < kWidth / 2 ? cv::Vec3b(200, level, 20) : cv::Vec3b(20, level, 200);
    }
  }
  return pixels;
}

Bytes jpeg_of(const cv::Mat& pixels) {
  Bytes file;
  cv::imencode(".jpg", pixels, file, {cv::IMWRITE_JPEG_QUALITY, 95});
  return file;
}

Bytes::iterator find_marker(Bytes& file, std::uint8_t marker) {
  const std::uint8_t wanted[2] = {0xff, marker};
  return std::search(file.begin(), file.end(), std::begin(wanted), std::end(wanted));
}

TEST(JpegFrames, AreReadInColourAndInGrey) {
  const auto file = jpeg_of(picture());
  JpegDecoder decoder;
  const auto colour = decoder.decode(file, kWidth, kHeight, false);
  ASSERT_TRUE(colour) << colour.reason();
  EXPECT_EQ(colour->format, PixelFormat::kBgr8);
  ASSERT_EQ(colour->bytes.size(), std::size_t{3 * kWidth * kHeight});
  const std::uint8_t* pixel = colour->bytes.data() + 3 * (10 * kWidth + 8);
  EXPECT_NEAR(pixel[0], 200, 6);
  EXPECT_NEAR(pixel[1], 24, 6);
  EXPECT_NEAR(pixel[2], 20, 6);
  const auto grey = decoder.decode(file, kWidth, kHeight, true);
  ASSERT_TRUE(grey) << grey.reason();
  EXPECT_EQ(grey->format, PixelFormat::kMono8);
  EXPECT_NEAR(grey->bytes[10 * kWidth + 8], 0.114 * 200 + 0.587 * 24 + 0.299 * 20, 4);
}

TEST(JpegFrames, OfGreyAreGrey) {
  cv::Mat grey(kHeight, kWidth, CV_8U, cv::Scalar(77));
  JpegDecoder decoder;
  const auto image = decoder.decode(jpeg_of(grey), kWidth, kHeight, false);
  ASSERT_TRUE(image) << image.reason();
  EXPECT_EQ(image->format, PixelFormat::kMono8);
  EXPECT_EQ(image->bytes[100], 77);
}

TEST(JpegFrames, WithoutHuffmanTablesAreReadWithTheStandardOnes) {
  auto file = jpeg_of(picture());
  JpegDecoder decoder;
  const auto whole = decoder.decode(file, kWidth, kHeight, true);
  ASSERT_TRUE(whole);
  const Bytes expected(whole->bytes.begin(), whole->bytes.end());
  // OpenCV writes the standard tables by default; many USB cameras omit them.
  int removed = 0;
  for (auto at = find_marker(file, 0xc4); at != file.end(); at = find_marker(file, 0xc4), ++removed)
    file.erase(at, at + 2 + at[2] * 256 + at[3]);
  ASSERT_GT(removed, 0);
  const auto image = decoder.decode(file, kWidth, kHeight, true);
  ASSERT_TRUE(image) << image.reason();
  EXPECT_TRUE(std::equal(image->bytes.begin(), image->bytes.end(), expected.begin(), expected.end()));
}

TEST(JpegFrames, MayBePaddedBeforeAndAfterTheirEnd) {
  auto file = jpeg_of(picture());
  JpegDecoder decoder;
  file.insert(file.end(), 100, 0);
  EXPECT_TRUE(decoder.decode(file, kWidth, kHeight, true));
  file.resize(file.size() - 102);
  file.insert(file.end(), 20, 0);
  file.insert(file.end(), {0xff, 0xd9});
  const auto padded = decoder.decode(file, kWidth, kHeight, true);
  EXPECT_TRUE(padded) << padded.reason();
}

TEST(DamagedJpegFrames, AreToldWhereverTheyAreCutOff) {
  const auto file = jpeg_of(picture());
  JpegDecoder decoder;
  for (std::size_t size = 0; size < file.size() - 2; size += 7) {
    const auto image = decoder.decode(std::span(file).first(size), kWidth, kHeight, false);
    EXPECT_FALSE(image) << "cut off after " << size << " of " << file.size() << " bytes";
    EXPECT_THAT(image.reason(), AnyOf(HasSubstr("damaged JPEG file"), HasSubstr("is not a JPEG file")));
  }
}

TEST(DamagedJpegFrames, OfAnotherSizeThanTheStreamAreTold) {
  JpegDecoder decoder;
  EXPECT_EQ(decoder.decode(jpeg_of(picture()), 1280, 480, false).reason(),
            "is a JPEG file of 64 x 48 px in a stream of 1280 x 480 px");
}

TEST(DamagedJpegFrames, MakeNoTroubleForThoseThatFollow) {
  const auto file = jpeg_of(picture());
  JpegDecoder decoder;
  for (std::size_t i = 2; i < file.size(); i += 3) {
    auto broken = file;
    broken[i] = static_cast<std::uint8_t>(~broken[i]);
    const auto image = decoder.decode(broken, kWidth, kHeight, false);
    if (image) {
      EXPECT_GE(image->bytes.size(), std::size_t{kWidth * kHeight});
    }
    ASSERT_TRUE(decoder.decode(file, kWidth, kHeight, false)) << "the next file is read correctly, after byte " << i;
  }
}

}  // namespace
}  // namespace panvo::v4l2_camera
