// SPDX-License-Identifier: Apache-2.0
#include "panvo/panoramic_compass/panoramic_compass.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "painted_panorama.hpp"

namespace panvo::panoramic_compass {
namespace {

using std::numbers::pi;

CompassParameters with_method(const std::string& method) {
  CompassParameters parameters;
  parameters.method = method;
  return parameters;
}

/// Tests of both methods.
class EitherMethod : public testing::TestWithParam<std::string> {
 protected:
  AzimuthChange change(const cv::Mat& then, const cv::Mat& now, std::optional<double> expected_rad = std::nullopt) {
    PanoramicCompass compass(with_method(GetParam()));
    EXPECT_FALSE(compass.track(1'000, then));
    return compass.track(2'000, now, expected_rad).value();
  }
  double tolerance_rad() const { return (GetParam() == "all_round" ? 0.05 : 0.4) * kColumn_rad; }

  const cv::Mat street = paint_panorama();
};

TEST_P(EitherMethod, FindsNoTurnBetweenTwoIdenticalPanoramas) {
  const AzimuthChange same = change(street, street);
  EXPECT_TRUE(same.valid) << same.reason;
  EXPECT_NEAR(same.change_rad, 0.0, 0.05 * kColumn_rad);
  EXPECT_NEAR(same.side_parallax_rad, 0.0, 0.05 * kColumn_rad);
  EXPECT_EQ(same.from_stamp_ns, 1'000);
  EXPECT_EQ(same.stamp_ns, 2'000);
}

// [Lu2015 Eq. 12]: a turn to the left moves the scene to the right.
TEST_P(EitherMethod, CallsATurnToTheLeftPositive) {
  const AzimuthChange left = change(street, turned_left(street, 20.0));
  EXPECT_TRUE(left.valid) << left.reason;
  EXPECT_NEAR(left.change_rad, 20.0 * kColumn_rad, tolerance_rad());
  const AzimuthChange right = change(street, turned_left(street, -20.0));
  EXPECT_NEAR(right.change_rad, -20.0 * kColumn_rad, tolerance_rad());
}

TEST_P(EitherMethod, FindsTurnsOfFractionsOfAColumn) {
  for (const double columns : {-61.4, -7.75, -0.5, 0.3, 3.25, 44.6}) {
    const AzimuthChange turn = change(street, turned_left(street, columns));
    EXPECT_TRUE(turn.valid) << columns << ": " << turn.reason;
    EXPECT_NEAR(turn.change_rad, columns * kColumn_rad, tolerance_rad()) << columns;
  }
}

TEST_P(EitherMethod, WrapsAtHalfATurn) {
  const AzimuthChange beyond = change(street, turned_left(street, 545.0), pi);
  EXPECT_TRUE(beyond.valid) << beyond.reason;
  EXPECT_NEAR(beyond.change_rad, -535.0 * kColumn_rad, tolerance_rad());
}

TEST_P(EitherMethod, SearchesAboutTheExpectedTurn) {
  const cv::Mat now = turned_left(street, 200.0);
  const AzimuthChange blind = change(street, now);
  EXPECT_FALSE(blind.valid && std::abs(blind.change_rad - 200.0 * kColumn_rad) > 0.01);
  const AzimuthChange expected = change(street, now, 190.0 * kColumn_rad);
  EXPECT_TRUE(expected.valid) << expected.reason;
  EXPECT_NEAR(expected.change_rad, 200.0 * kColumn_rad, tolerance_rad());
}

TEST_P(EitherMethod, SaysThatATurnIsBeyondItsRange) {
  const AzimuthChange beyond = change(street, turned_left(street, 200.0));
  EXPECT_FALSE(beyond.valid);
  EXPECT_FALSE(beyond.reason.empty());
}

TEST_P(EitherMethod, DoesNotMindExposureOrNoise) {
  cv::Mat now, noise(street.size(), CV_8SC1);
  turned_left(street, 12.4).convertTo(now, CV_8U, 0.6, 15.0);
  cv::RNG random(7);
  random.fill(noise, cv::RNG::NORMAL, 0.0, 3.0);
  cv::add(now, noise, now, cv::noArray(), CV_8U);
  const AzimuthChange turn = change(street, now);
  EXPECT_TRUE(turn.valid) << turn.reason;
  EXPECT_NEAR(turn.change_rad, 12.4 * kColumn_rad, 2.0 * tolerance_rad());
}

TEST_P(EitherMethod, SaysWhyAPanoramaIsOfNoUse) {
  const auto of = [&](const cv::Mat& now) { return change(street, now).reason; };
  EXPECT_NE(of(cv::Mat::zeros(street.size(), CV_8UC1)).find("is black"), std::string::npos);
  EXPECT_NE(of(cv::Mat(street.size(), CV_8UC1, cv::Scalar(255))).find("is saturated"), std::string::npos);
  EXPECT_NE(of(cv::Mat(street.size(), CV_8UC1, cv::Scalar(120))).find("is constant"), std::string::npos);
  EXPECT_NE(of(street.colRange(0, 900)).find("twice as wide"), std::string::npos);
  EXPECT_NE(of(cv::Mat()).find("is empty"), std::string::npos);
}

TEST_P(EitherMethod, IsNotSureOfAnotherPlace) {
  const AzimuthChange jump = change(street, paint_panorama(2));
  EXPECT_FALSE(jump.valid);
  EXPECT_FALSE(jump.reason.empty());
}

TEST_P(EitherMethod, WaitsForAFirstPanoramaThatShowsSomething) {
  PanoramicCompass compass(with_method(GetParam()));
  EXPECT_FALSE(compass.track(1, cv::Mat::zeros(kRows, kColumns, CV_8UC1)));
  EXPECT_FALSE(compass.track(2, street));
  EXPECT_TRUE(compass.track(3, street));
}

TEST_P(EitherMethod, GoesOnAfterDarkPanoramas) {
  PanoramicCompass compass(with_method(GetParam()));
  compass.track(1, street);
  EXPECT_FALSE(compass.track(2, cv::Mat::zeros(street.size(), CV_8UC1), 5.0 * kColumn_rad)->valid);
  const auto after = compass.track(3, turned_left(street, 10.0), 5.0 * kColumn_rad);
  EXPECT_TRUE(after->valid) << after->reason;
  EXPECT_EQ(after->from_stamp_ns, 1);
  EXPECT_NEAR(after->change_rad, 10.0 * kColumn_rad, tolerance_rad());
}

TEST_P(EitherMethod, TakesColourAndOtherSizes) {
  cv::Mat colour, large;
  cv::cvtColor(turned_left(street, 9.0), colour, cv::COLOR_GRAY2BGR);
  EXPECT_NEAR(change(street, colour).change_rad, 9.0 * kColumn_rad, tolerance_rad());
  cv::resize(colour, large, cv::Size(2160, 1080), 0.0, 0.0, cv::INTER_CUBIC);
  EXPECT_NEAR(change(street, large).change_rad, 9.0 * kColumn_rad, 2.0 * tolerance_rad() + 0.3 * kColumn_rad);
}

TEST_P(EitherMethod, IsTheSameBitForBit) {
  const cv::Mat now = driven(street, 0.05, 0.03);
  const AzimuthChange first = change(street, now), second = change(street, now);
  EXPECT_EQ(first.change_rad, second.change_rad);
  EXPECT_EQ(first.variance_rad2, second.variance_rad2);
  EXPECT_EQ(first.side_parallax_rad, second.side_parallax_rad);
}

// [Lu2015 6]: the offsets of the left and right patches give the rough translation.
TEST_P(EitherMethod, TellsHowFarWhatIsAbeamFellBehind) {
  const AzimuthChange ahead = change(street, driven(street, 0.1, 0.05));
  EXPECT_TRUE(ahead.valid) << ahead.reason;
  EXPECT_NEAR(ahead.side_parallax_rad, 0.1, 0.02);
  const AzimuthChange back = change(street, driven(street, -0.1, 0.05));
  EXPECT_NEAR(back.side_parallax_rad, -0.1, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Methods, EitherMethod, testing::Values("all_round", "two_patches"),
                         [](const auto& test) { return test.param; });

AzimuthChange change_all_round(const cv::Mat& then, const cv::Mat& now) {
  PanoramicCompass compass(CompassParameters{});
  compass.track(1, then);
  return compass.track(2, now).value();
}

TEST(AllRound, TellsInWhichDirectionTheVehicleMoved) {
  const cv::Mat street = paint_panorama();
  const AzimuthChange ahead = change_all_round(street, driven(street, 0.1, 0.05));
  EXPECT_NEAR(ahead.motion_azimuth_rad, -0.05, 0.01) << "the vehicle now points to the left of its direction of motion";
  EXPECT_GT(ahead.motion_azimuth_variance_rad2, 0.0);
  EXPECT_LT(ahead.motion_azimuth_variance_rad2, 0.03 * 0.03);
  const AzimuthChange back = change_all_round(street, driven(street, -0.1, 0.05));
  EXPECT_NEAR(back.motion_azimuth_rad, pi - 0.05, 0.01);
  // The camera is rotated by 25 columns to the left: the direction of motion lies to its right.
  const AzimuthChange aside = change_all_round(turned_left(street, 25.0), turned_left(driven(street, 0.1, 0.05), 25.0));
  EXPECT_NEAR(aside.motion_azimuth_rad, -25.0 * kColumn_rad - 0.05, 0.01);
  const AzimuthChange stands = change_all_round(street, street);
  EXPECT_GT(stands.motion_azimuth_variance_rad2, 0.5) << "no motion";
}

// An error of the turn moves the points like a motion aside of as many radians.
TEST(AllRound, KnowsTheDirectionNoBetterThanTheTurnLetsIt) {
  const cv::Mat street = paint_panorama();
  for (const double parallax : {0.02, 0.05, 0.1}) {
    const AzimuthChange change = change_all_round(street, driven(street, parallax, 0.05));
    ASSERT_TRUE(change.valid) << change.reason;
    const double aside_rad = std::sqrt(change.motion_azimuth_variance_rad2) * parallax;
    EXPECT_GE(aside_rad, std::sqrt(change.variance_rad2)) << "at a parallax of " << parallax;
    EXPECT_LE(aside_rad, 4.0 * std::sqrt(change.variance_rad2)) << "at a parallax of " << parallax;
  }
}

TEST(PointsAllRound, AreNotMisledByAMoverThatCoversAThirdOfTheView) {
  const cv::Mat street = paint_panorama(), bus = paint_panorama(5);
  cv::Mat then = street.clone(), now = turned_left(street, 10.0);
  bus.colRange(300, 660).copyTo(then.colRange(300, 660));
  bus.colRange(300, 660).copyTo(now.colRange(330, 690));  // moves independently in front of the scene
  const AzimuthChange turn = change_all_round(then, now);
  EXPECT_TRUE(turn.valid) << turn.reason;
  EXPECT_NEAR(turn.change_rad, 10.0 * kColumn_rad, 0.1 * kColumn_rad);
}

/// A vehicle with four masts, of another seed than the street, over half of the view.
cv::Mat with_masts(const cv::Mat& street) {
  static const cv::Mat masts = paint_panorama(5);
  cv::Mat view = street.clone();
  for (int column = 0; column < kColumns; column += 270) {
    masts.colRange(column, column + 135).copyTo(view.colRange(column, column + 135));
  }
  return view;
}

TEST(PointsAllRound, LeaveOutTheVehicle) {
  const cv::Mat street = paint_panorama(), turned = turned_left(street, 10.0);
  cv::Mat seen(54, 108, CV_8UC1, cv::Scalar(255));
  for (int column = 0; column < 108; column += 27) seen.colRange(column, column + 14).setTo(0);
  PanoramicCompass told(with_method("all_round")), told_late(with_method("all_round"));
  told.set_seen(seen);
  told.track(1'000, with_masts(street));
  told_late.track(1'000, with_masts(street));
  told_late.set_seen(seen);
  for (PanoramicCompass* compass : {&told, &told_late}) {
    const auto turn = compass->track(2'000, with_masts(turned));
    EXPECT_TRUE(turn->valid) << turn->reason;
    EXPECT_NEAR(turn->change_rad, 10.0 * kColumn_rad, 0.2 * kColumn_rad);
  }
  const AzimuthChange misled = change_all_round(with_masts(street), with_masts(turned));
  EXPECT_GT(std::abs(misled.change_rad - 10.0 * kColumn_rad), 1.0 * kColumn_rad) << "this would show nothing";
}

TEST(PointsAllRound, TellATurnFromADriveAhead) {
  const cv::Mat street = paint_panorama();
  for (const double turn_rad : {-0.2, 0.0, 0.1}) {
    const AzimuthChange turn = change_all_round(street, driven(street, 0.08, turn_rad));
    EXPECT_TRUE(turn.valid) << turn.reason;
    EXPECT_NEAR(turn.change_rad, turn_rad, 0.1 * kColumn_rad);
  }
}

TEST(PointsAllRound, DoNotMindASuddenShadowOverHalfTheView) {
  const cv::Mat street = paint_panorama();
  cv::Mat now = turned_left(street, 6.5);
  now.colRange(200, 740).convertTo(now.colRange(200, 740), CV_8U, 0.4);
  const AzimuthChange turn = change_all_round(street, now);
  EXPECT_TRUE(turn.valid) << turn.reason;
  EXPECT_NEAR(turn.change_rad, 6.5 * kColumn_rad, 0.1 * kColumn_rad);
}

TEST(PointsAllRound, AreMeasuredAgainstOneReferenceAsLongAsItLasts) {
  const cv::Mat street = paint_panorama();
  CompassParameters parameters;
  parameters.agreement.max_reference_panoramas = 5;
  PanoramicCompass compass(parameters);
  compass.track(0, street);
  for (int i = 1; i <= 12; ++i) {
    const auto turn = compass.track(i, turned_left(street, 4.3 * i));
    ASSERT_TRUE(turn && turn->valid) << i << ": " << turn->reason;
    const int reference = (i - 1) / 5 * 5;
    EXPECT_EQ(turn->from_stamp_ns, reference);
    EXPECT_NEAR(turn->change_rad, 4.3 * (i - reference) * kColumn_rad, 0.1 * kColumn_rad);
  }
}

TEST(PointsAllRound, AreToldWithTheirReferenceAndThoseBefore) {
  CompassParameters parameters;
  parameters.agreement.max_reference_panoramas = 2;
  PanoramicCompass compass(parameters);
  compass.keep_earlier_points();
  const cv::Mat street = paint_panorama();
  const auto look = [&](std::int64_t stamp_ns, double columns) {
    compass.track(stamp_ns, turned_left(street, columns));
    return compass.points();
  };
  EXPECT_EQ(look(0, 0.0), nullptr) << "nothing to compare with";
  ASSERT_EQ(look(1, 10.0)->tracks.size(), 1U);
  ASSERT_EQ(look(2, 20.0)->tracks.size(), 1U) << "the last panorama with this reference";
  const TrackedPoints* points = look(3, 30.0);
  ASSERT_EQ(points->tracks.size(), 2U);
  EXPECT_EQ(points->stamp_ns, 3);
  EXPECT_EQ(points->tracks[0].from_stamp_ns, 2);
  EXPECT_EQ(points->tracks[1].from_stamp_ns, 0);
  const double turned_rad[] = {10.0 * kColumn_rad, 30.0 * kColumn_rad};
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_GT(points->tracks[i].pairs.size(), 50U);
    for (const BearingPair& pair : points->tracks[i].pairs) {
      const Eigen::Vector3d expected = Eigen::AngleAxisd(-turned_rad[i], Eigen::Vector3d::UnitZ()) * pair.then;
      EXPECT_LT((pair.now - expected).norm(), 0.3 * kColumn_rad);
    }
  }
  EXPECT_LT(
      (points->now_from_then - Eigen::AngleAxisd(-turned_rad[0], Eigen::Vector3d::UnitZ()).toRotationMatrix()).norm(),
      0.1 * kColumn_rad);
  for (int i = 4; i < 16; ++i) points = look(i, 10.0 * i);
  EXPECT_LE(points->tracks.size(), 4U) << "bounded";
  EXPECT_EQ(look(16, 700.0), nullptr) << "no valid turn";
}

TEST(PointsAllRound, SayThatTheyContradictEachOther) {
  const cv::Mat street = paint_panorama();
  cv::Mat now = turned_left(street, 4.0);
  for (int i = 0; i < 8; ++i) {  // each sector moves differently
    const int columns = 40 * (i * 5 % 8) - 150;
    turned_left(street, columns).colRange(135 * i, 135 * i + 135).copyTo(now.colRange(135 * i, 135 * i + 135));
  }
  const AzimuthChange turn = change_all_round(street, now);
  EXPECT_FALSE(turn.valid) << turn.change_rad / kColumn_rad;
  EXPECT_FALSE(turn.reason.empty());
}

TEST(PointsAllRound, DoNotFollowTheSky) {
  cv::Mat then = paint_panorama(), now = turned_left(then, 8.0);
  cv::RNG random(3);
  for (cv::Mat* panorama : {&then, &now}) {  // clouds that move differently from the walls
    const int drift = panorama == &now ? 40 : 0;
    cv::RNG same(11);
    for (int i = 0; i < 60; ++i) {
      const cv::Point place{same.uniform(0, kColumns), same.uniform(0, 250)};
      for (const int turn : {-kColumns, 0}) {
        cv::Mat mask = *panorama > 200;
        cv::Mat clouds = panorama->clone();
        cv::circle(clouds, place + cv::Point(drift + turn, 0), 12, cv::Scalar(250), -1);
        clouds.copyTo(*panorama, mask);
      }
    }
  }
  const AzimuthChange turn = change_all_round(then, now);
  EXPECT_TRUE(turn.valid) << turn.reason;
  EXPECT_NEAR(turn.change_rad, 8.0 * kColumn_rad, 0.1 * kColumn_rad);
}

TEST(PointsAllRound, DoNotFollowTheCloudsOfOpenLand) {
  cv::Mat land(kRows, kColumns, CV_8UC1, cv::Scalar(100));  // blue sky
  land.rowRange(kRows / 2, kRows).setTo(cv::Scalar(85));
  cv::RNG random(7);
  for (int i = 0; i < 250; ++i) {  // trees and cars at the horizon
    const cv::Rect object{random.uniform(0, kColumns), random.uniform(240, 275), random.uniform(4, 14), 12};
    cv::rectangle(land, object, cv::Scalar(random.uniform(15, 70)), -1);
  }
  const auto view = [&](double turned_columns, int clouds_moved) {
    cv::Mat clouds(kRows, kColumns, CV_8UC1, cv::Scalar(0));
    cv::RNG same(11);
    for (int i = 0; i < 120; ++i) {
      const cv::Rect cloud{same.uniform(0, kColumns), same.uniform(60, 210), same.uniform(20, 60), same.uniform(8, 20)};
      for (const int round : {-kColumns, 0})
        cv::rectangle(clouds, cloud + cv::Point(clouds_moved + round, 0), cv::Scalar(250), -1);
    }
    cv::Mat seen = cv::max(turned_left(land, turned_columns), clouds);
    cv::GaussianBlur(seen, seen, cv::Size(5, 5), 1.0);
    return seen;
  };
  const AzimuthChange turn = change_all_round(view(0.0, 0), view(8.0, 20));
  EXPECT_TRUE(turn.valid) << turn.reason;
  EXPECT_NEAR(turn.change_rad, 8.0 * kColumn_rad, 0.3 * kColumn_rad);
}

TEST(PointsAllRound, TellThatTheyMoveWhereWhatIsAbeamIsFar) {
  const auto view = [](double near_moved_rad) {
    cv::Mat land(kRows, kColumns, CV_8UC1, cv::Scalar(200));
    land.rowRange(kRows / 2, kRows).setTo(cv::Scalar(85));
    cv::RNG same(7);
    for (int i = 0; i < 150; ++i) {  // trees: those ahead and behind are near, the few abeam are far
      const double azimuth = same.uniform(-pi, pi);
      const int wide = same.uniform(6, 16), grey = same.uniform(15, 70);
      const bool is_abeam = std::abs(std::abs(azimuth) - pi / 2.0) < 0.7;
      if (is_abeam && i % 20 != 0) continue;
      const double seen = azimuth + (is_abeam ? 0.0 : near_moved_rad * std::sin(azimuth));
      const int column = static_cast<int>(std::lround((pi - seen) / kColumn_rad));
      for (const int round : {-kColumns, 0, kColumns})
        cv::rectangle(land, cv::Rect{column + round, 250, wide, 24}, cv::Scalar(grey), -1);
    }
    cv::GaussianBlur(land, land, cv::Size(5, 5), 1.0);
    return land;
  };
  const AzimuthChange moved = change_all_round(view(0.0), view(0.06));
  EXPECT_TRUE(moved.valid) << moved.reason;
  EXPECT_GT(moved.side_parallax_rad, 0.01);
  const AzimuthChange stood = change_all_round(view(0.0), view(0.0));
  EXPECT_LT(std::abs(stood.side_parallax_rad), 0.002);
}

TEST(PointsAllRound, TurnAboutTheVehiclesAxisWhereTheCameraIsTilted) {
  const cv::Mat street = paint_panorama();
  // the camera looks left: turns are unaffected, the direction of motion changes
  const Eigen::Matrix3d base_from_panorama =
      Eigen::AngleAxisd(pi / 2.0, Eigen::Vector3d::UnitZ()).toRotationMatrix() * upright_base_from_panorama();
  PanoramicCompass compass(CompassParameters{}, 1, base_from_panorama);
  compass.track(1, turned_left(street, 270.0));
  const auto turn = compass.track(2, turned_left(driven(street, 0.1, 0.05), 270.0));
  ASSERT_TRUE(turn && turn->valid) << turn->reason;
  EXPECT_NEAR(turn->change_rad, 0.05, 0.1 * kColumn_rad);
  EXPECT_NEAR(turn->side_parallax_rad, 0.1, 0.03);
}

TEST(CompassParameters, ThatContradictEachOtherAreAProgrammingError) {
  CompassParameters parameters;
  parameters.patches.beta_deg = 1.0;
  EXPECT_THROW(PanoramicCompass{parameters}, std::invalid_argument);
  EXPECT_THROW(PanoramicCompass{with_method("magnetic")}, std::invalid_argument);
}

}  // namespace
}  // namespace panvo::panoramic_compass
