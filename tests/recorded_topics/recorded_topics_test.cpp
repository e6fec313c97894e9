// SPDX-License-Identifier: Apache-2.0
// The system on recorded topics: from a data set to a bag, and from the bag to odometry; replayed, live, and in two
// processes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <vector>

#include "panvo/runtime/test_domain.hpp"
#include "panvo/test/recorded_data.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "process.hpp"
#include "rendered_walk.hpp"
#include "tum_positions.hpp"

namespace panvo::test {
namespace {

using std::chrono::seconds;

const std::string kStereo = SYSTEMS "/stereo.yaml";

/// Records the raw images of a recording into a bag.
class RecordedTopics : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (GetParam() == "rendered") {
      data_ = folder_ / "rendered";
      RenderedWalk{}.write(data_);
    } else {
      data_ = recorded_data(GetParam());
      PANVO_NEEDS_RECORDING(data_);
    }
    const Finished recorded =
        run({PANVO_RUN, SYSTEMS "/record.yaml", "output:=" + bag_, "--dataset", data_.string(), "--replay"});
    ASSERT_EQ(recorded.status, 0) << recorded.output;
  }

  Finished play(const std::string& out, const std::vector<std::string>& more) const {
    std::vector<std::string> words{PANVO_RUN, kStereo, "--bag", bag_, "--out", folder_ / out};
    words.insert(words.end(), more.begin(), more.end());
    return run(words, seconds(200));
  }

  TemporaryFolder folder_;
  const std::string bag_ = folder_ / "bag";
  std::filesystem::path data_;
};

TEST_P(RecordedTopics, ReplayToTheSameOdometryBitForBit) {
  for (const char* out : {"first", "second"}) {
    const Finished played = play(out, {"--replay"});
    ASSERT_EQ(played.status, 0) << played.output;
  }
  for (const char* file : {"odometry_binocular.tum", "odometry_binocular_covariance.csv"}) {
    const std::string first = read_file(folder_ / "first" / file);
    EXPECT_FALSE(first.empty()) << file;
    EXPECT_EQ(first, read_file(folder_ / "second" / file)) << file;
  }
}

TEST_P(RecordedTopics, GiveTheSameOdometryLiveInOneContainerWhenNothingIsDropped) {
  const Finished replayed = play("replayed", {"--replay"});
  ASSERT_EQ(replayed.status, 0) << replayed.output;
  const Finished live = play("live", {"--local", "--rate", "0"});
  ASSERT_EQ(live.status, 0) << live.output;
  EXPECT_EQ(read_file(folder_ / "replayed" / "odometry_binocular.tum"),
            read_file(folder_ / "live" / "odometry_binocular.tum"));
}

TEST_P(RecordedTopics, GiveTheSameOdometryInTwoProcessesOverDds) {
  const Finished replayed = play("replayed", {"--replay"});
  ASSERT_EQ(replayed.status, 0) << replayed.output;
  const std::string domain = std::to_string(runtime::test_domain());
  const Finished split = run({PANVO_RUN, HERE "/two_processes.yaml", "--bag", bag_, "--out", folder_ / "split",
                              "--rate", "1", "--domain", domain},
                             seconds(200));
  ASSERT_EQ(split.status, 0) << split.output;
  const auto expected = read_tum(folder_ / "replayed" / "odometry_binocular.tum");
  const auto got = read_tum(folder_ / "split" / "odometry_binocular.tum");
  // On a busy machine, a frame may be lost between processes, which changes the path by less than 5 cm over this
  // distance. The first frame, the origin, must be present, and nine of ten frames in all.
  EXPECT_TRUE(got.contains(expected.begin()->first)) << split.output;
  EXPECT_GE(got.size(), expected.size() * 9 / 10) << split.output;
  for (const auto& [stamp, position] : got) {
    ASSERT_TRUE(expected.contains(stamp)) << stamp;
    EXPECT_LT(distance(position, expected.at(stamp)), 0.05) << stamp;
  }
}

TEST_P(RecordedTopics, CompressedWithoutLossGiveTheSameOdometryBitForBit) {
  const std::string compressed = folder_ / "compressed";
  const Finished recorded = run({PANVO_RUN, SYSTEMS "/record_compressed.yaml", "output:=" + compressed, "format:=png",
                                 "images:=/stereo/left/image_raw /stereo/right/image_raw",
                                 "topics:=/stereo/.*/camera_info /tf_static", "--bag", bag_, "--replay"});
  ASSERT_EQ(recorded.status, 0) << recorded.output;
  const Finished replayed = play("replayed", {"--replay"});
  ASSERT_EQ(replayed.status, 0) << replayed.output;
  const Finished decoded =
      run({PANVO_RUN, kStereo, "compressed:=true", "--bag", compressed, "--out", folder_ / "decoded", "--replay"});
  ASSERT_EQ(decoded.status, 0) << decoded.output;
  const std::string expected = read_file(folder_ / "replayed" / "odometry_binocular.tum");
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(expected, read_file(folder_ / "decoded" / "odometry_binocular.tum"));
}

TEST_P(RecordedTopics, RecordedTwiceAreTheSameBagMessageForMessage) {
  const std::string again = folder_ / "again";
  const Finished recorded =
      run({PANVO_RUN, SYSTEMS "/record.yaml", "output:=" + again, "--dataset", data_.string(), "--replay"});
  ASSERT_EQ(recorded.status, 0) << recorded.output;
  const Finished compared =
      run({PANVO_BAG, "diff", bag_, again, "--times", "--exclude", "/rosout"});  // it contains the folder name
  EXPECT_EQ(compared.status, 0) << compared.output;
}

TEST_P(RecordedTopics, UnderNamesThatNobodyReadsAreNoticed) {
  const Finished played = play("idle", {"--replay", "--set", "bag_player.topics=[/tf_static]"});
  EXPECT_EQ(played.status, 1) << played.output;
  EXPECT_THAT(played.output, testing::HasSubstr("received nothing on stereo/left/"));
  EXPECT_THAT(played.output, testing::HasSubstr("`panvo bag info " + bag_ + "`"));
}

/// camera_info files of a rectified pair, from a KITTI calibration: P0 and P1, rows of 4.
void write_calibration(const std::filesystem::path& calib, const std::string& size,
                       const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::istringstream lines(read_file(calib));
  for (const char* name : {"left", "right"}) {
    std::string label, numbers;
    lines >> label;
    std::getline(lines, numbers);
    std::istringstream words(numbers);
    std::vector<std::string> p{std::istream_iterator<std::string>(words), {}};
    ASSERT_EQ(p.size(), 12u) << numbers;
    std::ofstream(folder / (std::string(name) + ".yaml"))
        << size << "\ndistortion_model: plumb_bob\ndistortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n"
        << "camera_matrix: {rows: 3, cols: 3, data: [" << p[0] << ", 0, " << p[2] << ", 0, " << p[5] << ", " << p[6]
        << ", 0, 0, 1]}\nrectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}\n"
        << "projection_matrix: {rows: 3, cols: 4, data: [" << p[0] << ", 0, " << p[2] << ", " << p[3] << ", 0, " << p[5]
        << ", " << p[6] << ", 0, 0, 0, 1, 0]}\n";
  }
}

/// A bag of images alone, under a driver's names, as many are: its command is in `panvo bag info`.
TEST_P(RecordedTopics, WithOtherNamesAndWithoutCalibrationArePlayedAsBagInfoSays) {
  const std::string foreign = folder_ / "foreign";
  const Finished recorded =
      run({PANVO_RUN, SYSTEMS "/record.yaml", "output:=" + foreign, "topics:=/cam0/image_raw /cam1/image_raw", "-r",
           "stereo/left/image_raw:=/cam0/image_raw", "-r", "stereo/right/image_raw:=/cam1/image_raw", "--dataset",
           data_.string(), "--replay"});
  ASSERT_EQ(recorded.status, 0) << recorded.output;
  const Finished info = run({PANVO_BAG, "info", foreign});
  EXPECT_THAT(info.output, testing::HasSubstr("panvo run stereo --bag " + foreign + " --calibration FOLDER"));
  EXPECT_THAT(info.output, testing::HasSubstr("-r /cam0/image_raw:=/stereo/left/image_raw"));
  EXPECT_THAT(info.output, testing::HasSubstr("-r /cam1/image_raw:=/stereo/right/image_raw"));

  const bool is_kitti = GetParam() == "kitti_03";
  write_calibration(data_ / "calib.txt",
                    is_kitti ? "image_width: 1242\nimage_height: 375" : "image_width: 320\nimage_height: 240",
                    folder_ / "calibration");
  const Finished played =
      run({PANVO_RUN, kStereo, "--bag", foreign, "--calibration", folder_ / "calibration", "-r",
           "/cam0/image_raw:=/stereo/left/image_raw", "-r", "/cam1/image_raw:=/stereo/right/image_raw", "--set",
           "stereo_calibration.mount_xyz_rpy=[0, 0, 0, 0, 0, 0]", "--out", folder_ / "played", "--replay"},
          seconds(200));
  ASSERT_EQ(played.status, 0) << played.output;
  const Finished known = play("known", {"--replay"});
  ASSERT_EQ(known.status, 0) << known.output;
  const auto expected = read_tum(folder_ / "known" / "odometry_binocular.tum");
  const auto got = read_tum(folder_ / "played" / "odometry_binocular.tum");
  EXPECT_GE(got.size(), expected.size() - 1);  // the first image comes before its camera_info
  ASSERT_FALSE(got.empty());
  const auto origin = expected.at(got.begin()->first);
  const auto end = expected.rbegin()->second, reached = got.rbegin()->second;
  const double length = distance(end, origin);
  EXPECT_NEAR(distance(reached, got.begin()->second), length, 0.01 * length);
}

INSTANTIATE_TEST_SUITE_P(, RecordedTopics, testing::Values("rendered", "kitti_03"),
                         [](const auto& name) { return name.param; });

TEST(RenderedWalk, IsMeasuredToAFewCentimetres) {
  TemporaryFolder folder;
  RenderedWalk{.frames = 40}.write(folder / "walk");
  const Finished played = run({PANVO_RUN, kStereo, "--dataset", folder / "walk", "--out", folder / "out", "--replay"});
  ASSERT_EQ(played.status, 0) << played.output;
  const auto path = read_tum(folder / "out" / "odometry_binocular.tum");
  ASSERT_EQ(path.size(), 40U);
  for (const auto& [stamp, position] :
       path) {  // base_link: x forward; 0.1 m every 0.1 s, so that x in m equals the stamp in s
    EXPECT_LT(distance(position, {std::stod(stamp), 0, 0}), 0.04) << stamp;  // 1 % of the whole distance
  }
}

}  // namespace
}  // namespace panvo::test
