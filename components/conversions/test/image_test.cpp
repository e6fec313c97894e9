// SPDX-License-Identifier: Apache-2.0
#include "panvo/conversions/image.hpp"

#include <gmock/gmock.h>

#include "panvo/conversions/time.hpp"

namespace panvo::conversions {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(ImageView, SharesThePixelsOfTheMessage) {
  const auto image = make_image(1'500'000'000, "left", "mono8", 6, 4);
  image->data()[8] = 77;
  const auto pixels = view(*image);
  ASSERT_TRUE(pixels);
  EXPECT_EQ(pixels->data, image->data().data());
  EXPECT_EQ(pixels->at<std::uint8_t>(1, 2), 77);
  EXPECT_EQ(stamp_ns(*image), 1'500'000'000);
  EXPECT_EQ(image->header().frame_id(), "left");
}

TEST(ImageView, FollowsTheStepOfPaddedRows) {
  auto image = make_image(0, "left", "bgr8", 3, 2);
  image->step(16);
  image->data().assign(16 + 9, 0);  // the last row without its padding
  image->data()[16 + 4] = 9;
  const auto pixels = view(*image);
  ASSERT_TRUE(pixels);
  EXPECT_EQ(pixels->at<cv::Vec3b>(1, 1), cv::Vec3b(0, 9, 0));
}

TEST(ImageView, SaysWhyThereIsNone) {
  const auto reason = [](auto change) {
    auto image = make_image(0, "left", "rgb8", 4, 3);
    change(*image);
    const auto pixels = view(*image);
    EXPECT_FALSE(pixels);
    return pixels.reason();
  };
  EXPECT_THAT(reason([](auto& i) { i.encoding("bayer_rggb8"); }),
              AllOf(HasSubstr("'bayer_rggb8'"), HasSubstr("mono8")));
  EXPECT_THAT(reason([](auto& i) { i.width(0); }), HasSubstr("0 x 3 px"));
  EXPECT_THAT(reason([](auto& i) { i.width(0x7fffffff); }), HasSubstr("invalid size"));
  EXPECT_THAT(reason([](auto& i) { i.step(11); }), AllOf(HasSubstr("step of 11"), HasSubstr("need 12")));
  EXPECT_THAT(reason([](auto& i) { i.data().pop_back(); }), AllOf(HasSubstr("holds 35 bytes"), HasSubstr("need 36")));
  EXPECT_THAT(reason([](auto& i) { i.data().clear(); }), HasSubstr("holds 0 bytes"));
  EXPECT_THAT(reason([](auto& i) {
                i.encoding("mono16");
                i.step(9);
              }),
              HasSubstr("step of 9"));
  EXPECT_THAT(reason([](auto& i) {
                i.encoding("mono16");
                i.is_bigendian(1 - i.is_bigendian());
              }),
              HasSubstr("byte order"));
}

TEST(GreyImage, IsTheViewOfAGreyOne) {
  const auto image = make_image(0, "left", "mono8", 4, 3);
  EXPECT_EQ(grey(*image)->data, image->data().data());
}

TEST(GreyImage, WeighsTheColoursInTheirOrder) {
  for (const auto& [encoding, red] : {std::pair{"rgb8", 0}, {"rgba8", 0}, {"bgr8", 2}, {"bgra8", 2}}) {
    const auto image = make_image(0, "left", encoding, 4, 3);
    for (std::size_t i = static_cast<std::size_t>(red); i < image->data().size(); i += image->step() / 4)
      image->data()[i] = 200;
    const auto result = grey(*image);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->type(), CV_8UC1);
    EXPECT_EQ(result->at<std::uint8_t>(2, 3), 60) << encoding;  // 0.299 * 200
  }
}

TEST(GreyImage, ScalesSixteenBits) {
  const auto image = make_image(0, "left", "mono16", 2, 1);
  pixels(*image).at<std::uint16_t>(0, 1) = 65535;
  EXPECT_EQ(grey(*image)->at<std::uint8_t>(0, 1), 255);
  EXPECT_EQ(grey(*image)->at<std::uint8_t>(0, 0), 0);
}

TEST(GreyOrBgrImage, ScalesSixteenBitsAsGreyDoes) {
  const auto image = make_image(0, "panorama", "mono16", 256, 256);
  for (int i = 0; i < 65536; ++i) pixels(*image).at<std::uint16_t>(i / 256, i % 256) = static_cast<std::uint16_t>(i);
  EXPECT_EQ(cv::norm(*grey_or_bgr(*image), *grey(*image), cv::NORM_INF), 0.0);
}

TEST(GreyOrBgrImage, HasItsColoursInOneOrder) {
  for (const auto& [encoding, red] : {std::pair{"rgb8", 0}, {"rgba8", 0}, {"bgr8", 2}, {"bgra8", 2}}) {
    const auto image = make_image(0, "panorama", encoding, 4, 3);
    for (std::size_t i = static_cast<std::size_t>(red); i < image->data().size(); i += image->step() / 4)
      image->data()[i] = 200;
    const auto result = grey_or_bgr(*image);
    ASSERT_TRUE(result);
    ASSERT_EQ(result->type(), CV_8UC3);
    EXPECT_EQ(result->at<cv::Vec3b>(2, 3), cv::Vec3b(0, 0, 200)) << encoding;
  }
}

TEST(MadeImage, IsWrittenThroughItsPixels) {
  const auto image = make_image(0, "left", encoding_of(CV_8UC3), 4, 3);
  pixels(*image).setTo(cv::Scalar(1, 2, 3));
  EXPECT_EQ(image->encoding(), "bgr8");
  EXPECT_EQ(image->data()[35], 3);
}

TEST(MadeImage, OfNoSenseIsAProgrammingError) {
  EXPECT_THROW(make_image(0, "left", "jpeg", 4, 3), std::invalid_argument);
  EXPECT_THROW(make_image(0, "left", "mono8", 0, 3), std::invalid_argument);
  EXPECT_THROW(encoding_of(CV_32FC2), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::conversions
