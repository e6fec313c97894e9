// SPDX-License-Identifier: Apache-2.0
// Timing of the localizer's output, and input that is late, missing or wrong.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/testing.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::localizer {
namespace {

namespace states = panvo_msgs::msg::LocalizationState_Constants;
namespace outcomes = panvo_msgs::msg::CorrectionOutcome_Constants;

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

constexpr std::int64_t kBegin_ns = 1'700'000'000'000'000'000;
constexpr std::int64_t kPeriod_ns = 40'000'000;
constexpr std::int64_t kSecond_ns = 1'000'000'000;

Eigen::Isometry3d ahead(double x, double y = 0.0) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(x, y, 0.0);
  return pose;
}

/// A localizer of a vehicle that drives straight, 0.2 m per frame.
class Vehicle {
 public:
  explicit Vehicle(const std::map<std::string, std::string>& parameters = {{"fusion.clock_sigma_s", "0"}},
                   bool again = false, std::function<std::int64_t()> clock = {})
      : harness_({.replay = true, .clock = std::move(clock), .again = again}) {
    harness_.load("panvo_localizer", "LocalizerComponent", parameters);
  }

  static std::int64_t stamp(int frame) { return kBegin_ns + frame * kPeriod_ns; }

  static nav_msgs::msg::Odometry odometry(int frame) {
    nav_msgs::msg::Odometry message;
    message.header().stamp(conversions::to_stamp(stamp(frame)));
    message.header().frame_id("odom");
    message.child_frame_id("base_link");
    message.pose().pose(conversions::to_pose(ahead(0.2 * frame)));
    message.pose().covariance(conversions::to_array((1e-4 + 1e-4 * frame) * vision::Matrix6d::Identity()));
    message.twist().twist().linear().x(5.0);
    return message;
  }
  void drive(int from, int to) {
    for (int i = from; i < to; ++i) harness_.publish(topics::kOdometryBinocular, odometry(i));
  }
  void drive_with_clock_set(int from, int to, std::int64_t forward_ns) {
    for (int i = from; i < to; ++i) {
      auto message = odometry(i);
      message.header().stamp(conversions::to_stamp(stamp(i) + forward_ns));
      harness_.publish(topics::kOdometryBinocular, message);
    }
  }
  void tell_quality(int frame, bool is_reliable) {
    panvo_msgs::msg::OdometryQuality quality;
    quality.header().stamp(conversions::to_stamp(stamp(frame)));
    quality.reliable(is_reliable);
    quality.inlier_ratio(is_reliable ? 1.0 : 0.4);
    harness_.publish(topics::kOdometryQuality, quality);
  }
  void tell_landmark(std::uint32_t id, std::int64_t stamp_ns, const Eigen::Isometry3d& pose) {
    panvo_msgs::msg::PanoramicLandmark landmark;
    landmark.header().stamp(conversions::to_stamp(stamp_ns));
    landmark.id(id);
    landmark.histogram({1.0F});
    landmark.pose().pose(conversions::to_pose(pose));
    landmark.pose().covariance(conversions::to_array(1e-4 * vision::Matrix6d::Identity()));
    harness_.publish(topics::kLandmarks, landmark);
  }
  panvo_msgs::msg::PositionCorrection correction(std::uint32_t id, int frame, const Eigen::Isometry3d& from) const {
    panvo_msgs::msg::PositionCorrection message;
    message.header().stamp(conversions::to_stamp(stamp(frame)));
    message.landmark_id(id);
    message.state(panvo_msgs::msg::PositionCorrection_Constants::FULL);
    message.landmark_from_base().pose(conversions::to_pose(from));
    message.landmark_from_base().covariance(conversions::to_array(1e-4 * vision::Matrix6d::Identity()));
    return message;
  }
  /// Advances time by a message that the localizer ignores.
  void pass_time_to(int frame) {
    panvo_msgs::msg::AzimuthChange change;
    change.header().stamp(conversions::to_stamp(stamp(frame)));
    change.valid(false);
    harness_.publish(topics::kAzimuthChange, change);
  }
  double x() const { return enhanced.back()->pose().pose().position().x(); }
  std::uint8_t state() const { return states.back()->state(); }

  runtime::ComponentHarness harness_;
  const std::vector<std::shared_ptr<const nav_msgs::msg::Odometry>>& enhanced =
      harness_.collect(topics::kOdometryEnhanced);
  const std::vector<std::shared_ptr<const tf2_msgs::msg::TFMessage>>& tf = harness_.collect(topics::kTf);
  const std::vector<std::shared_ptr<const panvo_msgs::msg::LocalizationState>>& states =
      harness_.collect(topics::kLocalizationState);
  const std::vector<std::shared_ptr<const panvo_msgs::msg::Integrity>>& integrities =
      harness_.collect(topics::kIntegrity);
  const std::vector<std::shared_ptr<const panvo_msgs::msg::CorrectionOutcome>>& outcomes =
      harness_.collect(topics::kCorrectionOutcome);
};

/// Poses and states of a drive with an unreliable middle; `late`: delay of the quality messages, in frames.
std::vector<std::string> told_with_quality(int late) {
  Vehicle vehicle;
  const auto is_reliable = [](int frame) { return frame < 20 || frame >= 60; };
  vehicle.tell_quality(-100, true);  // quality is published
  for (int i = 0; i < 100; ++i) {
    if (late == 0) vehicle.tell_quality(i, is_reliable(i));
    vehicle.drive(i, i + 1);
    if (late > 0 && i >= late) vehicle.tell_quality(i - late, is_reliable(i - late));
  }
  for (int i = 100 - late; i < 100; ++i) vehicle.tell_quality(i, is_reliable(i));
  std::vector<std::string> told;
  for (const auto& pose : vehicle.enhanced) {
    told.push_back(fmt::format("{} {} {}", conversions::stamp_ns(*pose), pose->pose().pose().position().x(),
                               pose->pose().covariance()[0]));
  }
  return told;
}

TEST(LocalizerTime, ItsPosesDoNotDependOnTheOrderInWhichOdometryAndItsQualityArrive) {
  const auto told = told_with_quality(0);
  ASSERT_THAT(told, SizeIs(100));
  for (const int late : {1, 2, 4}) EXPECT_EQ(told_with_quality(late), told) << late;
}

TEST(LocalizerTime, TellsTheStateTwiceASecondWhateverArrives) {
  Vehicle vehicle;
  vehicle.pass_time_to(0);
  vehicle.pass_time_to(50);
  EXPECT_GE(vehicle.states.size(), 4U) << "in 2 s without odometry";
  EXPECT_EQ(vehicle.state(), states::STARTING);
  vehicle.drive(50, 100);
  const auto before = vehicle.states.size();
  vehicle.drive(100, 150);
  EXPECT_GE(vehicle.states.size(), before + 4);
  EXPECT_EQ(vehicle.state(), states::TRACKING);
  EXPECT_EQ(conversions::to_ns(vehicle.states.back()->since()), Vehicle::stamp(50));
}

TEST(LocalizerTime, SaysThatThePoseIsStaleAndSinceWhen) {
  const std::map<std::string, std::string> parameters{{"integrity.alert_limit_m", "20"}};
  Vehicle vehicle(parameters);
  vehicle.drive(0, 51);
  EXPECT_TRUE(vehicle.integrities.back()->usable()) << vehicle.integrities.back()->reason();
  vehicle.pass_time_to(50 + 12);
  EXPECT_EQ(vehicle.state(), states::TRACKING) << "0.48 s";
  vehicle.pass_time_to(50 + 16);
  EXPECT_EQ(vehicle.state(), states::STALE) << "0.64 s";
  EXPECT_EQ(conversions::to_ns(vehicle.states.back()->since()), Vehicle::stamp(50));
  EXPECT_FALSE(vehicle.integrities.back()->usable());
  EXPECT_THAT(vehicle.integrities.back()->reason(), HasSubstr("stale: no /odometry/binocular for"));
  const double sigma_m = vehicle.states.back()->position_sigma_m();
  const auto told = vehicle.states.size();
  vehicle.pass_time_to(50 + 25 * 4);
  EXPECT_GE(vehicle.states.size(), told + 6) << "twice a second";
  EXPECT_GT(vehicle.states.back()->position_sigma_m(), sigma_m + 10.0) << "the vehicle may have moved";
  vehicle.drive(151, 152);
  EXPECT_EQ(vehicle.state(), states::TRACKING);
}

TEST(LocalizerTime, TellsACorrectionAtOnceAndWithALaterStamp) {
  Vehicle vehicle;
  vehicle.drive(0, 51);
  vehicle.tell_landmark(1, Vehicle::stamp(25), ahead(5.0));
  vehicle.drive(51, 151);
  const double before = vehicle.x();
  const auto poses = vehicle.enhanced.size();
  vehicle.harness_.publish(topics::kCorrection, vehicle.correction(1, 150, ahead(24.5, -0.5)));
  ASSERT_THAT(vehicle.outcomes, SizeIs(1));
  ASSERT_EQ(vehicle.outcomes[0]->outcome(), outcomes::APPLIED) << vehicle.outcomes[0]->reason();
  ASSERT_EQ(vehicle.enhanced.size(), poses + 1);
  EXPECT_NEAR(vehicle.x(), before - 0.5, 0.1);
  EXPECT_EQ(conversions::stamp_ns(*vehicle.enhanced.back()), Vehicle::stamp(150) + 1);
  EXPECT_EQ(conversions::to_ns(vehicle.tf.back()->transforms()[0].header().stamp()), Vehicle::stamp(150) + 1);
  vehicle.drive(151, 152);
  EXPECT_EQ(conversions::stamp_ns(*vehicle.enhanced.back()), Vehicle::stamp(151));
}

TEST(LocalizerTime, OneLandmarkWithAnOldStampTakesNothingFromAVehicleThatKnowsWhereItIs) {
  Vehicle vehicle;
  vehicle.drive(0, 151);
  vehicle.tell_landmark(9, kBegin_ns - 86'400 * kSecond_ns, ahead(300.0));
  vehicle.drive(151, 201);
  EXPECT_EQ(vehicle.state(), states::TRACKING);
  EXPECT_NEAR(vehicle.x(), 40.0, 1e-6);
  // It is joined when two panoramas agree on it.
  vehicle.harness_.publish(topics::kCorrection, vehicle.correction(9, 195, ahead(1.0)));
  EXPECT_EQ(vehicle.outcomes.back()->outcome(), outcomes::REJECTED);
  vehicle.harness_.publish(topics::kCorrection, vehicle.correction(9, 200, ahead(2.0)));
  EXPECT_EQ(vehicle.outcomes.back()->outcome(), outcomes::APPLIED) << vehicle.outcomes.back()->reason();
  EXPECT_NEAR(vehicle.x(), 302.0, 0.1);
  EXPECT_EQ(vehicle.state(), states::RELOCALISED);
}

TEST(LocalizerTime, OneCorrectionOfTheFutureKeepsNoneWaiting) {
  Vehicle vehicle;
  vehicle.drive(0, 51);
  vehicle.tell_landmark(1, Vehicle::stamp(25), ahead(5.0));
  vehicle.harness_.publish(topics::kCorrection, vehicle.correction(1, 25 * 3600, ahead(1.0)));
  vehicle.drive(51, 151);
  vehicle.harness_.publish(topics::kCorrection, vehicle.correction(1, 150, ahead(25.0)));
  ASSERT_THAT(vehicle.outcomes, SizeIs(1));
  EXPECT_EQ(vehicle.outcomes[0]->outcome(), outcomes::APPLIED);
}

/// Each with a different fault.
std::vector<nav_msgs::msg::Odometry> wrong_odometry(int frame) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<nav_msgs::msg::Odometry> all(5, Vehicle::odometry(frame));
  all[0].pose().covariance()[7] = none;
  all[1].pose().pose().position().x(1e200);
  all[2].pose().pose().position().x(none);
  all[3].pose().covariance()[1] = all[3].pose().covariance()[6] = 1e3;
  all[4].pose().covariance()[0] = 1e308;
  return all;
}

TEST(LocalizerTime, WrongNumbersNeitherStopItNorMoveIt) {
  Vehicle vehicle;
  vehicle.drive(0, 51);
  vehicle.tell_landmark(1, Vehicle::stamp(25), ahead(5.0));
  const double before = vehicle.x();
  const auto poses = vehicle.enhanced.size();
  for (const auto& odometry : wrong_odometry(51)) vehicle.harness_.publish(topics::kOdometryBinocular, odometry);
  auto correction = vehicle.correction(1, 50, ahead(5.0));
  correction.landmark_from_base().covariance()[1] = 1.0;
  vehicle.harness_.publish(topics::kCorrection, correction);
  geometry_msgs::msg::PoseWithCovarianceStamped said;
  said.header().frame_id("map");
  said.pose().pose().position().x(1e200);
  vehicle.harness_.publish(topics::kInitialPose, said);
  said.pose().pose().position().x(1.0);
  said.pose().covariance()[0] = 1e308;
  vehicle.harness_.publish(topics::kInitialPose, said);
  panvo_msgs::msg::AzimuthChange change;
  change.header().stamp(conversions::to_stamp(Vehicle::stamp(50)));
  change.from_stamp(conversions::to_stamp(Vehicle::stamp(45)));
  change.azimuth_change_rad(0.5);
  change.variance_rad2(1e-300);
  change.valid(true);
  vehicle.harness_.publish(topics::kAzimuthChange, change);
  EXPECT_EQ(vehicle.enhanced.size(), poses);
  EXPECT_EQ(vehicle.x(), before);
  EXPECT_THAT(vehicle.harness_.log(), Not(testing::Contains(HasSubstr("stopped by an error"))));
  vehicle.drive(51, 52);
  EXPECT_NEAR(vehicle.x(), 10.2, 1e-9);
  EXPECT_EQ(vehicle.state(), states::TRACKING);
}

TEST(LocalizerTime, OdometryThatCannotBeUsedMakesThePoseStale) {
  Vehicle vehicle;
  vehicle.drive(0, 51);
  for (int i = 51; i < 80; ++i) {
    vehicle.harness_.publish(topics::kOdometryBinocular, wrong_odometry(i)[0]);
    vehicle.pass_time_to(i);  // rejected messages do not advance time
  }
  EXPECT_EQ(vehicle.state(), states::STALE) << "its sigma must grow";
}

TEST(LocalizerTime, GoesOnWhenTheClockIsSetBack) {
  Vehicle vehicle;
  vehicle.drive(0, 51);
  vehicle.tell_landmark(1, Vehicle::stamp(25), ahead(5.0));
  vehicle.drive(51, 151);
  const std::int64_t hour_ns = 3600 * kSecond_ns;
  vehicle.drive_with_clock_set(151, 176, -hour_ns);
  EXPECT_NEAR(vehicle.x(), 35.0, 1e-6);
  EXPECT_EQ(conversions::stamp_ns(*vehicle.enhanced.back()), Vehicle::stamp(175) - hour_ns);
  EXPECT_EQ(vehicle.state(), states::TRACKING);
  auto correction = vehicle.correction(1, 175, ahead(29.5));
  correction.header().stamp(conversions::to_stamp(Vehicle::stamp(175) - hour_ns));
  vehicle.harness_.publish(topics::kCorrection, correction);
  ASSERT_THAT(vehicle.outcomes, SizeIs(1));
  EXPECT_EQ(vehicle.outcomes[0]->outcome(), outcomes::APPLIED) << vehicle.outcomes[0]->reason();
  EXPECT_NEAR(vehicle.x(), 34.5, 0.2);
}

TEST(LocalizerTime, AppliesNothingThatWaitedFromBeforeTheClockWasSetBack) {
  Vehicle vehicle;
  vehicle.drive(0, 51);
  vehicle.tell_landmark(1, Vehicle::stamp(25), ahead(5.0));
  vehicle.drive(51, 151);
  vehicle.harness_.publish(topics::kCorrection, vehicle.correction(1, 155, ahead(24.5)));
  vehicle.drive_with_clock_set(151, 301, -4 * kSecond_ns);  // up to frame 200 of the time before
  EXPECT_THAT(vehicle.outcomes, SizeIs(0));
}

/// The arrival times of 75 odometry messages tell whether there was an hour between the stamps of the 51st and the
/// next.
struct HourAhead {
  explicit HourAhead(bool is_silence) {
    for (int i = 0; i < 75; ++i) {
      arrival_ns = i * kPeriod_ns + (is_silence && i > 50 ? kHour_ns : 0);
      vehicle.drive_with_clock_set(i, i + 1, i > 50 ? kHour_ns : 0);
      if (i == 25) vehicle.tell_landmark(1, Vehicle::stamp(25), ahead(5.0));
    }
  }

  static constexpr std::int64_t kHour_ns = 3600 * kSecond_ns;
  std::int64_t arrival_ns = 0;
  Vehicle vehicle{{{"fusion.clock_sigma_s", "0"}}, false, [this] { return arrival_ns; }};
};

TEST(LocalizerTime, GoesOnWhenTheClockIsSetForward) {
  HourAhead set(false);
  Vehicle& vehicle = set.vehicle;
  EXPECT_EQ(vehicle.state(), states::TRACKING) << vehicle.states.back()->reason();
  EXPECT_NEAR(vehicle.x(), 14.8, 1e-6);
  EXPECT_EQ(conversions::stamp_ns(*vehicle.enhanced.back()), Vehicle::stamp(74) + HourAhead::kHour_ns);
  EXPECT_LE(std::sqrt(vehicle.enhanced.back()->pose().covariance()[0]), 25.0 + 0.1) << "5 s at 5 m/s";
  EXPECT_TRUE(vehicle.harness_.log_contains("was set forward by 3599.8 s")) << "the first one comes 0.16 s late";
  auto correction = vehicle.correction(1, 74, ahead(9.6));
  correction.header().stamp(conversions::to_stamp(Vehicle::stamp(74) + HourAhead::kHour_ns));
  vehicle.harness_.publish(topics::kCorrection, correction);
  ASSERT_THAT(vehicle.outcomes, SizeIs(1));
  EXPECT_EQ(vehicle.outcomes[0]->outcome(), outcomes::APPLIED) << vehicle.outcomes[0]->reason();
  EXPECT_NEAR(vehicle.x(), 14.6, 0.1);
  EXPECT_LT(std::sqrt(vehicle.enhanced.back()->pose().covariance()[0]), 0.1) << "both clocks were set";
}

TEST(LocalizerTime, StampsOfTheTimeThatPassesAreRightAfterTheClockIsSet) {
  // The clock is 3 s late, or right, and is set forward by 3 s.
  for (const bool was_late : {true, false}) {
    std::int64_t arrival_ns = Vehicle::stamp(0);
    Vehicle vehicle({{"fusion.clock_sigma_s", "0"}}, false, [&] { return arrival_ns; });
    for (int i = 0; i < 75; ++i) {
      arrival_ns = Vehicle::stamp(i);
      vehicle.drive_with_clock_set(i, i + 1, (was_late ? -3 : 0) * kSecond_ns + (i > 50 ? 3 : 0) * kSecond_ns);
    }
    EXPECT_TRUE(vehicle.harness_.log_contains("was set forward by 2.8 s")) << "the first one comes 0.16 s late";
    const double sigma_m = std::sqrt(vehicle.enhanced.back()->pose().covariance()[0]);
    EXPECT_NEAR(sigma_m, was_late ? 0.2 : 15.0, was_late ? 0.1 : 0.2) << "a step of 0.2 m; 3 s, at 5 m/s";
  }
}

TEST(LocalizerTime, UsesNoPlacesOfPanoramasWhoseClockWasNotSetByAnHour) {
  HourAhead set(false);
  set.vehicle.harness_.publish(topics::kCorrection, set.vehicle.correction(1, 74, ahead(9.3)));
  EXPECT_THAT(set.vehicle.outcomes, SizeIs(0));
  EXPECT_TRUE(set.vehicle.harness_.log_contains("not that of the panoramas"));
}

TEST(LocalizerTime, IsLostAfterASilenceOfAnHour) {
  const HourAhead silent(true);
  EXPECT_EQ(silent.vehicle.state(), states::LOST);
  EXPECT_GT(silent.vehicle.states.back()->position_sigma_m(), 10'000.0);
  Vehicle replayed;  // where the stamps are all that tells the time
  replayed.drive(0, 51);
  replayed.drive_with_clock_set(51, 75, HourAhead::kHour_ns);
  EXPECT_EQ(replayed.state(), states::LOST);
}

TEST(LocalizerTime, AfterACrashTheStartIsNotTheMapsOrigin) {
  Vehicle vehicle({}, true);
  vehicle.drive(0, 50);
  EXPECT_EQ(vehicle.state(), states::UNLOCATED);
  EXPECT_THAT(vehicle.states.back()->reason(), HasSubstr("restarted after a crash, no last pose is known"));
  EXPECT_GT(vehicle.states.back()->position_sigma_m(), 1000.0);
  EXPECT_FALSE(vehicle.integrities.back()->usable());
}

TEST(LocalizerTime, AfterACrashItTellsTheLastKnownPoseThatIsTooOldToGoOnFrom) {
  const panvo::test::TemporaryFolder folder;
  const std::map<std::string, std::string> parameters{{"last_pose_file", folder / "last_pose.txt"}};
  {
    Vehicle vehicle(parameters);
    vehicle.drive(0, 51);
  }
  Vehicle vehicle(parameters, true);
  vehicle.drive_with_clock_set(0, 50, 120 * kSecond_ns);
  EXPECT_EQ(vehicle.state(), states::UNLOCATED);
  EXPECT_THAT(vehicle.states.back()->reason(), HasSubstr("last known position (10.0, 0.0) m in map"));
  EXPECT_NEAR(vehicle.enhanced.front()->pose().pose().position().x(), 10.0, 1e-9);
  geometry_msgs::msg::PoseWithCovarianceStamped said;
  said.header().frame_id("map");
  said.pose().pose(conversions::to_pose(ahead(50.0)));
  said.pose().covariance()[0] = said.pose().covariance()[7] = 0.25;
  said.pose().covariance()[35] = 0.01;
  vehicle.harness_.publish(topics::kInitialPose, said);
  EXPECT_EQ(vehicle.state(), states::RELOCALISED) << "external pose";
  EXPECT_NEAR(vehicle.x(), 50.0, 0.01);
}

}  // namespace
}  // namespace panvo::localizer
