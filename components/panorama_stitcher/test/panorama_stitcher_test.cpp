// SPDX-License-Identifier: Apache-2.0
#include "panvo/panorama_stitcher/panorama_stitcher.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

#include "painted_rigs.hpp"
#include "painted_sphere.hpp"

namespace panvo::panorama_stitcher {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int kColumns = 540;
const vision::Equirectangular kPanorama{kColumns, kColumns / 2};

StitchSettings settings(bool compensates_gains = false) { return {kColumns, compensates_gains, {}}; }

struct Difference {
  double mean = 0.0, largest = 0.0;
};

/// Compares rows above elevation `lowest_rad` (downwards positive).
Difference difference_to_truth(const cv::Mat& panorama, double lowest_rad = 10.0) {
  const cv::Mat truth = true_panorama(panorama.cols, panorama.channels());
  const int rows = std::min(panorama.rows, static_cast<int>(kPanorama.row(lowest_rad)));
  const cv::Mat found = panorama.rowRange(0, rows), wanted = truth.rowRange(0, rows);
  const double values = static_cast<double>(wanted.total()) * wanted.channels();
  return {cv::norm(found, wanted, cv::NORM_L1) / values, cv::norm(found, wanted, cv::NORM_INF)};
}

/// Source heads of each pixel, the first in the low byte; 0xFFFF: none.
cv::Mat heads_of(const StitchTable& table) {
  cv::Mat heads(table.rows, table.columns, CV_16UC1, cv::Scalar(0xFFFF));
  for (const auto& run : table.runs) {
    for (std::uint32_t i = 0; i < run.count; ++i)
      heads.ptr<std::uint16_t>()[run.destination_px + i] = static_cast<std::uint16_t>(run.second << 8 | run.first);
  }
  for (const auto& patch : table.patches)
    heads.ptr<std::uint16_t>()[patch.destination_px] = static_cast<std::uint16_t>(kNoHead << 8 | patch.head);
  return heads;
}

TEST(PanoramaStitcher, MakesThePanoramaOfTwoFisheyes) {
  for (const int channels : {1, 3}) {
    PanoramaStitcher stitcher(two_fisheyes(), settings());
    cv::Mat panorama;
    stitcher.stitch(paint_heads(stitcher.rig(), channels), panorama);
    ASSERT_EQ(panorama.type(), CV_8UC(channels));
    const auto difference = difference_to_truth(panorama);
    EXPECT_LT(difference.mean, 0.5);
    EXPECT_LT(difference.largest, 4.0);
  }
}

TEST(PanoramaStitcher, MakesThePanoramaOfSixHeads) {
  PanoramaStitcher stitcher(six_heads(), settings());
  cv::Mat panorama;
  stitcher.stitch(paint_heads(stitcher.rig(), 3), panorama);
  const auto difference = difference_to_truth(panorama, stitcher.rig().lowest_rad);
  EXPECT_LT(difference.mean, 0.5);
  EXPECT_LT(difference.largest, 4.0);
}

/// A head offset of 5 cm shifts the image by several pixels at 0.6 m; the correct radius removes the shift.
TEST(PanoramaStitcher, CorrectsForThePlacesOfTheHeads) {
  PanoramaRig rig = six_heads();
  rig.radius_m = 0.6;
  const auto images = paint_heads(rig, 1);
  cv::Mat right, wrong;
  PanoramaStitcher(rig, settings()).stitch(images, right);
  rig.radius_m = 0.0;
  PanoramaStitcher(rig, settings()).stitch(images, wrong);
  EXPECT_LT(difference_to_truth(right, rig.lowest_rad).mean, 0.5);
  EXPECT_GT(difference_to_truth(wrong, rig.lowest_rad).mean, 2.0);
}

TEST(PanoramaStitcher, TakesPicturesThatShareAnImage) {
  PanoramaRig rig = two_fisheyes();
  for (auto& head : rig.heads) {
    head.image_size_px = {960, 500};
    head.region_px = {head.image == 0 ? 0 : 480, 20, 480, 480};
    head.image = 0;
  }
  PanoramaStitcher stitcher(rig, settings());
  cv::Mat panorama;
  stitcher.stitch(paint_heads(rig, 3), panorama);
  EXPECT_LT(difference_to_truth(panorama).mean, 0.5);
}

TEST(PanoramaStitcher, TurnsAnEquirectangularImage) {
  Head head{"camera",
            0,
            {720, 360},
            {0, 0, 720, 360},
            vision::Equirectangular{720, 360},
            0.0,
            looking(131.0, 20.0, 7.0, 0.0)};
  PanoramaStitcher stitcher(rig_of({head}), settings());
  cv::Mat panorama;
  stitcher.stitch(paint_heads(stitcher.rig(), 3), panorama);
  const auto difference = difference_to_truth(panorama);
  EXPECT_LT(difference.mean, 0.5);
  EXPECT_LT(difference.largest, 5.0) << "also at the wrap-around";
}

/// Rotated by half a pixel, each pixel is the mean of two, also at the wrap-around.
TEST(PanoramaStitcher, JoinsTheEndsOfAnEquirectangularImage) {
  const Head head{"camera",
                  0,
                  {kColumns, kColumns / 2},
                  {0, 0, kColumns, kColumns / 2},
                  kPanorama,
                  0.0,
                  looking(180.0 / kColumns, 0.0, 0.0, 0.0)};
  PanoramaStitcher stitcher(rig_of({head}), settings());
  cv::Mat image(kColumns / 2, kColumns, CV_8UC1, cv::Scalar(100)), panorama;
  image.col(0).setTo(200);
  stitcher.stitch(std::vector{image}, panorama);
  const cv::Mat horizon = panorama.row(kColumns / 4);
  EXPECT_EQ(cv::countNonZero(horizon == 150), 2) << "to both sides of the first column";
  EXPECT_EQ(cv::countNonZero(horizon == 100), kColumns - 2);
}

TEST(PanoramaStitcher, UnrollsAMirror) {
  const vision::LensCamera lens{{260, 260, 399.5, 399.5, 800, 800}, vision::LensModel::kMei, {0, 0, 0, 0, 1.0}};
  Head mirror = head_of("mirror", 0, lens, 220.0, looking(0.0, 90.0, 0.0, 0.0));
  mirror.blind_spot_rad = 30.0 * kDegree;
  PanoramaRig rig = rig_of({mirror});
  rig.highest_rad = -55.0 * kDegree;
  rig.lowest_rad = 15.0 * kDegree;
  PanoramaStitcher stitcher(rig, settings());
  cv::Mat panorama;
  stitcher.stitch(paint_heads(rig, 1), panorama);
  const cv::Mat truth = true_panorama(kColumns, 1);
  const cv::Range seen(static_cast<int>(kPanorama.row(rig.highest_rad)),
                       static_cast<int>(kPanorama.row(rig.lowest_rad)));
  EXPECT_LT(cv::norm(panorama.rowRange(seen), truth.rowRange(seen), cv::NORM_L1) / (kColumns * seen.size()), 0.6);
  EXPECT_EQ(cv::countNonZero(panorama.row(static_cast<int>(kPanorama.row(-65.0 * kDegree)))), 0) << "the blind spot";
}

/// The seam of two equal fisheyes back to back is 90 degrees off both axes, to the left and right.
TEST(StitchTable, HasItsSeamHalfWayBetweenTheHeadsAndBlendsAboutIt) {
  PanoramaRig rig = two_fisheyes();
  rig.heads[0].panorama_from_head = looking(0.0, 0.0, 0.0, 0.0);
  rig.heads[1].panorama_from_head = looking(180.0, 0.0, 0.0, 0.0);
  const cv::Mat heads = heads_of(make_stitch_table(rig, kColumns, {true, true}));
  const auto* horizon = heads.ptr<std::uint16_t>(kColumns / 4);
  const auto first = [&](double azimuth_deg) {
    return horizon[std::lround(kPanorama.column(azimuth_deg * kDegree))] & 255;
  };
  const auto second = [&](double azimuth_deg) {
    return horizon[std::lround(kPanorama.column(azimuth_deg * kDegree))] >> 8;
  };
  EXPECT_EQ(first(89.0), 0);
  EXPECT_EQ(first(91.0), 1);
  EXPECT_EQ(first(-89.0), 0);
  EXPECT_EQ(first(-91.0), 1);
  EXPECT_EQ(second(88.0), 1);
  EXPECT_EQ(second(92.0), 0);
  EXPECT_EQ(second(86.0), kNoHead) << "6 degrees wide: 3 to each side";
  EXPECT_EQ(second(94.0), kNoHead);
}

TEST(StitchTable, BlendsWithoutAStep) {
  PanoramaRig rig = two_fisheyes();
  const auto images = paint_heads(rig, 1);
  std::vector<cv::Mat> even{cv::Mat(images[0].size(), CV_8UC1, cv::Scalar(80)),
                            cv::Mat(images[1].size(), CV_8UC1, cv::Scalar(140))};
  PanoramaStitcher stitcher(rig, settings());
  cv::Mat panorama;
  stitcher.stitch(even, panorama);
  int max_step = 0;
  for (int column = 1; column < kColumns; ++column) {
    max_step = std::max(
        max_step, std::abs(panorama.at<uchar>(kColumns / 4, column) - panorama.at<uchar>(kColumns / 4, column - 1)));
  }
  EXPECT_LE(max_step, 9) << "60 grey levels over 6 degrees, 9 px";
  EXPECT_GE(max_step, 5);
}

TEST(PanoramaStitcher, GoesOnWithoutAHead) {
  PanoramaStitcher stitcher(six_heads(), settings());
  auto images = paint_heads(stitcher.rig(), 3);
  cv::Mat whole, without, again;
  stitcher.stitch(images, whole);
  stitcher.use({true, true, false, true, true, true});
  images[2].release();
  stitcher.stitch(images, without);
  const int row = kColumns / 4;
  const auto column = [](double azimuth_deg) {
    return static_cast<int>(std::lround(kPanorama.column(azimuth_deg * kDegree)));
  };
  EXPECT_EQ(without.at<cv::Vec3b>(row, column(144.0)), cv::Vec3b(0, 0, 0)) << "what only the third head sees";
  EXPECT_EQ(without.at<cv::Vec3b>(row, column(0.0)), whole.at<cv::Vec3b>(row, column(0.0)));
  const cv::Vec3b neighbours =
      without.at<cv::Vec3b>(row, column(144.0 - 34.0));  // the second head sees it 38 degrees off its axis
  const cv::Vec3b truth = whole.at<cv::Vec3b>(row, column(144.0 - 34.0));
  EXPECT_LT(cv::norm(neighbours, truth, cv::NORM_INF), 4.0) << "its neighbour sees it, too";
  stitcher.use(std::vector<bool>(6, true));
  stitcher.stitch(paint_heads(stitcher.rig(), 3), again);
  EXPECT_EQ(cv::norm(whole, again, cv::NORM_INF), 0.0);
}

TEST(PanoramaStitcher, FindsTheGainsOfItsHeads) {
  const std::vector<double> exposures{1.0, 0.8, 1.1, 0.95, 1.05, 0.9};
  PanoramaStitcher stitcher(six_heads(), settings(true));
  const auto images = paint_heads(stitcher.rig(), 3, exposures);
  cv::Mat panorama;
  stitcher.stitch(images, panorama);
  const double at_first = stitcher.gain(1) / stitcher.gain(0);
  EXPECT_LT(at_first, 1.03) << "slowly";
  for (int i = 0; i < 200; ++i) stitcher.stitch(images, panorama);
  for (std::size_t head = 1; head < exposures.size(); ++head)
    EXPECT_NEAR(stitcher.gain(head) / stitcher.gain(0), exposures[0] / exposures[head], 0.01) << "head " << head;
}

TEST(PanoramaStitcher, GivesTheSamePanoramaForTheSameImages) {
  const auto images = paint_heads(six_heads(), 1, {1.0, 0.8, 1.1, 0.95, 1.05, 0.9});
  PanoramaStitcher one(six_heads(), settings(true)), other(six_heads(), settings(true));
  cv::Mat first, second;
  for (int i = 0; i < 5; ++i) {
    one.stitch(images, first);
    other.stitch(images, second);
    ASSERT_EQ(cv::norm(first, second, cv::NORM_INF), 0.0);
  }
}

std::string refusal(const PanoramaRig& rig, int columns = kColumns) {
  try {
    const PanoramaStitcher stitcher(rig, {columns, false, {}});
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(PanoramaStitcher, SaysWhereNobodyLooks) {
  PanoramaRig rig = six_heads();
  rig.lowest_rad = 80.0 * kDegree;
  EXPECT_THAT(refusal(rig), AllOf(HasSubstr("no head sees"), HasSubstr("elevation -")));
  rig = six_heads();
  rig.heads.erase(rig.heads.begin());
  EXPECT_THAT(refusal(rig), AllOf(HasSubstr("no head sees"), HasSubstr("azimuth")));
  rig.heads.clear();
  EXPECT_THAT(refusal(rig), HasSubstr("0 heads"));
  EXPECT_THAT(refusal(six_heads(), 541), HasSubstr("541 columns"));
}

TEST(PanoramaStitcher, RefusesImagesOfAnotherCalibration) {
  PanoramaStitcher stitcher(two_fisheyes(), settings());
  EXPECT_THAT(*stitcher.find_fault(1, cv::Mat(240, 240, CV_8UC1)),
              AllOf(HasSubstr("240 x 240"), HasSubstr("'back'"), HasSubstr("480 x 480"), HasSubstr("calibrate")));
  EXPECT_THAT(*stitcher.find_fault(0, cv::Mat(480, 480, CV_16UC1)), HasSubstr("mono8"));
  EXPECT_FALSE(stitcher.find_fault(0, cv::Mat(480, 480, CV_8UC3)));
  auto images = paint_heads(stitcher.rig(), 1);
  cv::Mat panorama;
  cv::cvtColor(images[1], images[1], cv::COLOR_GRAY2BGR);
  EXPECT_THROW(stitcher.stitch(images, panorama), std::invalid_argument);
  images.pop_back();
  EXPECT_THROW(stitcher.stitch(images, panorama), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::panorama_stitcher
