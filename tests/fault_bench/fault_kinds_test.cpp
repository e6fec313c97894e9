// SPDX-License-Identifier: Apache-2.0
// Effect of each kind of fault on small images and messages.
#include "fault.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>

namespace panvo::test {
namespace {

using nav_msgs::msg::Odometry;
using sensor_msgs::msg::CameraInfo;

constexpr double kSpan_s = 40.0;
constexpr std::uint64_t kSeed = 3;
constexpr std::int64_t kPeriod_ns = 40'000'000;

/// A random image, different for each number and camera.
cv::Mat picture(int number, int eye = 0) {
  cv::RNG rng(static_cast<std::uint64_t>(100 * number + eye + 1));
  cv::Mat image(48, 64, CV_8UC3);
  rng.fill(image, cv::RNG::UNIFORM, 60, 200);
  return image;
}

StereoPair pair_of(int number) {
  const std::int64_t stamp_ns = number * kPeriod_ns;
  return {stamp_ns, stamp_ns, picture(number, 0), picture(number, 1)};
}

bool is_same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

double mean(const cv::Mat& image) {
  const cv::Scalar channels = cv::mean(image);
  return (channels[0] + channels[1] + channels[2]) / 3.0;
}

/// Applies a fault to pairs 0, 1, ..., of which 10 to 19 are within its window.
struct Played {
  explicit Played(const std::string& kind, std::uint64_t seed = kSeed)
      : window(fault_window(fault_kind(kind), seed, kSpan_s)), fault(make_fault(fault_kind(kind), seed, kSpan_s)) {}

  static bool is_on(int number) { return number >= 10 && number < 20; }
  Moment moment(int number) const {
    if (number < 10) return {window.from_s + 0.04 * (number - 10), false};
    if (number < 20) return {window.from_s + (window.to_s - window.from_s) * 0.1 * (number - 10), true};
    return {window.to_s + 0.04 * (number - 20), false};
  }

  std::vector<StereoPair> pair(int number) { return fault.pairs(pair_of(number), moment(number)); }
  std::vector<StereoPair> pairs(int from, int to) {
    std::vector<StereoPair> all;
    for (int i = from; i < to; ++i) {
      for (const auto& passed : pair(i)) all.push_back(passed);
    }
    return all;
  }
  cv::Mat panorama(int number) {
    return fault.panoramas({number * kPeriod_ns, picture(number)}, moment(number)).at(0).pixels;
  }

  FaultWindow window;
  Fault fault;
};

std::vector<std::int64_t> stamps(const std::vector<StereoPair>& pairs) {
  std::vector<std::int64_t> all;
  for (const auto& pair : pairs) all.push_back(pair.left_ns / kPeriod_ns);
  return all;
}

TEST(FaultKinds, AreAtLeastThirtyEachWithANameOfItsOwnAndAWindowWithinTheRecording) {
  EXPECT_GE(fault_kinds().size(), 31U);
  EXPECT_EQ(fault_kinds().front().name, "none");
  std::set<std::string_view> names;
  for (const auto& kind : fault_kinds()) {
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    EXPECT_FALSE(kind.description.empty()) << kind.name;
    const auto window = fault_window(kind, kSeed, kSpan_s);
    EXPECT_GE(window.from_s, 0.0) << kind.name;
    EXPECT_LE(window.to_s, kSpan_s) << kind.name;
    EXPECT_LT(window.from_s, window.to_s) << kind.name;
    if (kind.lasting == Lasting::kWhile) {
      EXPECT_LT(window.to_s, 0.75 * kSpan_s) << kind.name << " leaves no time to recover";
    }
  }
}

TEST(FaultKinds, AreDrawnFromTheSeedAlone) {
  for (const char* kind : {"mover", "rain", "fog", "flicker", "dark_noise", "lens_dirt", "half_dropped"}) {
    Played first(kind), again(kind), other(kind, kSeed + 1);
    EXPECT_EQ(first.window.from_s, again.window.from_s);
    EXPECT_NE(first.window.from_s, other.window.from_s);
    const auto a = first.pairs(0, 20), b = again.pairs(0, 20);
    ASSERT_EQ(a.size(), b.size()) << kind;
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_TRUE(is_same(a[i].left, b[i].left) && is_same(a[i].right, b[i].right)) << kind;
    }
  }
}

TEST(FaultKinds, ThatLastAWhileLeaveWhatComesBeforeAlone) {
  for (const auto& kind : fault_kinds()) {
    Played played{std::string(kind.name)};
    if (!played.fault.pairs || kind.lasting == Lasting::kWhole) continue;
    for (int i = 0; i < 10; ++i) {
      const auto passed = played.pair(i);
      ASSERT_EQ(passed.size(), 1U) << kind.name;
      EXPECT_EQ(passed[0].left_ns, i * kPeriod_ns) << kind.name;
      EXPECT_TRUE(is_same(passed[0].left, picture(i, 0)) && is_same(passed[0].right, picture(i, 1))) << kind.name;
    }
  }
}

TEST(FaultKinds, NeverWriteIntoTheImagesTheyAreGiven) {
  for (const auto& kind : fault_kinds()) {
    Played played{std::string(kind.name)};
    const StereoPair pair = pair_of(15);
    const Panorama panorama{pair.left_ns, picture(15)};
    if (played.fault.pairs) played.fault.pairs(pair, played.moment(15));
    if (played.fault.panoramas) played.fault.panoramas(panorama, played.moment(15));
    EXPECT_TRUE(is_same(pair.left, picture(15, 0)) && is_same(pair.right, picture(15, 1))) << kind.name;
    EXPECT_TRUE(is_same(panorama.pixels, picture(15))) << kind.name;
  }
}

TEST(FaultKinds, ThatIsNotThereIsNamedWithThoseThatAre) {
  try {
    fault_kind("melted");
    FAIL() << "an unknown kind was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("melted"), testing::HasSubstr("both_frozen")));
  }
}

TEST(FrozenEyes, ShowWhatTheyLastSawUnderStampsThatGoOn) {
  Played both("both_frozen"), left("left_frozen");
  both.pairs(0, 10);
  left.pairs(0, 10);
  const auto passed = both.pair(15).at(0), one = left.pair(15).at(0);
  EXPECT_TRUE(is_same(passed.left, picture(9, 0)) && is_same(passed.right, picture(9, 1)));
  EXPECT_EQ(passed.left_ns, 15 * kPeriod_ns);
  EXPECT_TRUE(is_same(one.left, picture(9, 0)) && is_same(one.right, picture(15, 1)));
  EXPECT_TRUE(is_same(both.pair(20).at(0).left, picture(20, 0)));
}

TEST(SpoiltImages, AreBlackWhiteDarkOrSpeckled) {
  EXPECT_EQ(mean(Played("both_black").pair(15).at(0).left), 0.0);
  EXPECT_EQ(mean(Played("saturated").pair(15).at(0).right), 255.0);
  const auto one = Played("one_black").pair(15).at(0);
  EXPECT_EQ(std::min(mean(one.left), mean(one.right)), 0.0);
  EXPECT_GT(std::max(mean(one.left), mean(one.right)), 100.0);
  EXPECT_LT(mean(Played("dark_noise").pair(15).at(0).left), 25.0);
  const cv::Mat speckled = Played("salt_and_pepper").pair(15).at(0).left;
  const double share = cv::countNonZero(speckled.reshape(1) != picture(15).reshape(1)) / (3.0 * speckled.total());
  EXPECT_GT(share, 0.03);
  EXPECT_LT(share, 0.17);
}

TEST(SwappedOrLateEyes, AreThoseOfTheOtherSideAndOfTheFrameBefore) {
  const auto swapped = Played("eyes_swapped").pair(15).at(0);
  EXPECT_TRUE(is_same(swapped.left, picture(15, 1)) && is_same(swapped.right, picture(15, 0)));
  Played delayed("eye_delayed");
  delayed.pairs(9, 15);
  const auto late = delayed.pair(15).at(0);
  const bool is_left = is_same(late.left, picture(14, 0)), is_right = is_same(late.right, picture(14, 1));
  EXPECT_NE(is_left, is_right);
  EXPECT_TRUE(is_same(is_left ? late.right : late.left, picture(15, is_left ? 1 : 0)));
}

TEST(TheMover, IsSeenByBothEyesAtOneDistance) {
  Played played("mover");
  const auto passed = played.fault.pairs(pair_of(15), {0.5 * (played.window.from_s + played.window.to_s), true}).at(0);
  EXPECT_FALSE(is_same(passed.left, picture(15, 0)));
  // The right view is the left view shifted left by the disparity: the difference is small for the best disparity,
  // large for none.
  const cv::Rect middle(20, 8, 40, 32);
  double best = 1e9, at_none = 0.0;
  for (int disparity = 0; disparity <= 6; ++disparity) {
    const cv::Rect moved = middle - cv::Point(disparity, 0);
    const double difference = cv::norm(passed.left(middle), passed.right(moved), cv::NORM_L1) / (3.0 * middle.area());
    best = std::min(best, difference);
    if (disparity == 0) at_none = difference;
  }
  EXPECT_LT(best, 12.0);
  EXPECT_GT(at_none, 1.5 * best);
}

TEST(Optics, TakeContrast) {
  const auto contrast = [](const cv::Mat& image) {
    cv::Scalar average, deviation;
    cv::meanStdDev(image, average, deviation);
    return deviation[0];
  };
  for (const char* kind : {"fog", "blurred"}) {
    EXPECT_LT(contrast(Played(kind).pair(15).at(0).left), 0.6 * contrast(picture(15))) << kind;
  }
  for (const char* kind : {"rain", "lens_dirt"}) {
    EXPECT_FALSE(is_same(Played(kind).pair(15).at(0).left, picture(15))) << kind;
  }
}

TEST(Optics, DirtStaysWhereItIs) {
  Played played("lens_dirt");
  const StereoPair pair = pair_of(15);
  const auto first = played.fault.pairs(pair, played.moment(12)).at(0),
             later = played.fault.pairs(pair, played.moment(18)).at(0);
  EXPECT_TRUE(is_same(first.left, later.left));
}

TEST(Timing, DropsPairsOrMovesTheirStamps) {
  EXPECT_EQ(Played("long_gap").pairs(0, 22).size(), 12U);
  const auto kept = Played("half_dropped").pairs(10, 20).size();
  EXPECT_GT(kept, 0U);
  EXPECT_LT(kept, 10U);
  EXPECT_EQ(Played("stamps_ahead").pair(15).at(0).left_ns, 15 * kPeriod_ns + 10'000'000'000);
  EXPECT_LE(Played("stamps_back").pair(15).at(0).right_ns, 15 * kPeriod_ns - 1'000'000'000);
  EXPECT_THAT(stamps(Played("out_of_order").pairs(8, 14)), testing::ElementsAre(8, 9, 11, 10, 13, 12));
  Played jitter("stamp_jitter");
  for (int i = 10; i < 20; ++i) {
    const auto passed = jitter.pair(i).at(0);
    EXPECT_LE(std::abs(passed.left_ns - i * kPeriod_ns), 16'000'000);
    EXPECT_EQ(passed.left_ns, passed.right_ns);
  }
}

TEST(Timing, RepeatsEveryOtherPair) {
  Played played("duplicates");
  const auto passed = played.pairs(9, 14);
  EXPECT_TRUE(is_same(passed[1].left, picture(9)));
  EXPECT_TRUE(is_same(passed[2].left, picture(11)));
  EXPECT_TRUE(is_same(passed[3].left, picture(11)));
  EXPECT_THAT(stamps(passed), testing::ElementsAre(9, 10, 11, 12, 13));
}

TEST(Timing, HasOneAbsurdStampOnly) {
  Played played("one_stamp_ahead");
  EXPECT_GE(played.pair(10).at(0).left_ns, 10'000'000'000);
  EXPECT_EQ(played.pair(11).at(0).left_ns, 11 * kPeriod_ns);
}

TEST(Kidnapping, CutsTheRecordingAndTheTruthAndClosesTheGapInTime) {
  Played played("kidnapped");
  const auto cut_ns = static_cast<std::int64_t>(std::llround((played.window.to_s - played.window.from_s) * 1e9));
  EXPECT_TRUE(played.pairs(10, 20).empty());
  EXPECT_EQ(played.pair(20).at(0).left_ns, 20 * kPeriod_ns - cut_ns);
  Odometry truth;
  truth.header().stamp().sec(1000);
  const auto moved = played.fault.truth(truth, played.moment(20)).at(0).header().stamp();
  EXPECT_EQ(std::int64_t{moved.sec()} * 1'000'000'000 + moved.nanosec(), 1'000'000'000'000 - cut_ns);
  EXPECT_TRUE(played.fault.truth(truth, played.moment(15)).empty());
}

TEST(SpoiltPanoramas, AreFlippedTurnedCoveredOrLate) {
  cv::Mat flipped;
  cv::flip(picture(15), flipped, -1);
  EXPECT_TRUE(is_same(Played("panorama_upside_down").panorama(15), flipped));
  cv::flip(picture(15), flipped, 1);
  EXPECT_TRUE(is_same(Played("panorama_mirrored").panorama(15), flipped));
  const cv::Mat turned = Played("panorama_turned").panorama(15);
  bool is_found = false;
  for (int columns = 1; columns < turned.cols; ++columns) {
    cv::Mat moved;
    cv::hconcat(picture(15).colRange(turned.cols - columns, turned.cols),
                picture(15).colRange(0, turned.cols - columns), moved);
    is_found = is_found || is_same(turned, moved);
  }
  EXPECT_TRUE(is_found) << "not the same columns, shifted cyclically";
  EXPECT_EQ(cv::countNonZero(Played("panorama_covered").panorama(15).reshape(1) == 20), 3 * 48 * 32);
  Played late("panorama_clock");
  const auto stamp_ns = late.fault.panoramas({0, picture(1)}, late.moment(15)).at(0).stamp_ns;
  EXPECT_EQ(std::abs(stamp_ns), 200'000'000);
  Played frozen("panorama_frozen");
  frozen.panorama(9);
  EXPECT_TRUE(is_same(frozen.panorama(15), picture(9)));
}

TEST(WrongCalibrations, AreOffByWhatTheySay) {
  CameraInfo info;
  info.k() = {500, 0, 320, 0, 500, 240, 0, 0, 1};
  info.p() = {500, 0, 320, -60, 0, 500, 240, 0, 0, 0, 1, 0};
  Played baseline("baseline_wrong"), focal("focal_wrong");
  EXPECT_NEAR(std::abs(baseline.fault.right_infos(info, baseline.moment(15)).at(0).p()[3] / -60 - 1.0), 0.02, 1e-12);
  const auto longer = focal.fault.right_infos(info, focal.moment(15)).at(0);
  EXPECT_NEAR(std::abs(longer.p()[0] / 500 - 1.0), 0.01, 1e-12);
  EXPECT_NEAR(longer.p()[3] / longer.p()[0], -0.12, 1e-12) << "the baseline stays";
  Played rig("rig_turned");
  tf2_msgs::msg::TFMessage transforms;
  transforms.transforms().resize(1);
  transforms.transforms()[0].child_frame_id("stereo_left_optical");
  transforms.transforms()[0].transform().rotation().w(1.0);
  const auto turned = rig.fault.static_transforms(transforms, rig.moment(15)).at(0).transforms()[0].transform();
  EXPECT_NEAR(2.0 * std::acos(turned.rotation().w()) * 180.0 / M_PI, 3.0, 1e-9);
  EXPECT_NEAR(std::abs(turned.rotation().z()), std::sin(1.5 * M_PI / 180.0), 1e-12);
}

TEST(MixedFaults, ActForThreeSecondsOfEachTwenty) {
  Played played("mixed");
  int disturbed = 0;
  for (int i = 0; i < 20 * 200; ++i) {  // 10 per second
    const double t_s = 0.1 * i, in_period_s = std::fmod(t_s, 20.0);
    const auto passed = played.fault.pairs(pair_of(i), {t_s, false});
    const bool is_as_it_was = passed.size() == 1 && passed[0].left_ns == i * kPeriod_ns &&
                              passed[0].right_ns == i * kPeriod_ns && is_same(passed[0].left, picture(i, 0)) &&
                              is_same(passed[0].right, picture(i, 1));
    if (in_period_s > 7.9 && in_period_s < 11.2) {
      disturbed += is_as_it_was ? 0 : 1;
    } else {
      ASSERT_TRUE(is_as_it_was) << "at " << t_s << " s";
    }
  }
  EXPECT_GT(disturbed, 20 * 5);
}

TEST(WrongMessages, AreStoppedFarAwayOrNoNumbers) {
  Odometry odometry;
  odometry.pose().covariance()[7] = 0.25;
  Played gone("odometry_stopped");
  EXPECT_TRUE(gone.fault.odometry(odometry, gone.moment(15)).empty());
  EXPECT_EQ(gone.fault.odometry(odometry, gone.moment(20)).size(), 1U);
  Played nan("odometry_nan");
  const auto spoilt = nan.fault.odometry(odometry, nan.moment(10)).at(0);
  EXPECT_TRUE(std::isnan(spoilt.pose().covariance()[7]) || std::isnan(spoilt.pose().pose().position().x()));
  Played far("odometry_absurd");
  EXPECT_GE(far.fault.odometry(odometry, far.moment(10)).at(0).pose().pose().position().x(), 5e3);
  EXPECT_EQ(far.fault.odometry(odometry, far.moment(11)).at(0).pose().pose().position().x(), 0.0)
      << "only some messages are invalid";
  Played landmark("landmark_wrong");
  const auto moved = landmark.fault.landmarks({}, landmark.moment(15)).at(0).pose().pose().position();
  EXPECT_GT(std::hypot(moved.x(), moved.y()), 2.8);
}

}  // namespace
}  // namespace panvo::test
