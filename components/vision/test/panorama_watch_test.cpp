// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/panorama_watch.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "panvo/vision/panorama_cover.hpp"

namespace panvo::vision {
namespace {

constexpr int kColumns = 360, kRows = 180;

/// Houses under a sky, rotated by some columns, with independent sensor noise.
cv::Mat street(int turned = 0, std::uint64_t noise_seed = 1) {
  cv::Mat panorama(kRows, kColumns, CV_8UC1, cv::Scalar(210));
  panorama.rowRange(kRows / 2, kRows).setTo(cv::Scalar(80));
  cv::RNG houses(3);
  for (int x = 0; x < kColumns; x += 20) {
    const int top = houses.uniform(40, 85), grey = houses.uniform(30, 190);
    for (const int round : {-kColumns, 0, kColumns}) {
      cv::rectangle(panorama, cv::Rect(x + turned + round, top, 20, 95 - top), cv::Scalar(grey), -1);
    }
  }
  cv::Mat noise(panorama.size(), CV_8UC1);
  cv::RNG(noise_seed).fill(noise, cv::RNG::UNIFORM, 0, 5);
  return panorama + noise;
}

cv::Mat flipped(const cv::Mat& panorama, int code) {
  cv::Mat result;
  cv::flip(panorama, result, code);
  return result;
}

TEST(PanoramaWatch, LetsPassWhatADriveShows) {
  PanoramaWatch watch;
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(watch.add(street(4 * i, i))) << i;
}

TEST(PanoramaWatch, FindsACameraThatHangs) {
  PanoramaWatch watch;
  watch.add(street());
  EXPECT_EQ(watch.add(street()), "repeats its image (frozen)");
  EXPECT_FALSE(watch.add(street(0, 2)));
}

TEST(PanoramaWatch, FindsACameraThatIsTurnedOver) {
  for (const auto& [code, fault] :
       {std::pair{-1, "is upside down"}, {0, "is upside down and mirrored"}, {1, "is mirrored"}}) {
    PanoramaWatch watch;
    EXPECT_FALSE(watch.add(street(0, 1)));
    for (int i = 0; i < 5; ++i) EXPECT_EQ(watch.add(flipped(street(3 * i, 10 + i), code)), fault) << i;
    EXPECT_FALSE(watch.add(street(15, 2))) << "it is turned back from " << fault;
  }
}

TEST(PanoramaWatch, JudgesByTheLastThatShowedSomething) {
  PanoramaWatch watch;
  watch.add(street());
  EXPECT_FALSE(watch.add(cv::Mat::zeros(kRows, kColumns, CV_8UC1)));
  EXPECT_FALSE(watch.add(cv::Mat()));
  EXPECT_TRUE(watch.add(flipped(street(2, 5), -1)));
}

TEST(CoveredShare, IsOfTheColumnsThatShowNothing) {
  cv::Mat panorama = street();
  EXPECT_EQ(covered_share(panorama, 0.25, 0.6), 0.0);
  panorama.colRange(0, kColumns / 2).setTo(cv::Scalar(20));
  EXPECT_NEAR(covered_share(panorama, 0.25, 0.6), 0.5, 0.02);
}

}  // namespace
}  // namespace panvo::vision
