// SPDX-License-Identifier: Apache-2.0
#include "panvo/places/panorama_image.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "painted_place.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::places {
namespace {

using testing::HasSubstr;

cv::Mat painted(const cv::Size& size) {
  cv::Mat image;
  cv::resize(test::paint_place(1), image, size, 0.0, 0.0, cv::INTER_AREA);
  return image;
}

TEST(FitPanorama, TakesAStripForAFullTurnAboutTheHorizon) {
  const auto fitted = fit_panorama(painted({120, 25}), {}, {});
  ASSERT_FALSE(fitted.fault) << *fitted.fault;
  EXPECT_EQ(fitted.image.grey.size(), cv::Size(1080, 540));
  EXPECT_EQ(fitted.image.file_columns, 120);
  // 25 rows of 3 degrees are 37.5 degrees to either side: rows 157 or 158 to 382 of 540
  EXPECT_EQ(cv::countNonZero(fitted.image.seen), 225 * 1080);
  EXPECT_EQ(fitted.image.seen.at<uchar>(156, 0), 0);
  EXPECT_EQ(fitted.image.seen.at<uchar>(270, 0), 255);
}

TEST(FitPanorama, PutsRowsAtTheirStatedElevations) {
  const auto fitted = fit_panorama(painted({400, 60}), ElevationRange{45.0, 15.0}, {});
  ASSERT_FALSE(fitted.fault);
  EXPECT_EQ(fitted.image.seen.at<uchar>(134, 5), 0);
  EXPECT_EQ(fitted.image.seen.at<uchar>(135, 5), 255);  // 45 degrees above the horizon
  EXPECT_EQ(fitted.image.seen.at<uchar>(314, 5), 255);
  EXPECT_EQ(fitted.image.seen.at<uchar>(315, 5), 0);  // 15 below
}

TEST(FitPanorama, RefusesWhatIsNoFullTurn) {
  EXPECT_THAT(*fit_panorama(painted({640, 480}), {}, {}).fault, HasSubstr("no full turn: 640x480"));
  EXPECT_THAT(*fit_panorama(painted({1920, 1080}), {}, {}).fault, HasSubstr("no full turn"));
  EXPECT_THAT(*fit_panorama(painted({40, 20}), {}, {}).fault, HasSubstr("40 px wide"));
  EXPECT_THAT(*fit_panorama(painted({1000, 30}), {}, {}).fault, HasSubstr("from top to bottom"));
  EXPECT_THAT(*fit_panorama(cv::Mat(540, 1080, CV_8UC1, cv::Scalar(3)), {}, {}).fault, HasSubstr("is black"));
  EXPECT_FALSE(fit_panorama(painted({1000, 510}), {}, {}).fault) << "nearly 2:1";
}

TEST(FitPanorama, MasksTheVehicle) {
  cv::Mat mask(100, 200, CV_8UC1, cv::Scalar(255));
  mask.rowRange(80, 100).setTo(0);
  const auto fitted = fit_panorama(painted({720, 360}), {}, mask);
  ASSERT_FALSE(fitted.fault);
  EXPECT_EQ(fitted.image.seen.at<uchar>(431, 500), 255);
  EXPECT_EQ(fitted.image.seen.at<uchar>(432, 500), 0);
}

TEST(ReadPanorama, SeesThatAJpegWithAThumbnailInItsHeaderWasCutOff) {
  const panvo::test::TemporaryFolder folder;
  std::vector<uchar> bytes;
  cv::imencode(".jpg", test::paint_place(1), bytes);
  const std::vector<uchar> segment{0xff, 0xe1, 0x00, 0x08, 0xff, 0xd8, 0x00, 0x00, 0xff, 0xd9};
  bytes.insert(bytes.begin() + 2, segment.begin(), segment.end());
  const auto write = [&](const char* name, std::size_t count) {
    std::ofstream(folder / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(count));
  };
  write("whole.jpg", bytes.size());
  write("cut.jpg", bytes.size() / 2);
  EXPECT_FALSE(read_panorama(folder / "whole.jpg", {}, {}).fault);
  EXPECT_EQ(read_panorama(folder / "cut.jpg", {}, {}).fault, "is a JPEG that was cut off");
}

TEST(ReadPanorama, SaysWhyAFileCannotBeUsed) {
  const panvo::test::TemporaryFolder folder;
  std::vector<uchar> bytes;
  cv::imencode(".jpg", test::paint_place(1), bytes);
  bytes.resize(bytes.size() / 2);
  const auto cut = folder / "cut.jpg";
  std::ofstream(cut, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  EXPECT_EQ(*read_panorama(cut, {}, {}).fault, "is a JPEG that was cut off");
  std::ofstream(folder / "text.png") << "no image";
  EXPECT_THAT(*read_panorama(folder / "text.png", {}, {}).fault, HasSubstr("cannot be decoded"));
  EXPECT_THAT(*read_panorama(folder / "absent.png", {}, {}).fault, HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace panvo::places
