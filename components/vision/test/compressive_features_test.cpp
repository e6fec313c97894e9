// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/compressive_features.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "panvo/vision/adaptive_selection.hpp"
#include "panvo/vision/cyclic_integral_images.hpp"
#include "panvo/vision/equirectangular.hpp"
#include "panvo/vision/intensity_histogram.hpp"
#include "panvo/vision/measurement_matrix.hpp"

namespace panvo::vision {
namespace {

constexpr double kPi = std::numbers::pi;

/// A band without symmetry, smooth across its seam.
cv::Mat draw_band(int columns = 360, int rows = 60) {
  cv::Mat band(rows, columns, CV_8UC1);
  for (int v = 0; v < rows; ++v) {
    for (int u = 0; u < columns; ++u) {
      const double angle = 2.0 * kPi * u / columns;
      const double grey = 128.0 + 40.0 * std::sin(3.0 * angle + 0.1 * v) + 30.0 * std::sin(7.0 * angle - 0.07 * v) +
                          25.0 * std::sin(17.0 * angle + 0.3 * v) + 20.0 * std::sin(41.0 * angle);
      band.at<uchar>(v, u) = cv::saturate_cast<uchar>(grey);
    }
  }
  return band;
}

/// The band after the vehicle has turned to the left by this many columns.
cv::Mat turn(const cv::Mat& band, int columns) {
  cv::Mat turned(band.size(), band.type());
  for (int u = 0; u < band.cols; ++u) band.col(u).copyTo(turned.col((u + columns) % band.cols));
  return turned;
}

MeasurementMatrix draw_matrix(cv::Size band, int rows = 50, std::uint64_t seed = 1) {
  return {band, large_scale(band, 0.3), {rows, 4, true, 0.1}, seed};
}

TEST(Equirectangular, LooksForwardInTheMiddleAndRightOfItToTheRight) {  // [Lu2015 Eq. 9] [Lu2015 Eq. 10]
  const Equirectangular panorama{1080, 540};
  EXPECT_TRUE(panorama.project({0, 0, 5}).isApprox(Eigen::Vector2d(540, 270)));
  EXPECT_TRUE(panorama.project({5, 0, 0}).isApprox(Eigen::Vector2d(810, 270)));
  EXPECT_TRUE(panorama.project({0, 0, -5}).isApprox(Eigen::Vector2d(0, 270)));
  EXPECT_NEAR(panorama.project({0, -1, std::sqrt(3.0)}).y(), 180.0, 1e-9);  // 30 degrees above the horizon
  EXPECT_DOUBLE_EQ(panorama.azimuth_rad(270), -0.5 * kPi);
  EXPECT_DOUBLE_EQ(panorama.elevation_rad(405), 0.25 * kPi);
}

TEST(Equirectangular, ElevationIsDefinedWhereArcsinOfTheErratumIsNot) {  // [Lu2015 Eq. 9]
  const Equirectangular panorama{1080, 540};
  EXPECT_NEAR(panorama.project({0.1, 5, 0.1}).y(), panorama.row(std::atan2(5.0, std::hypot(0.1, 0.1))), 1e-9);
  EXPECT_NEAR(panorama.project({0, -1, 0}).y(), 0.0, 1e-9);
}

TEST(Equirectangular, PixelsComeBack) {
  const Equirectangular panorama{1080, 540};
  for (const Eigen::Vector2d& pixel :
       {Eigen::Vector2d(0, 100), Eigen::Vector2d(123.25, 400.5), Eigen::Vector2d(1079.5, 270)}) {
    EXPECT_TRUE(panorama.project(panorama.unproject(pixel)).isApprox(pixel, 1e-9)) << pixel.transpose();
    EXPECT_NEAR(panorama.unproject(pixel).norm(), 1.0, 1e-12);
  }
}

TEST(Wrap, TakesDifferencesTheShortWayRound) {
  EXPECT_DOUBLE_EQ(wrap_columns(1079, 1080), -1);
  EXPECT_DOUBLE_EQ(wrap_columns(540, 1080), 540);
  EXPECT_DOUBLE_EQ(wrap_columns(-540, 1080), 540);
  EXPECT_DOUBLE_EQ(wrap_columns(-2161, 1080), -1);
}

TEST(CyclicIntegralImages, GiveTheMeanThatIsComputedByHand) {  // [Lu2015 Eq. 2]
  const cv::Mat band = (cv::Mat_<uchar>(3, 4) << 1, 2, 3, 4, 10, 20, 30, 40, 5, 6, 7, 8);
  const CyclicIntegralImages images(band);
  EXPECT_FLOAT_EQ(images.mean_intensity({1, 0, 2, 2}), (2 + 3 + 20 + 30) / 4.0F);
  EXPECT_FLOAT_EQ(images.mean_intensity({3, 1, 2, 2}), (40 + 10 + 8 + 5) / 4.0F);  // across the seam
  EXPECT_FLOAT_EQ(images.mean_intensity({2, 0, 4, 3}), 136 / 12.0F);               // full turn
}

TEST(CyclicIntegralImages, GiveTheGradientsOfASlopeAndOfItsSeam) {  // [Lu2015 3.2]
  cv::Mat band(6, 40, CV_8UC1);
  for (int v = 0; v < 6; ++v) {
    for (int u = 0; u < 40; ++u) band.at<uchar>(v, u) = static_cast<uchar>(3 * u + 5 * v);
  }
  const CyclicIntegralImages images(band);
  const GradientStatistics slope = images.mean_gradients({5, 1, 10, 4});
  EXPECT_FLOAT_EQ(slope[0], 3.0F);
  EXPECT_FLOAT_EQ(slope[1], 3.0F);
  EXPECT_FLOAT_EQ(slope[2], 5.0F);
  EXPECT_FLOAT_EQ(slope[3], 5.0F);
  const GradientStatistics seam = images.mean_gradients({39, 2, 1, 1});
  EXPECT_LT(seam[0], 0.0F);
  EXPECT_FLOAT_EQ(seam[1], -seam[0]);
}

TEST(CyclicIntegralImages, AgreeWithOneAnotherWhateverTheWidestRectangle) {
  const cv::Mat band = draw_band();
  const CyclicIntegralImages all(band), narrow(band, 50);
  EXPECT_EQ(narrow.widest(), 50);
  const BandRectangle rectangle{340, 7, 50, 20};
  EXPECT_EQ(all.mean_intensity(rectangle), narrow.mean_intensity(rectangle));
  EXPECT_EQ(all.mean_gradients(rectangle), narrow.mean_gradients(rectangle));
}

TEST(MeasurementMatrix, DrawsRectanglesWithinThePapersBounds) {  // [Lu2015 4.2]
  const cv::Size band(1080, 150);
  for (const auto& [bounds, widths, heights] : {std::tuple{large_scale(band), std::pair(54, 1080), std::pair(19, 150)},
                                                std::tuple{small_scale(band), std::pair(27, 54), std::pair(15, 19)}}) {
    const MeasurementMatrix matrix(band, bounds, {300, 4, false, 1.0}, 7);
    for (int row = 0; row < matrix.rows(); ++row) {
      for (const auto& element : matrix.row(row)) {
        EXPECT_GE(element.rectangle.width, widths.first);
        EXPECT_LT(element.rectangle.width, widths.second);
        EXPECT_GE(element.rectangle.height, heights.first);
        EXPECT_LT(element.rectangle.height, heights.second);
        EXPECT_LE(element.rectangle.y + element.rectangle.height, band.height);
      }
    }
  }
}

TEST(MeasurementMatrix, HasHalfOfItsSignsPositive) {  // [Lu2015 Eq. 1] [Lu2015 Eq. 3]
  const cv::Size band(1080, 150);
  const MeasurementMatrix matrix(band, large_scale(band), {1000, 4, false, 1.0}, 3);
  double plus = 0.0;
  for (int row = 0; row < 1000; ++row) {
    ASSERT_EQ(matrix.row(row).size(), 4U);
    for (const auto& element : matrix.row(row)) plus += element.sign > 0 ? 1.0 : 0.0;
  }
  EXPECT_NEAR(plus / 4000.0, 0.5, 0.03);
}

TEST(MeasurementMatrix, ChoosesAQuarterOfTheStatisticsAndNeverNone) {  // [Lu2015 Eq. 4] [Lu2015 Eq. 5]
  const cv::Size band(1080, 150);
  const MeasurementMatrix matrix(band, large_scale(band), {1000, 4, false, 1.0}, 3);
  double chosen = 0.0;
  for (int row = 0; row < 1000; ++row) {
    for (const auto& element : matrix.row(row)) {
      double here = 0.0;
      for (const float choice : element.statistics) here += choice;
      EXPECT_GE(here, 1.0);
      chosen += here;
    }
  }
  // One of four on average, slightly more because "none" (0.75^4) is redrawn.
  EXPECT_NEAR(chosen / 4000.0, 1.0 / (1.0 - std::pow(0.75, 4)), 0.04);
}

TEST(MeasurementMatrix, IsTheSameForASeedAndAnotherForAnother) {
  const cv::Size band(360, 60);
  const auto rectangles = [&](std::uint64_t seed) {
    std::vector<int> numbers;
    const MeasurementMatrix matrix = draw_matrix(band, 20, seed);
    for (int row = 0; row < 20; ++row) {
      for (const auto& e : matrix.row(row))
        numbers.insert(numbers.end(), {e.rectangle.x, e.rectangle.y, e.rectangle.width});
    }
    return numbers;
  };
  EXPECT_EQ(rectangles(5), rectangles(5));
  EXPECT_NE(rectangles(5), rectangles(6));
}

TEST(MeasurementMatrix, RefusesWhatHasNoRoom) {
  EXPECT_THROW(MeasurementMatrix({100, 20}, {{50, 10}, {200, 20}}, {}, 1), std::invalid_argument);
  EXPECT_THROW(MeasurementMatrix({100, 20}, large_scale({100, 20}), {10, 3, true, 0.5}, 1), std::invalid_argument);
  EXPECT_THROW(MeasurementMatrix({100, 20}, {{{{0, 15, 10, 10}}}}), std::invalid_argument);
}

TEST(ResponseReader, SumsSignedMeansOfIntensityAndChosenStatistics) {  // [Lu2015 Eq. 1] [Lu2015 Eq. 3] [Lu2015 Eq. 4]
  const cv::Mat band = draw_band();
  const CyclicIntegralImages images(band);
  const BandRectangle a{10, 5, 30, 20}, b{350, 0, 40, 60};
  const MeasurementMatrix matrix(band.size(), {{{a, 1.0F, {1, 0, 0, 1}}, {b, -1.0F, {0, 1, 0, 0}}}});
  const ResponseReader reader(images, matrix, {100.0F, 10.0F, 2.0F});
  EXPECT_NEAR(reader.read_intensity(0), (images.mean_intensity(a) - images.mean_intensity(b)) / 10.0F, 1e-4);
  const GradientStatistics of_a = images.mean_gradients(a), of_b = images.mean_gradients(b);
  EXPECT_NEAR(reader.read_gradient(0), (of_a[0] + of_a[3] - of_b[1]) / 2.0F, 1e-4);
  EXPECT_EQ(reader.read(0).intensity, reader.read_intensity(0));
  EXPECT_EQ(reader.read(0).gradient, reader.read_gradient(0));
}

TEST(ResponseReader, ReadsATurnedBandAtTheTurnsOffset) {
  const cv::Mat band = draw_band();
  const MeasurementMatrix matrix = draw_matrix(band.size());
  const cv::Mat prepared = prepare_band(band);
  const CyclicIntegralImages images(prepared);
  const BandNormalisation normalisation = BandNormalisation::of(prepared, images);
  for (const int columns : {1, 77, 359}) {
    const CyclicIntegralImages turned(prepare_band(turn(band, columns)));
    const ResponseReader before(images, matrix, normalisation), after(turned, matrix, normalisation);
    for (int row = 0; row < matrix.rows(); ++row) {
      EXPECT_EQ(before.read_intensity(row), after.read_intensity(row, columns));
      EXPECT_EQ(before.read_gradient(row), after.read_gradient(row, columns));
      EXPECT_EQ(before.read_gradient(row, -columns), after.read_gradient(row));
    }
  }
}

TEST(ResponseReader, RefusesAMatrixOfAnotherBand) {
  const cv::Mat band = draw_band();
  const CyclicIntegralImages images(band, 20);
  EXPECT_THROW(ResponseReader(images, draw_matrix(band.size()), {}), std::invalid_argument);
  EXPECT_THROW(ResponseReader(images, draw_matrix({720, 60}), {}), std::invalid_argument);
}

TEST(BandNormalisation, CancelsGainOffsetAndCoverOfOneSide) {
  const cv::Mat band = draw_band();
  const MeasurementMatrix matrix = draw_matrix(band.size());
  cv::Mat changed;
  band.convertTo(changed, CV_8U, 0.6, 15.0);
  changed.colRange(300, 340).setTo(0);
  std::vector<double> before, after;
  for (const auto& [image, responses] : {std::pair(band, &before), std::pair(changed, &after)}) {
    const cv::Mat prepared = prepare_band(image);
    const CyclicIntegralImages images(prepared);
    const ResponseReader reader(images, matrix, BandNormalisation::of(prepared, images));
    for (int row = 0; row < matrix.rows(); ++row) {
      const auto& rectangles = matrix.row(row);
      const bool is_covered = std::any_of(rectangles.begin(), rectangles.end(), [](const auto& e) {
        const int begin = e.rectangle.x, end = begin + e.rectangle.width;
        return (begin < 341 && end > 299) || end > 659;
      });
      if (!is_covered) responses->push_back(reader.read_intensity(row));
    }
  }
  ASSERT_GT(before.size(), 10U);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(before[i], after[i], 0.15 + 0.1 * std::abs(before[i]));
}

TEST(FitGaussian, GivesMeanAndDeviation) {  // [Lu2015 Eq. 6]
  const Gaussian gaussian = fit_gaussian(std::vector<float>{1.0F, 3.0F, 5.0F, 7.0F});
  EXPECT_DOUBLE_EQ(gaussian.mean, 4.0);
  EXPECT_DOUBLE_EQ(gaussian.deviation, std::sqrt(5.0));
}

TEST(HellingerDistance, IsZeroForEqualGaussians) {  // [Lu2015 Eq. 7]
  EXPECT_NEAR(hellinger_distance({2.0, 0.5}, {2.0, 0.5}), 0.0, 1e-9);
  EXPECT_EQ(hellinger_distance({2.0, 0.0}, {2.0, 0.0}), 0.0);
  EXPECT_EQ(hellinger_distance({2.0, 0.0}, {3.0, 0.0}), 1.0);
}

TEST(HellingerDistance, HasItsClosedForm) {  // [Lu2015 Eq. 7]
  // Equal deviations: h^2 = 1 - exp(-d^2 / (8 sigma^2)); equal means: h^2 = 1 - sqrt(2 s t / (s^2 + t^2)).
  EXPECT_NEAR(hellinger_distance({0.0, 2.0}, {3.0, 2.0}), std::sqrt(1.0 - std::exp(-9.0 / 32.0)), 1e-12);
  EXPECT_NEAR(hellinger_distance({1.0, 1.0}, {1.0, 3.0}), std::sqrt(1.0 - std::sqrt(0.6)), 1e-12);
}

TEST(HellingerDistance, IsTheIntegralItStandsFor) {  // [Lu2015 Eq. 7]
  const Gaussian a{0.3, 0.7}, b{1.1, 1.6};
  const auto density = [](const Gaussian& g, double x) {
    return std::exp(-0.5 * std::pow((x - g.mean) / g.deviation, 2)) / (g.deviation * std::sqrt(2.0 * kPi));
  };
  double overlap = 0.0;
  for (double x = -20.0; x < 20.0; x += 1e-3) overlap += 1e-3 * std::sqrt(density(a, x) * density(b, x));
  EXPECT_NEAR(hellinger_distance(a, b), std::sqrt(1.0 - overlap), 1e-6);
}

std::vector<SelectedFeature> select(const cv::Mat& band, const MeasurementMatrix& matrix,
                                    SelectionParameters parameters) {
  const CyclicIntegralImages images(band);
  return select_features(images, matrix, BandNormalisation::of(band, images), parameters, 1);
}

TEST(AdaptiveSelection, KeepsTheBestOfIntensityAndGradientByDescendingWeight) {  // [Lu2015 Eq. 8]
  const cv::Mat band = draw_band();
  const MeasurementMatrix matrix = draw_matrix(band.size(), 60);
  SelectionParameters parameters;
  parameters.kept = 120;
  const auto all = select(band, matrix, parameters);
  parameters.kept = 30;
  const auto best = select(band, matrix, parameters);
  ASSERT_EQ(best.size(), 30U);
  ASSERT_EQ(all.size(), 120U);
  const auto is_intensity = [](const SelectedFeature& f) { return f.row < 60; };
  EXPECT_TRUE(std::any_of(best.begin(), best.end(), is_intensity));
  EXPECT_FALSE(std::all_of(best.begin(), best.end(), is_intensity));
  for (std::size_t i = 0; i < best.size(); ++i) {
    EXPECT_EQ(best[i].row, all[i].row);
    EXPECT_EQ(best[i].weight, all[i].weight);
    if (i > 0) {
      EXPECT_LE(best[i].weight, best[i - 1].weight);
    }
    EXPECT_GT(best[i].spread, 0.0F);
  }
}

TEST(AdaptiveSelection, DropsPatchesThatSeeNothingThatVaries) {  // [Lu2015 3.2], Fig. 2b
  cv::Mat band = draw_band();
  band.colRange(100, 260).setTo(120);
  const std::vector<std::vector<MeasurementMatrix::Element>> rows{{{{170, 20, 20, 20}, 1.0F}},
                                                                  {{{20, 20, 20, 20}, 1.0F}}};
  SelectionParameters parameters;
  parameters.gamma_px = 40.0;
  for (const SelectedFeature& feature : select(band, {band.size(), rows}, parameters)) EXPECT_EQ(feature.row % 2, 1);
  EXPECT_EQ(select(band, {band.size(), rows}, parameters).size(), 2U);
}

TEST(AdaptiveSelection, GivesEverySectorItsShare) {
  const cv::Mat band = draw_band();
  const MeasurementMatrix matrix = draw_matrix(band.size(), 200);
  SelectionParameters parameters;
  parameters.kept = 48;
  parameters.sectors = 4;
  std::vector<int> of_side(2, 0);
  for (const SelectedFeature& feature : select(band, matrix, parameters)) {
    const BandRectangle& r = matrix.row(feature.row % 200)[0].rectangle;
    ++of_side[static_cast<std::size_t>((r.x + r.width / 2) % band.cols / 180)];
  }
  EXPECT_NEAR(of_side[0], 24, 6);
  EXPECT_NEAR(of_side[1], 24, 6);
}

TEST(AdaptiveSelection, RefusesRadiiOutOfOrder) {
  const cv::Mat band = draw_band();
  SelectionParameters parameters;
  parameters.beta_px = 4.0;
  EXPECT_THROW(select(band, draw_matrix(band.size()), parameters), std::invalid_argument);
}

TEST(IntensityHistogram, IsTheSameAtEveryHeadingAndForEveryGain) {
  const cv::Mat band = draw_band();
  const auto histogram = [](const cv::Mat& image) {
    return intensity_histogram(image, BandNormalisation::of(image, CyclicIntegralImages(image)), 32);
  };
  const std::vector<float> here = histogram(band);
  double sum = 0.0;
  for (const float share : here) sum += share;
  EXPECT_NEAR(sum, 1.0, 1e-5);
  EXPECT_LT(histogram_distance(here, histogram(turn(band, 90))), 1e-6);  // 90: whole sectors
  cv::Mat darker;
  band.convertTo(darker, CV_8U, 0.6, 20.0);
  EXPECT_LT(histogram_distance(here, histogram(darker)), 0.01);
  EXPECT_GT(histogram_distance(here, histogram(cv::Mat(255 - band) * 0.5 + 0.5 * turn(band, 100))), 0.0);
}

TEST(HistogramDistance, IsTheEarthsWork) {
  EXPECT_FLOAT_EQ(histogram_distance(std::vector<float>{1, 0, 0}, std::vector<float>{0, 0, 1}), 1.0F);
  EXPECT_FLOAT_EQ(histogram_distance(std::vector<float>{1, 0, 0}, std::vector<float>{0, 1, 0}), 0.5F);
  EXPECT_THROW(histogram_distance(std::vector<float>{1}, std::vector<float>{0, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::vision
