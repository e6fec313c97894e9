// SPDX-License-Identifier: Apache-2.0
#include "panvo/panoramic_compass/point_field.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "painted_panorama.hpp"

namespace panvo::panoramic_compass {
namespace {

double unmoved(double /*column*/) { return 0.0; }
double same_size(const Eigen::Vector2d& /*then*/, const Eigen::Vector2d& /*now*/) { return 1.0; }

/// Roofs under a uniform sky, also seen from a smaller distance.
class Roofs {
 public:
  static constexpr double kNearer = 1.2;

  Roofs() : band_(paint_panorama().rowRange(150, 294).clone()) {
    cv::RNG random(5);
    for (int left = 0; left < kColumns; left += 30) {
      band_(cv::Rect(left, 0, 30, random.uniform(40, 100))).setTo(240);
    }
  }
  cv::Mat from(double nearer) const {
    const cv::Matx23d about_middle(nearer, 0.0, (1.0 - nearer) * kMiddle.x(), 0.0, nearer,
                                   (1.0 - nearer) * kMiddle.y());
    cv::Mat seen;
    cv::warpAffine(band_, seen, about_middle, band_.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
    return seen;
  }
  /// Mean row error, px, of the points near the centre after approaching the roofs; `looks`: factor of the expected
  /// magnification.
  double mean_error(double looks) const {
    PointField field(RoundBand(band_), {});
    std::vector<FoundPoint> found;
    double last = 1.0;
    for (const double nearer : {1.05, 1.1, 1.15, kNearer}) {
      const auto shift_px = [&](double u) { return (nearer / last - 1.0) * (u - kMiddle.x()); };
      found = field.follow(RoundBand(from(nearer)), shift_px,
                           [&](const auto&, const auto&) { return 1.0 + (nearer - 1.0) * looks; });
      last = nearer;
    }
    double sum = 0.0;
    int count = 0;
    for (const FoundPoint& point : found) {
      if (std::abs(point.then.x() - kMiddle.x()) > 200.0) continue;
      sum += point.now.y() - (kMiddle.y() + kNearer * (point.then.y() - kMiddle.y()));
      ++count;
    }
    EXPECT_GT(count, 20);
    return sum / count;
  }

 private:
  inline static const Eigen::Vector2d kMiddle{500.0, 72.0};
  cv::Mat band_;
};

TEST(PointField, FindsWhatLooksLargerFromNearerByWhereItIs) {
  const Roofs roofs;
  const double as_large = std::abs(roofs.mean_error(1.0)), as_before = std::abs(roofs.mean_error(0.0));
  EXPECT_LT(as_large, 0.05);
  EXPECT_GT(as_before, 3.0 * as_large) << "the expected magnification must matter";
}

TEST(PointField, FindsItsPointsBetweenPixelsAndOverTheSeam) {
  const cv::Mat band = paint_panorama().rowRange(150, 294);
  const cv::Mat moved = turned_left(band, 7.3);
  PointField field(RoundBand(band), {});
  ASSERT_GT(field.size(), 100U);
  const auto about = [](double) { return 5.0; };
  const auto found = field.follow(RoundBand(moved), about, same_size);
  ASSERT_GT(found.size(), field.size() * 8 / 10);
  double squares = 0.0;
  for (const FoundPoint& point : found) {
    const double shift = std::remainder(point.now.x() - point.then.x(), kColumns);
    squares += std::pow(shift - 7.3, 2);
    EXPECT_GE(point.now.x(), 0.0);
    EXPECT_LT(point.now.x(), kColumns);
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(found.size())), 0.15);
}

TEST(PointField, HasNoPointsInTheSky) {
  cv::Mat clouds(144, kColumns, CV_8UC1, cv::Scalar(200));
  cv::RNG random(11);
  for (int i = 0; i < 150; ++i) {
    cv::circle(clouds, cv::Point{random.uniform(20, kColumns - 20), random.uniform(0, 144)}, 8, cv::Scalar(250), -1);
  }
  EXPECT_GT(PointField(RoundBand(clouds), {}).size(), 50U);
  EXPECT_EQ(PointField(RoundBand(clouds, 150.0), {}).size(), 0U);
}

TEST(PointField, GivesUpWhatIsNotFoundThreeTimesRunning) {
  const cv::Mat band = paint_panorama().rowRange(150, 294), other = paint_panorama(2).rowRange(150, 294);
  PointField field(RoundBand(band), {});
  const auto begun_with = field.size();
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT(field.follow(RoundBand(other), unmoved, same_size).size(), begun_with / 4);
  }
  EXPECT_LT(field.size(), begun_with / 2);
}

}  // namespace
}  // namespace panvo::panoramic_compass
