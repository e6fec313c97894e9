// SPDX-License-Identifier: Apache-2.0
// What one run measures of the sensors is kept for the next.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "self_calibration_file.hpp"

#include "localizer_on_topics.hpp"
#include "panvo/interfaces/time_topics.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "panvo/vision/angle.hpp"

namespace panvo::localizer {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class SelfCalibrationFile : public ::testing::Test {
 protected:
  void write(const std::string& text) const { std::ofstream(file_) << text; }
  std::string text() const {
    std::ostringstream text;
    text << std::ifstream(file_).rdbuf();
    return text.str();
  }
  std::string fault() const {
    try {
      read_self_calibration(file_);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return {};
  }

  const test::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "vehicle.calibration";
};

void expect_same(const std::optional<Estimate>& read, const std::optional<Estimate>& written) {
  ASSERT_EQ(read.has_value(), written.has_value());
  if (!read) return;
  EXPECT_DOUBLE_EQ(read->value, written->value);
  EXPECT_DOUBLE_EQ(read->sigma, written->sigma);
}

TEST_F(SelfCalibrationFile, GivesBackWhatWasMeasured) {
  SelfCalibration written;
  written.panorama_ahead_s = Estimate{0.3001234567890123, 0.004};
  written.direction_rad = Estimate{-0.1, 0.001};
  written.turn_scale = Estimate{0.0123, 0.001};
  written.scale = Estimate{1.0042, 0.0004};
  const auto check = [&] {
    write_self_calibration(file_, written);
    const auto read = read_self_calibration(file_);
    ASSERT_TRUE(read);
    expect_same(read->panorama_ahead_s, written.panorama_ahead_s);
    expect_same(read->direction_rad, written.direction_rad);
    expect_same(read->turn_scale, written.turn_scale);
    expect_same(read->scale, written.scale);
  };
  check();
  EXPECT_THAT(text(), HasSubstr("panorama_clock_ahead_s 0.3001234567890123 0.004\n"));
  EXPECT_THAT(to_text(written), AllOf(HasSubstr("clock is +300 ms ahead"), HasSubstr("-5.7 deg to the left"),
                                      HasSubstr("turns +1.23 %"), HasSubstr("distances +0.42 %")));
  written.scale.reset();
  written.panorama_ahead_s.reset();
  check();
  EXPECT_THAT(text(), Not(HasSubstr("scale 1.0042")));
}

TEST_F(SelfCalibrationFile, IsNoneWithoutAFile) { EXPECT_FALSE(read_self_calibration(file_)); }

TEST_F(SelfCalibrationFile, ThatIsNoneSaysWhatIsWrongAndWhatToDo) {
  const std::string good = "odometry_scale 1.01 0.001\n";
  for (const auto& [line, problem] : {
           std::pair{"odometry_lean 1 0.1", "'odometry_lean' is unknown"},
           std::pair{"", "'' is unknown"},
           std::pair{"panorama_clock_ahead_s 0.3", "'panorama_clock_ahead_s' has 1 finite numbers instead of 2"},
           std::pair{"panorama_clock_ahead_s 0.3 nan", "'panorama_clock_ahead_s' has 2 finite numbers instead of 2"},
           std::pair{"panorama_clock_ahead_s 0.3 late", "'panorama_clock_ahead_s' contains something"},
           std::pair{"panorama_clock_ahead_s 2.5 0.1", "panorama_clock_ahead_s is not between -2 and 2"},
           std::pair{"panorama_clock_ahead_s 0.3 -0.1", "panorama_clock_ahead_s.sigma is not between 0 and 1"},
           std::pair{"panorama_direction_left_deg 200 1", "panorama_direction_left_deg is not between -180 and 180"},
           std::pair{"odometry_turn_error 0.5 0.01", "odometry_turn_error is not between -0.1 and 0.1"},
           std::pair{"odometry_scale 100 0.01", "odometry_scale is not between 0.5 and 2"},
       }) {
    write(good + line + "\n");
    EXPECT_THAT(fault(), AllOf(HasSubstr(file_.string()), HasSubstr(problem), HasSubstr("delete the file"))) << line;
  }
  write(good);
  EXPECT_THAT(fault(), IsEmpty());
}

/// Of the road that a vehicle winds along, 5 m/s.
class LocalizerWithSelfCalibration : public LocalizerOnTopics {
 protected:
  static double yaw(int frame) { return 0.3 * std::sin(0.05 * frame); }

  void begin() { load({{"self_calibration_file", file_.string()}}); }

  /// Panoramas, ahead by so much, arrive 0.8 s late.
  void wind(int from, int to, std::int64_t ahead_ns) {
    const vision::Matrix6d gained = 1e-7 * vision::Matrix6d::Identity();
    for (int i = from; i < to; ++i) {
      const auto pose = at(0.2 * i, 0.0, yaw(i));
      covariance_ = vision::compose_covariance(before_, covariance_, before_.inverse() * pose, gained);
      publish_odometry(i, pose, covariance_);
      before_ = pose;
      if (i < 25 || i % 5 != 0) continue;
      publish_azimuth(stamp(i - 25) + ahead_ns, stamp(i - 20) + ahead_ns, yaw(i - 20) - yaw(i - 25));
    }
  }

  const test::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "vehicle.calibration";
  const std::vector<std::shared_ptr<const sensor_msgs::msg::TimeReference>>& references_ =
      harness_.collect(topics::kPanoramaTimeReference);

 private:
  Eigen::Isometry3d before_ = at(0.0, 0.0, 0.0);
  vision::Matrix6d covariance_ = vision::Matrix6d::Zero();
};

TEST_F(LocalizerWithSelfCalibration, WritesWhatItHasProvenAndKeepsWhatItHasNotMeasured) {
  write_self_calibration(file_, {{{0.5, 0.01}}, {{0.02, 0.001}}, {}, {{1.004, 0.001}}});
  begin();
  EXPECT_TRUE(harness_.log_contains("until measured again, the panoramic camera's clock is +500 ms ahead"));
  wind(0, 51, 200'000'000);
  EXPECT_EQ(read_self_calibration(file_)->panorama_ahead_s->value, 0.5) << "nothing is proven";
  EXPECT_THAT(references_, IsEmpty());
  wind(51, 600, 200'000'000);
  const auto saved = read_self_calibration(file_);
  ASSERT_TRUE(saved && saved->panorama_ahead_s && saved->scale && saved->direction_rad);
  EXPECT_NEAR(saved->panorama_ahead_s->value, 0.2, 0.01);
  EXPECT_NEAR(saved->scale->value, 1.004, 1e-12);
  EXPECT_NEAR(saved->direction_rad->value, 0.02, 1e-12);
  EXPECT_FALSE(references_.empty());
}

TEST_F(LocalizerWithSelfCalibration, BeginsWithTheClockOfTheLastRunButTellsItOnlyOnceItIsProven) {
  write_self_calibration(file_, {{{0.3, 0.004}}, {}, {}, {}});
  begin();
  constexpr std::int64_t kAhead_ns = 300'000'000;
  publish_landmark(1, kBegin_ns - 1, at(5.0, 0.0, 0.0));
  drive(0, 28);
  for (int i = 28; i < 33; ++i) {  // two views of a landmark of another day, from where they were taken
    drive(i, i + 1);
    if (i == 30 || i == 32) publish_correction(1, stamp(i - 2) + kAhead_ns, at(0.2 * (i - 2) - 5.0, 0.0, 0.0));
  }
  EXPECT_NEAR(enhanced_.back()->pose().pose().position().x(), 0.2 * 32, 0.05) << "0.3 s are 1.5 m";
  EXPECT_EQ(states_.back()->state(), panvo_msgs::msg::LocalizationState_Constants::RELOCALISED);
  EXPECT_THAT(references_, IsEmpty());
}

TEST_F(LocalizerWithSelfCalibration, GoesOnWithoutAFileThatIsNone) {
  std::ofstream(file_) << "panorama_clock_ahead_s 300 4\n";
  begin();
  EXPECT_TRUE(harness_.log_contains("contains no valid calibration: panorama_clock_ahead_s is not between -2 and 2"));
  wind(0, 600, 0);
  EXPECT_NEAR(read_self_calibration(file_)->panorama_ahead_s->value, 0.0, 0.01) << "a new one";
}

TEST_F(LocalizerWithSelfCalibration, ReplacesNoFileOfAnotherKind) {
  const std::string text = "image_width: 640\nimage_height: 480\n";
  std::ofstream(file_) << text;
  begin();
  EXPECT_TRUE(harness_.log_contains("contains no valid calibration: 'image_width:' is unknown; it is of another kind"));
  wind(0, 600, 0);
  EXPECT_FALSE(references_.empty()) << "there is something to keep";
  std::ostringstream left;
  left << std::ifstream(file_).rdbuf();
  EXPECT_EQ(left.str(), text);
}

TEST_F(LocalizerWithSelfCalibration, WritesTheRestAtTheEndOfTheRun) {
  begin();
  for (int frame = 0; references_.empty() && frame < 500; frame += 5) wind(frame, frame + 5, 0);
  ASSERT_FALSE(references_.empty());
  EXPECT_FALSE(std::filesystem::exists(file_)) << "it is written every ten seconds";
  EXPECT_THAT(harness_.container().run(), IsEmpty());
  ASSERT_TRUE(read_self_calibration(file_));
  EXPECT_NEAR(read_self_calibration(file_)->panorama_ahead_s->value, 0.0, 0.01);
}

TEST_F(LocalizerWithSelfCalibration, WritesTheRestWhenItIsUnloaded) {
  begin();
  for (int frame = 0; references_.empty() && frame < 500; frame += 5) wind(frame, frame + 5, 0);
  ASSERT_FALSE(references_.empty());
  EXPECT_FALSE(std::filesystem::exists(file_)) << "it is written every ten seconds";
  EXPECT_TRUE(harness_.container().unload("localizer"));
  ASSERT_TRUE(read_self_calibration(file_));
  EXPECT_NEAR(read_self_calibration(file_)->panorama_ahead_s->value, 0.0, 0.01);
}

}  // namespace
}  // namespace panvo::localizer
