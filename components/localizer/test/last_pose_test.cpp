// SPDX-License-Identifier: Apache-2.0
// A restarted process resumes from the pose of the previous one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/testing.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::localizer {
namespace {

namespace states = panvo_msgs::msg::LocalizationState_Constants;

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::int64_t kBegin_ns = 1'700'000'000'000'000'000;
constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// A localizer in a container of its own, like a process.
class Life {
 public:
  explicit Life(const std::map<std::string, std::string>& parameters) {
    harness_.load("panvo_localizer", "LocalizerComponent", parameters);
  }

  /// Drives straight at 5 m/s from its odometry origin.
  void drive(std::int64_t begin_ns, int frames) {
    for (int i = 0; i < frames; ++i) {
      nav_msgs::msg::Odometry odometry;
      odometry.header().stamp(conversions::to_stamp(begin_ns + i * kSecond_ns / 25));
      odometry.header().frame_id("odom");
      odometry.child_frame_id("base_link");
      odometry.pose().pose().position().x(0.2 * i);
      odometry.pose().covariance(conversions::to_array((1e-4 + 1e-4 * i) * vision::Matrix6d::Identity()));
      odometry.twist().twist().linear().x(5.0);
      harness_.publish(topics::kOdometryBinocular, odometry);
    }
  }
  void know(std::uint32_t id, double x) {
    panvo_msgs::msg::PanoramicLandmark landmark;
    landmark.header().stamp(conversions::to_stamp(kBegin_ns - 1));
    landmark.id(id);
    landmark.histogram({1.0F});
    landmark.pose().pose().position().x(x);
    landmark.pose().covariance(conversions::to_array(1e-4 * vision::Matrix6d::Identity()));
    harness_.publish(topics::kLandmarks, landmark);
  }

  double x() const { return enhanced_.back()->pose().pose().position().x(); }
  double first_variance() const { return enhanced_.front()->pose().covariance()[0]; }
  std::uint8_t state() const { return states_.back()->state(); }
  auto log() { return harness_.log(); }

 private:
  runtime::ComponentHarness harness_;
  const std::vector<std::shared_ptr<const nav_msgs::msg::Odometry>>& enhanced_ =
      harness_.collect(topics::kOdometryEnhanced);
  const std::vector<std::shared_ptr<const panvo_msgs::msg::LocalizationState>>& states_ =
      harness_.collect(topics::kLocalizationState);
};

class LastPoseFile : public ::testing::Test {
 protected:
  /// 51 frames, so that the pose at 10 m is the last one saved.
  void live_once() const {
    Life first(kept_);
    first.drive(kBegin_ns, 51);
    ASSERT_NEAR(first.x(), 10.0, 1e-9);
  }

  const panvo::test::TemporaryFolder folder_;
  const std::string file_ = folder_ / "last_pose.txt";
  const std::map<std::string, std::string> kept_{{"last_pose_file", file_}};
};

TEST_F(LastPoseFile, IsWhereTheNextProcessGoesOn) {
  live_once();
  Life second(kept_);
  second.drive(kBegin_ns + 4 * kSecond_ns, 6);
  EXPECT_NEAR(second.x(), 11.0, 1e-6);
  EXPECT_EQ(second.state(), states::RELOCALISED);
  EXPECT_NEAR(second.first_variance(), 100.0, 1.0) << "2 s at 5 m/s give 10 m";
  EXPECT_THAT(second.log(), Contains(HasSubstr("resuming from (10.0, 0.0) m, age 2.0 s")));
}

TEST_F(LastPoseFile, HoldsAmongLandmarksOfTheProcessBefore) {
  live_once();
  Life second(kept_);
  second.know(3, 7.0);
  second.drive(kBegin_ns + 4 * kSecond_ns, 6);
  EXPECT_NEAR(second.x(), 11.0, 1e-6);
  EXPECT_EQ(second.state(), states::RELOCALISED);
}

TEST_F(LastPoseFile, IsTooOldAfterAWhile) {
  live_once();
  Life second(kept_);
  second.drive(kBegin_ns + 60 * kSecond_ns, 6);
  EXPECT_NEAR(second.x(), 1.0, 1e-6);
  EXPECT_THAT(second.log(), Contains(HasSubstr("age 58.0 s (last_pose_s: 30.0)")));
}

TEST_F(LastPoseFile, OfALaterTimeIsOfAnotherJourney) {
  live_once();
  Life replay(kept_);
  replay.drive(kBegin_ns - 60 * kSecond_ns, 6);
  EXPECT_NEAR(replay.x(), 1.0, 1e-6);
}

TEST_F(LastPoseFile, ThatIsDamagedIsNamedWithTheRemedy) {
  live_once();
  std::filesystem::resize_file(file_, 100);
  Life second(kept_);
  second.drive(kBegin_ns + 4 * kSecond_ns, 6);
  EXPECT_NEAR(second.x(), 1.0, 1e-6);
  EXPECT_THAT(second.log(), Contains(testing::AllOf(HasSubstr(file_), HasSubstr("delete the file"))));
}

TEST_F(LastPoseFile, IsReplacedIfDamagedAndNotIfOfAnotherKind) {
  const std::string camera = "image_width: 640\nimage_height: 480\n";
  for (const auto& [text, is_replaced] : {std::pair{camera, false}, {std::string("stamp_ns 17"), true}, {"", true}}) {
    std::ofstream(file_) << text;
    live_once();
    std::ostringstream left;
    left << std::ifstream(file_).rdbuf();
    EXPECT_EQ(left.str() != text, is_replaced) << text;
  }
}

TEST_F(LastPoseFile, OfNumbersThatAreNoPoseIsNotBelieved) {
  live_once();
  std::ofstream(file_) << "map_frame map\nstamp_ns 1700000002000000000\nspeed_m_per_s 5\nposition 10 0 0\n"
                          "orientation 0 0 0 0\ncovariance 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 "
                          "0 0 0 0 0 0 0\n";
  Life second(kept_);
  second.drive(kBegin_ns + 4 * kSecond_ns, 6);
  EXPECT_NEAR(second.x(), 1.0, 1e-6);
  EXPECT_THAT(second.log(), Contains(HasSubstr("orientation is not a unit quaternion")));
}

TEST_F(LastPoseFile, OfAStampACovarianceOrAPlaceThatIsNoneIsNotBelieved) {
  const auto file_of = [this](const std::string& stamp, const std::string& x, const std::string& correlation) {
    std::ofstream(file_) << "map_frame map\nstamp_ns " << stamp << "\nspeed_m_per_s 5\nposition " << x
                         << " 0 0\norientation 0 0 0 1\ncovariance 1 " << correlation << " 0 0 0 0 " << correlation
                         << " 1 0 0 0 0 0 0 1 0 0 0 0 0 0 1 0 0 0 0 0 0 1 0 0 0 0 0 0 1\n";
  };
  live_once();
  const char* const sound = "1700000002000000000";
  for (const auto& [stamp, x, correlation, problem] :
       {std::tuple{sound, "10", "2", "covariance is not positive semidefinite"},
        std::tuple{sound, "1e200", "0", "position is beyond +-1e+08"},
        std::tuple{"-9223372036854775808", "10", "0", "stamp_ns is out of the range of stamps"}}) {
    file_of(stamp, x, correlation);
    Life second(kept_);
    second.drive(kBegin_ns + 4 * kSecond_ns, 6);
    EXPECT_NEAR(second.x(), 1.0, 1e-6);
    EXPECT_THAT(second.log(), Contains(HasSubstr(problem)));
  }
}

TEST_F(LastPoseFile, OfAnotherKindIsLeftAsItIs) {
  const std::string text = "image_width: 640\nimage_height: 480\n";
  std::ofstream(file_) << text;
  Life only(kept_);
  only.drive(kBegin_ns, 51);
  EXPECT_NEAR(only.x(), 10.0, 1e-9);
  EXPECT_THAT(only.log(), Contains(HasSubstr(file_ + " contains no valid pose: 'image_width:' is unknown")));
  EXPECT_THAT(only.log(), Contains(HasSubstr(file_ + " is not replaced by a pose")));
  std::ostringstream left;
  left << std::ifstream(file_).rdbuf();
  EXPECT_EQ(left.str(), text);
}

TEST_F(LastPoseFile, ThatCannotBeWrittenDoesNotStopIt) {
  Life only({{"last_pose_file", folder_ / "nowhere" / "last_pose.txt"}});
  only.drive(kBegin_ns, 51);
  EXPECT_NEAR(only.x(), 10.0, 1e-9);
  EXPECT_THAT(only.log(), Contains(HasSubstr("in an existing, writable folder")));
}

TEST_F(LastPoseFile, IsNotWrittenUnlessAskedFor) {
  Life only({});
  only.drive(kBegin_ns, 51);
  EXPECT_FALSE(std::filesystem::exists(file_));
  EXPECT_THAT(only.log(), Not(Contains(HasSubstr("resuming"))));
}

}  // namespace
}  // namespace panvo::localizer
