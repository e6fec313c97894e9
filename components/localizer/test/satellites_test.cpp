// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>

#include "georeference_file.hpp"

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/interfaces/gnss_topics.hpp"
#include "panvo/runtime/testing.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "panvo/vision/geodesy.hpp"

namespace panvo::localizer {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

constexpr std::int64_t kBegin_ns = 1'700'000'000'000'000'000;

/// The localizer with a vehicle that drives 0.5 m per odometry pose along a bend, and a receiver that sees all of it
/// exactly, from a map whose x axis points north.
class Satellites : public ::testing::Test {
 protected:
  void SetUp() override {
    harness_.load("panvo_localizer", "LocalizerComponent", {{"georeference_file", file_.string()}});
  }

  static Eigen::Isometry3d pose(int step) {
    const double angle = 0.5 * step / 80.0;
    Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
    map_from_base.translation() << 80.0 * std::sin(angle), 80.0 * (1.0 - std::cos(angle)), 0.0;
    map_from_base.linear() = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    return map_from_base;
  }
  static Eigen::Vector3d in_enu(const Eigen::Vector3d& map_m) { return {-map_m.y(), map_m.x(), map_m.z()}; }

  /// `back`: steps by which the clock was set back.
  void publish_odometry(int step, int back = 0) {
    nav_msgs::msg::Odometry odometry;
    odometry.header().stamp(conversions::to_stamp(stamp(step - back)));
    odometry.header().frame_id("odom");
    odometry.child_frame_id("base_link");
    odometry.pose().pose(conversions::to_pose(pose(step)));
    odometry.pose().covariance(conversions::to_array((1e-5 + 1e-5 * step) * vision::Matrix6d::Identity()));
    harness_.publish(topics::kOdometryBinocular, odometry);
  }

  sensor_msgs::msg::NavSatFix fix(int step) const {
    const auto point = plane_.geodetic(in_enu(pose(step) * antenna_m_));
    sensor_msgs::msg::NavSatFix fix;
    fix.header().stamp(conversions::to_stamp(stamp(step)));
    fix.header().frame_id("gnss");
    fix.status().status(sensor_msgs::msg::NavSatStatus_Constants::STATUS_FIX);
    fix.latitude(point.latitude_deg);
    fix.longitude(point.longitude_deg);
    fix.altitude(point.altitude_m);
    fix.position_covariance({0.01, 0.0, 0.0, 0.0, 0.01, 0.0, 0.0, 0.0, 0.01});
    fix.position_covariance_type(sensor_msgs::msg::NavSatFix_Constants::COVARIANCE_TYPE_KNOWN);
    return fix;
  }

  void publish_antenna() {
    geometry_msgs::msg::TransformStamped transform;
    transform.header().frame_id("base_link");
    transform.child_frame_id("gnss");
    Eigen::Isometry3d base_from_gnss = Eigen::Isometry3d::Identity();
    base_from_gnss.translation() = antenna_m_;
    transform.transform(conversions::to_transform(base_from_gnss));
    tf2_msgs::msg::TFMessage message;
    message.transforms().push_back(transform);
    harness_.publish(topics::kTfStatic, message);
  }

  void drive(int from, int to) {
    for (int i = from; i < to; ++i) {
      publish_odometry(i);
      if (i % 5 == 0) harness_.publish(topics::kGnssFix, fix(i));
    }
  }

  static std::int64_t stamp(int step) { return kBegin_ns + step * 100'000'000LL; }

  const vision::TangentPlane plane_{{48.1, 11.6, 520.0}};
  const Eigen::Vector3d antenna_m_{-0.5, 0.0, 1.8};
  const test::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "campus.georeference";
  runtime::ComponentHarness harness_;
  const std::vector<std::shared_ptr<const sensor_msgs::msg::NavSatFix>>& enhanced_ =
      harness_.collect(topics::kGnssEnhanced);
  const std::vector<std::shared_ptr<const tf2_msgs::msg::TFMessage>>& tf_ = harness_.collect(topics::kTf);
};

TEST_F(Satellites, GiveLatitudeAndLongitudeOfTheVehicleAndTheTransformToTheMap) {
  publish_antenna();
  drive(0, 200);
  EXPECT_TRUE(harness_.log_contains("/gnss/fix: agrees with the odometry; used from now on"));
  ASSERT_FALSE(enhanced_.empty());
  const auto& last = *enhanced_.back();
  EXPECT_EQ(conversions::stamp_ns(last), stamp(199));
  EXPECT_EQ(last.header().frame_id(), "base_link");
  const Eigen::Vector3d here_m = plane_.enu({last.latitude(), last.longitude(), last.altitude()});
  EXPECT_LT((here_m - in_enu(pose(199).translation())).norm(), 0.1);
  EXPECT_GT(last.position_covariance()[0], 0.0);
  EXPECT_LT(last.position_covariance()[0], 1.0);
  const auto is_of_enu = [](const auto& message) { return message->transforms()[0].child_frame_id() == "enu"; };
  const auto found = std::find_if(tf_.rbegin(), tf_.rend(), is_of_enu);
  ASSERT_NE(found, tf_.rend());
  EXPECT_EQ((*found)->transforms()[0].header().frame_id(), "map");
  const auto map_from_enu = conversions::to_isometry((*found)->transforms()[0].transform());
  ASSERT_TRUE(map_from_enu);
  // The frame begins at the first antenna position.
  const Eigen::Vector3d first_m = in_enu(pose(0) * antenna_m_);
  EXPECT_LT((*map_from_enu * (Eigen::Vector3d(-10, 20, 0) - first_m) - Eigen::Vector3d(20, 10, 0)).norm(), 0.2);
}

TEST_F(Satellites, AreNotUsedIfTheyWaitedFromBeforeTheClockWasSetBack) {
  publish_antenna();
  drive(0, 200);
  harness_.publish(topics::kGnssFix, fix(205));
  for (int i = 200; i < 260; ++i) publish_odometry(i, 40);  // up to step 219 of the time before
  const auto& last = *enhanced_.back();
  EXPECT_EQ(conversions::stamp_ns(last), stamp(219));
  const Eigen::Vector3d here_m = plane_.enu({last.latitude(), last.longitude(), last.altitude()});
  EXPECT_LT((here_m - in_enu(pose(259).translation())).norm(), 0.5);
}

TEST_F(Satellites, KeepWhereTheMapIsOnEarth) {
  publish_antenna();
  drive(0, 300);
  const auto kept = read_georeference(file_);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->map_frame, "map");
  const Eigen::Vector3d first_m = in_enu(pose(0) * antenna_m_);
  EXPECT_LT((plane_.enu(kept->origin) - first_m).norm(), 1e-6);
  const Eigen::Vector3d there_m = kept->map_from_enu.map_from_base * (in_enu({20.0, 10.0, 0.0}) - first_m);
  EXPECT_LT((there_m - Eigen::Vector3d(20.0, 10.0, 0.0)).norm(), 0.3);
}

TEST_F(Satellites, NameWhatIsWrongInTheFileOfTheGeoreference) {
  EXPECT_FALSE(read_georeference(file_));
  vision::Matrix6d covariance = vision::Matrix6d::Identity();
  write_georeference(file_, {"map", {48.0, 11.0, 500.0}, {Eigen::Isometry3d::Identity(), covariance}});
  EXPECT_EQ(read_georeference(file_)->map_from_enu.covariance, covariance);
  covariance(0, 0) = -1.0;
  write_georeference(file_, {"map", {48.0, 11.0, 500.0}, {Eigen::Isometry3d::Identity(), covariance}});
  EXPECT_THROW(
      {
        try {
          read_georeference(file_);
        } catch (const std::runtime_error& error) {
          EXPECT_THAT(error.what(), ::testing::AllOf(HasSubstr("campus.georeference"), HasSubstr("covariance")));
          throw;
        }
      },
      std::runtime_error);
}

TEST_F(Satellites, AreAssumedAtTheVehicleWithoutTransform) {
  drive(0, 20);
  EXPECT_TRUE(harness_.log_contains("/gnss/fix: no transform from base_link to gnss in /tf_static"));
}

TEST_F(Satellites, AreSkippedIfInvalidOrOfAnotherReceiver) {
  publish_antenna();
  publish_odometry(0);
  auto exchanged = fix(0);
  exchanged.latitude(111.6);
  harness_.publish(topics::kGnssFix, exchanged);
  harness_.publish(topics::kGnssFix, fix(0));
  auto other = fix(0);
  other.header().frame_id("second");
  harness_.publish(topics::kGnssFix, other);
  auto far = fix(0);
  far.latitude(47.0);
  harness_.publish(topics::kGnssFix, far);
  EXPECT_TRUE(harness_.log_contains("latitude"));
  EXPECT_TRUE(harness_.log_contains("comes from several sensors, 'gnss' and 'second'"));
  EXPECT_TRUE(harness_.log_contains("is 122 km from the first position"));
  drive(1, 20);
  EXPECT_THAT(enhanced_, IsEmpty());
}

TEST_F(Satellites, AreUsedThoughTheFirstPositionWasThatOfAnotherCity) {
  publish_antenna();
  publish_odometry(0);
  auto stored = fix(0);
  stored.latitude(52.5);
  harness_.publish(topics::kGnssFix, stored);
  drive(1, 200);
  EXPECT_TRUE(harness_.log_contains("from the first position"));
  EXPECT_TRUE(harness_.log_contains("/gnss/fix: agrees with the odometry; used from now on"));
  ASSERT_THAT(enhanced_, Not(IsEmpty()));
  const auto& last = *enhanced_.back();
  const Eigen::Vector3d here_m = plane_.enu({last.latitude(), last.longitude(), last.altitude()});
  EXPECT_LT((here_m - in_enu(pose(199).translation())).norm(), 0.1);
}

TEST_F(Satellites, AreNotHeldUpByOneOfATimeToCome) {
  publish_antenna();
  drive(0, 1);
  auto early = fix(0);
  early.header().stamp(conversions::to_stamp(stamp(0) + 86'400'000'000'000LL));
  harness_.publish(topics::kGnssFix, early);
  drive(1, 200);
  EXPECT_TRUE(harness_.log_contains("/gnss/fix: agrees with the odometry; used from now on"));
}

/// The map's origin on earth is that of an earlier journey, 50 km away.
class SatellitesFarFromTheirOrigin : public Satellites {
 protected:
  void SetUp() override {
    const auto origin = plane_.geodetic({0.0, 50e3, 0.0});
    write_georeference(file_, {"map",
                               {origin.latitude_deg, origin.longitude_deg, 520.0},
                               {Eigen::Isometry3d::Identity(), vision::Matrix6d::Identity()}});
    Satellites::SetUp();
  }
};

TEST_F(SatellitesFarFromTheirOrigin, MayLackTheirAltitudeNowAndThen) {
  publish_antenna();
  for (int i = 0; i < 200; ++i) {
    publish_odometry(i);
    auto seen = fix(i);
    if (i % 2 == 1) seen.altitude(std::numeric_limits<double>::quiet_NaN());
    harness_.publish(topics::kGnssFix, seen);
  }
  ASSERT_THAT(enhanced_, Not(IsEmpty()));
  for (const auto& one : enhanced_) {
    const auto step = static_cast<int>((conversions::stamp_ns(*one) - stamp(0)) / (stamp(1) - stamp(0)));
    const Eigen::Vector3d here_m = plane_.enu({one->latitude(), one->longitude(), one->altitude()});
    EXPECT_LT((here_m - in_enu(pose(step).translation())).head<2>().norm(), 0.1) << step;
  }
}

TEST_F(Satellites, AreNotUsedIfTheirPathDiffers) {
  publish_antenna();
  for (int i = 0; i < 200; ++i) {
    publish_odometry(i);
    harness_.publish(topics::kGnssFix, [&] {
      auto frozen = fix(0);
      frozen.header().stamp(conversions::to_stamp(stamp(i)));
      return frozen;
    }());
  }
  EXPECT_TRUE(harness_.log_contains("/gnss/fix is not used: their path differs from the odometry's"));
  EXPECT_THAT(enhanced_, IsEmpty());
}

}  // namespace
}  // namespace panvo::localizer
