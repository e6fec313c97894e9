// SPDX-License-Identifier: Apache-2.0
#include "panvo/compressed_images/decode.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "panvo/conversions/time.hpp"
#include "pictures.hpp"

namespace panvo::compressed_images {
namespace {

using sensor_msgs::msg::CompressedImage;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A message with a file written by OpenCV.
CompressedImage message(const sensor_msgs::msg::Image& image, const std::string& extension, const std::string& format,
                        const std::vector<int>& settings = {}) {
  CompressedImage message;
  message.header(image.header());
  message.format(format);
  std::vector<std::uint8_t> file;
  cv::imencode(extension, *conversions::view(image), file, settings);
  message.data(std::move(file));
  return message;
}

const std::vector<int> kBest{cv::IMWRITE_JPEG_QUALITY, 100};

TEST(Decode, KeepsTheHeaderAndTheSize) {
  const auto image = decode(message(*picture("mono8"), ".jpg", "jpeg"), Output::kSame);
  ASSERT_TRUE(image) << image.reason();
  EXPECT_EQ(conversions::stamp_ns(**image), kStampNs);
  EXPECT_EQ((*image)->header().frame_id(), "left_camera");
  EXPECT_EQ((*image)->width(), 64U);
  EXPECT_EQ((*image)->height(), 48U);
  EXPECT_EQ((*image)->data().size(), 64U * 48U);
}

TEST(Decode, GivesThePixelsOfAJpegUpToItsLosses) {
  const auto grey = picture("mono8");
  const auto image = decode(message(*grey, ".jpg", "mono8; jpeg compressed ", kBest), Output::kSame);
  ASSERT_TRUE(image) << image.reason();
  EXPECT_THAT(max_difference(**image, *grey), ::testing::AllOf(::testing::Ge(0), ::testing::Le(2)));
}

TEST(Decode, GivesColoursInTheOrderTheyHadBefore) {
  const auto bgr = picture("bgr8");
  for (const char* format : {"jpeg", "bgr8; jpeg compressed bgr8", ""}) {
    const auto image = decode(message(*bgr, ".jpg", format), Output::kSame);
    ASSERT_TRUE(image) << image.reason();
    EXPECT_EQ((*image)->encoding(), "bgr8");
    EXPECT_NEAR((*image)->data()[3 * 40], bgr->data()[3 * 40], 12);
    EXPECT_NEAR((*image)->data()[3 * 40 + 2], bgr->data()[3 * 40 + 2], 12);
  }
  const auto image = decode(message(*bgr, ".jpg", "rgb8; jpeg compressed bgr8"), Output::kSame);
  ASSERT_TRUE(image) << image.reason();
  EXPECT_EQ((*image)->encoding(), "rgb8");
  EXPECT_NEAR((*image)->data()[3 * 40 + 2], bgr->data()[3 * 40], 12);
}

TEST(Decode, GivesEveryPixelOfAPng) {
  for (const char* encoding : {"mono8", "mono16", "bgr8", "bgra8"}) {
    const auto before = picture(encoding);
    const auto image = decode(message(*before, ".png", std::string(encoding) + "; png compressed "), Output::kSame);
    ASSERT_TRUE(image) << image.reason();
    EXPECT_EQ(max_difference(**image, *before), 0) << encoding;
  }
}

TEST(Decode, MakesGreyOfWhateverThereIs) {
  for (const char* encoding : {"mono8", "mono16", "bgr8", "bgra8"}) {
    const auto before = picture(encoding);
    const auto image = decode(message(*before, ".png", "png"), Output::kMono8);
    ASSERT_TRUE(image) << image.reason();
    ASSERT_EQ((*image)->encoding(), "mono8");
    const cv::Mat grey = *conversions::grey(*before);
    EXPECT_NEAR((*image)->data()[64 * 20 + 30], grey.at<std::uint8_t>(20, 30), 1) << encoding;
  }
  const auto image = decode(message(*picture("bgr8"), ".jpg", "jpeg", kBest), Output::kMono8);
  ASSERT_TRUE(image) << image.reason();
  EXPECT_EQ((*image)->encoding(), "mono8");
}

TEST(Decode, BelievesTheFileNotItsFormat) {
  const auto image = decode(message(*picture("mono8"), ".png", "rgb8; jpeg compressed bgr8"), Output::kSame);
  ASSERT_TRUE(image) << image.reason();
  EXPECT_EQ((*image)->encoding(), "mono8");
}

TEST(Decode, RefusesAFileThatIsCutOffAnywhere) {
  for (const char* extension : {".jpg", ".png"}) {
    const auto whole = message(*picture("bgr8"), extension, "");
    const std::size_t end =
        whole.data().size() - (std::string(extension) == ".png" ? 13 : 2);  // end markers may be missing
    for (std::size_t size = 0; size < end; size += 7) {
      auto cut = whole;
      cut.data().resize(size);
      const auto image = decode(cut, Output::kSame);
      ASSERT_FALSE(image) << extension << " of " << size << " of " << whole.data().size() << " bytes";
      ASSERT_FALSE(image.reason().empty());
    }
  }
}

TEST(Decode, RefusesADamagedFileAndNeverFails) {
  for (const char* extension : {".jpg", ".png"}) {
    const auto whole = message(*picture("bgr8"), extension, "");
    for (std::size_t at = 3; at < whole.data().size(); at += 3) {
      auto damaged = whole;
      damaged.data()[at] ^= 0xff;
      const auto image = decode(damaged, Output::kSame);  // JPEG cannot detect damage that only changes colours
      if (image) {
        EXPECT_EQ((*image)->data().size(), std::size_t{(*image)->step()} * (*image)->height());
      } else {
        EXPECT_THAT(image.reason(), ::testing::AnyOf(HasSubstr("damaged"), HasSubstr("neither"), HasSubstr("million")));
      }
    }
  }
  auto jpeg = message(*picture("mono8"), ".jpg", "");
  std::fill(jpeg.data().end() - 40, jpeg.data().end() - 20, std::uint8_t{0xff});
  EXPECT_FALSE(decode(jpeg, Output::kSame));
}

TEST(Decode, TakesFilesThatUsbCamerasPad) {
  const auto whole = message(*picture("mono8"), ".jpg", "jpeg");
  auto padded = whole;
  padded.data().insert(padded.data().end() - 2, 5, std::uint8_t{0});
  const auto image = decode(padded, Output::kSame);
  ASSERT_TRUE(image) << image.reason();
  EXPECT_EQ(max_difference(**image, **decode(whole, Output::kSame)), 0);
}

TEST(Decode, DoesNotTurnThePictureAsExifSays) {
  auto turned = message(*picture("mono8"), ".jpg", "jpeg");
  const std::vector<std::uint8_t> exif{0xff, 0xe1, 0,    34, 'E', 'x', 'i', 'f', 0, 0, 'M', 'M', 0, 42, 0, 0, 0, 8,
                                       0,    1,    0x01, 18, 0,   3,   0,   0,   0, 1, 0,   6,   0, 0,  0, 0, 0, 0};
  turned.data().insert(turned.data().begin() + 2, exif.begin(), exif.end());
  const auto image = decode(turned, Output::kSame);
  ASSERT_TRUE(image) << image.reason();
  EXPECT_EQ((*image)->width(), 64U);
}

TEST(Decode, RefusesWhatSaysThatItIsEnormousBeforeMemoryIsTaken) {
  auto png = message(*picture("mono8"), ".png", "png");
  std::fill(png.data().begin() + 16, png.data().begin() + 24, std::uint8_t{0x7f});
  EXPECT_THAT(decode(png, Output::kSame).reason(), HasSubstr("states a size of 2139062143 x 2139062143 px"));
  auto jpeg = message(*picture("mono8"), ".jpg", "jpeg");
  constexpr std::uint8_t kFrame[] = {0xff, 0xc0};
  const auto frame = std::search(jpeg.data().begin(), jpeg.data().end(), std::begin(kFrame), std::end(kFrame));
  std::fill(frame + 5, frame + 9, std::uint8_t{0x7f});
  EXPECT_THAT(decode(jpeg, Output::kSame).reason(), HasSubstr("32639 x 32639 px; at most 100 million"));
}

TEST(Decode, NamesWhatItDoesNotRead) {
  CompressedImage other;
  other.format("h264");
  EXPECT_EQ(decode(other, Output::kSame).reason(), "is empty");
  other.data({0, 0, 0, 1, 0x67});
  EXPECT_THAT(decode(other, Output::kSame).reason(), HasSubstr("stated format: 'h264'"));
}

}  // namespace
}  // namespace panvo::compressed_images
