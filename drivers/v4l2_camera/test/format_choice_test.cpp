// SPDX-License-Identifier: Apache-2.0
#include "panvo/v4l2_camera/format_choice.hpp"

#include <gmock/gmock.h>

namespace panvo::v4l2_camera {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr PixelCode kYuyv = pixel_code('Y', 'U', 'Y', 'V'), kGrey = pixel_code('G', 'R', 'E', 'Y'),
                    kH264 = pixel_code('H', '2', '6', '4'), kNv12 = pixel_code('N', 'V', '1', '2');

/// A typical USB stereo camera: raw images exceed USB 2's bandwidth at full rate.
std::vector<OfferedFormat> usb_camera() {
  const std::vector<double> fast{30.0, 15.0}, slow{10.0, 5.0};
  return {{kMjpg,
           "Motion-JPEG",
           {{.width = 1280, .height = 480, .rates_hz = fast}, {.width = 640, .height = 240, .rates_hz = fast}}},
          {kYuyv,
           "YUYV 4:2:2",
           {{.width = 1280, .height = 480, .rates_hz = slow}, {.width = 640, .height = 240, .rates_hz = fast}}},
          {kH264, "H.264", {{.width = 1280, .height = 480, .rates_hz = fast}}}};
}

TEST(PixelCodes, ReadAsTheirFourCharacters) {
  EXPECT_EQ(kYuyv, 0x56595559U) << "V4L2_PIX_FMT_YUYV";
  EXPECT_EQ(to_text(kYuyv), "YUYV");
  EXPECT_EQ(to_text(pixel_code('Y', '1', '6', ' ')), "Y16");
  EXPECT_EQ(to_text(0x01595559U), "YUY.");
  EXPECT_EQ(parse_pixel_code("mjpg"), kMjpg);
  EXPECT_EQ(parse_pixel_code("Y16"), pixel_code('Y', '1', '6', ' '));
  EXPECT_EQ(parse_pixel_code(""), std::nullopt);
  EXPECT_EQ(parse_pixel_code("YUYV8"), std::nullopt);
}

TEST(PixelCodes, TellWhatTheyAreCodedAs) {
  EXPECT_EQ(coding_of(kYuyv), Coding::kRaw);
  EXPECT_EQ(coding_of(kMjpg), Coding::kJpeg);
  EXPECT_EQ(coding_of(kH264), Coding::kVideo);
  EXPECT_EQ(coding_of(kNv12), Coding::kUnknown);
  EXPECT_EQ(raw_format_of(pixel_code('R', 'G', 'G', 'B')), camera_stream::PixelFormat::kBayerRG8);
  EXPECT_EQ(raw_format_of(pixel_code('B', 'A', '8', '1')), camera_stream::PixelFormat::kBayerBG8);
  EXPECT_THROW(raw_format_of(kMjpg), std::invalid_argument);
}

TEST(FormatChoice, TakesTheFormatThatReachesTheRate) {
  const ImageFormat current{kYuyv, 640, 240, 0};
  const auto fast = choose_format(usb_camera(), current, {.width = 1280, .height = 480, .rate_hz = 30.0});
  ASSERT_TRUE(fast);
  EXPECT_EQ(to_text(*fast), "MJPG 1280 x 480 px");
  const auto slow = choose_format(usb_camera(), current, {.width = 1280, .height = 480, .rate_hz = 10.0});
  EXPECT_EQ(to_text(*slow), "YUYV 1280 x 480 px") << "raw before JPEG if both reach the rate";
  const auto none = choose_format(usb_camera(), current, {.width = 1280, .height = 480, .rate_hz = 60.0});
  EXPECT_EQ(none->pixels, kMjpg) << "the closest";
}

TEST(FormatChoice, LeavesTheCameraAsItIsWhereNothingIsWished) {
  const auto choice = choose_format(usb_camera(), {kMjpg, 640, 240, 0}, {});
  ASSERT_TRUE(choice);
  EXPECT_EQ(to_text(*choice), "MJPG 640 x 240 px");
}

TEST(FormatChoice, TakesGreyWhereOnlyGreyIsNeeded) {
  auto offered = usb_camera();
  offered.push_back({kGrey, "Greyscale", {{.width = 640, .height = 240, .rates_hz = {30.0}}}});
  const ImageFormat current{kYuyv, 640, 240, 0};
  EXPECT_EQ(choose_format(offered, current, {.rate_hz = 30.0, .prefers_grey = true})->pixels, kGrey);
  EXPECT_EQ(choose_format(offered, current, {.rate_hz = 30.0})->pixels, kYuyv);
}

TEST(FormatChoice, TakesWhatIsNamedEvenIfItIsNotOffered) {
  const auto choice =
      choose_format(usb_camera(), {kYuyv, 640, 240, 0}, {.pixel_format = "GREY", .width = 1000, .height = 481});
  ASSERT_TRUE(choice);
  EXPECT_EQ(to_text(*choice), "GREY 1000 x 481 px") << "the camera may support more than it lists";
}

TEST(FormatChoice, SaysWhyCompressedVideoIsNotReadAndWhatIs) {
  const auto choice = choose_format(usb_camera(), {kYuyv, 640, 240, 0}, {.pixel_format = "H264"});
  ASSERT_FALSE(choice);
  EXPECT_THAT(choice.reason(),
              AllOf(HasSubstr("H264 is compressed video"), HasSubstr("set pixel_format to one of MJPG, YUYV")));
  EXPECT_THAT(choose_format(usb_camera(), {}, {.pixel_format = "NV12"}).reason(), HasSubstr("NV12 is not supported"));
  EXPECT_THAT(choose_format(usb_camera(), {}, {.pixel_format = "YUYV8"}).reason(), HasSubstr("one to four characters"));
}

TEST(FormatChoice, LeavesCompressedVideoForWhatIsRead) {
  const auto choice = choose_format(usb_camera(), {kH264, 1280, 480, 0}, {});
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->pixels, kMjpg);
  const std::vector<OfferedFormat> only_video{{kH264, "H.264", {}}, {kNv12, "NV12", {}}};
  const auto none = choose_format(only_video, {kH264, 1280, 480, 0}, {});
  ASSERT_FALSE(none);
  EXPECT_THAT(none.reason(), AllOf(HasSubstr("it has H264, NV12"), HasSubstr("supported are GREY")));
}

TEST(FormatChoice, KnowsRangesOfSizes) {
  const OfferedSize range{1920, 1080, 48, 32, 16, 1, {}};
  EXPECT_TRUE(range.includes(640, 481));
  EXPECT_FALSE(range.includes(641, 480)) << "between two steps";
  EXPECT_FALSE(range.includes(1936, 480));
  EXPECT_FALSE(range.includes(32, 480));
}

TEST(NegotiatedFormat, IsReportedWhereItIsNotWhatWasAskedFor) {
  const FormatWish wish{.pixel_format = "MJPG", .width = 1000, .height = 481, .rate_hz = 60.0};
  const ImageFormat asked{kMjpg, 1000, 481, 0}, given{kYuyv, 640, 480, 1280};
  EXPECT_THAT(not_given(wish, asked, given, 30.0),
              ElementsAre("format MJPG 1000 x 481 px: the camera gives YUYV 640 x 480 px",
                          "frame_rate_hz 60: the camera gives 30 Hz"));
  EXPECT_THAT(not_given({.width = 640, .height = 480, .rate_hz = 30.0}, given, given, 29.97), IsEmpty());
  EXPECT_THAT(not_given({.rate_hz = 30.0}, given, given, 0.0), ElementsAre(HasSubstr("rate cannot be set")));
  EXPECT_THAT(not_given({}, asked, given, 0.0), IsEmpty()) << "nothing was requested";
}

TEST(NegotiatedFormat, IsAnErrorWhereItCannotBeRead) {
  EXPECT_EQ(format_problem({kYuyv, 640, 480, 1280}, usb_camera()), "");
  EXPECT_THAT(format_problem({kNv12, 640, 480, 640}, usb_camera()),
              AllOf(HasSubstr("gives NV12 640 x 480 px"), HasSubstr("pixel_format")));
  EXPECT_THAT(format_problem({kYuyv, 0, 0, 0}, usb_camera()), HasSubstr("not an image"));
}

}  // namespace
}  // namespace panvo::v4l2_camera
