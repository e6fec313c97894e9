// SPDX-License-Identifier: Apache-2.0
// Wrong input to the whole system gives an error that names it, or poses marked as unreliable, but never a crash or a
// NaN.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <sstream>

#include "panvo/runtime/test_domain.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "process.hpp"
#include "rendered_walk.hpp"

namespace panvo::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string kStereo = SYSTEMS "/stereo.yaml";
constexpr int kRunFailed = 1, kBadConfiguration = 2;

struct Fault : testing::Test {
  TemporaryFolder folder;

  std::string write_walk(const RenderedWalk& walk) const {
    walk.write(folder / "walk");
    return folder / "walk";
  }

  std::string write(const std::string& name, const std::string& text) const { return folder.write(name, text); }

  Finished replay(const std::string& data, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{PANVO_RUN, kStereo, "--dataset", data, "--out", folder / "out", "--replay"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }

  /// Number of readable messages of a topic in a bag, from `panvo bag info`.
  static std::size_t count_messages(const std::string& bag, const std::string& topic) {
    const Finished info = run({PANVO_BAG, "info", "--json", bag});
    const auto json =
        nlohmann::json::parse(info.output.substr(std::min(info.output.find('{'), info.output.size())), nullptr, false);
    EXPECT_FALSE(json.is_discarded()) << info.output;
    for (const auto& entry : json.value("topics", nlohmann::json::array())) {
      if (entry.value("name", "") == topic) return entry.at("count").get<std::size_t>();
    }
    return 0;
  }

  /// Number of lines of the trajectory; fails if a number is not finite.
  std::size_t count_sound_poses() const {
    std::istringstream lines(read_file(folder / "out" / "odometry_binocular.tum"));
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
      EXPECT_THAT(line, AllOf(Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
    }
    return count;
  }
};

TEST_F(Fault, AMissingDataSetIsNamed) {
  const Finished finished = replay(folder / "nowhere");
  EXPECT_EQ(finished.status, kBadConfiguration);
  EXPECT_THAT(finished.output, HasSubstr(folder / "nowhere"));
}

TEST_F(Fault, AnEmptyDataSetIsToldWhatWasLookedFor) {
  std::filesystem::create_directories(folder / "empty");
  const Finished finished = replay(folder / "empty");
  EXPECT_EQ(finished.status, kBadConfiguration);
  EXPECT_THAT(finished.output, AllOf(HasSubstr("empty"), HasSubstr("calib.txt"), HasSubstr("mav0")));
}

TEST_F(Fault, ACalibrationWithoutBaselineIsRefused) {
  const std::string data = write_walk({.frames = 2});
  std::ofstream(folder / "walk" / "calib.txt")
      << "P0: 240 0 160 0 0 240 120 0 0 0 1 0\nP1: 240 0 160 0 0 240 120 0 0 0 1 0\n";
  const Finished finished = replay(data);
  EXPECT_EQ(finished.status, kBadConfiguration);
  EXPECT_THAT(finished.output, AllOf(HasSubstr("calib.txt"), HasSubstr("baseline")));
}

TEST_F(Fault, AMisspeltParameterIsNamedWithFileAndLineAndWhatWasMeant) {
  const std::string system = write("system.yaml",
                                   "launch:\n"
                                   "- node_container:\n"
                                   "    name: panvo\n"
                                   "    composable_node:\n"
                                   "    - pkg: panvo_stereo_rectifier\n"
                                   "      plugin: StereoRectifierComponent\n"
                                   "      name: stereo_rectifier\n"
                                   "      param:\n"
                                   "      - {name: outptu, value: mono8}\n");
  const Finished finished = run({PANVO_RUN, system, "--dataset", write_walk({.frames = 2}), "--replay"});
  EXPECT_EQ(finished.status, kBadConfiguration);
  EXPECT_THAT(finished.output,
              AllOf(HasSubstr("system.yaml:9"), HasSubstr("outptu"), HasSubstr("did you mean"), HasSubstr("output")));
}

TEST_F(Fault, APluginThatIsNotThereIsNamed) {
  const std::string system = write("system.yaml",
                                   "launch:\n"
                                   "- node_container:\n"
                                   "    name: panvo\n"
                                   "    composable_node:\n"
                                   "    - {pkg: panvo_teleporter, plugin: TeleporterComponent, name: teleporter}\n");
  const Finished finished = run({PANVO_RUN, system, "--replay"});
  EXPECT_EQ(finished.status, kBadConfiguration);
  EXPECT_THAT(finished.output, AllOf(HasSubstr("system.yaml:5"), HasSubstr("libpanvo_teleporter_component.so")));
}

TEST_F(Fault, APackageWithoutComponentsIsNamedBesideThoseThatHaveSome) {
  const Finished listed = run({PANVO_COMPONENT, "list"});
  EXPECT_EQ(listed.status, 0) << listed.output;
  EXPECT_THAT(listed.output, HasSubstr("panvo_stereo_rectifier StereoRectifierComponent\n"));
  const Finished shown = run({PANVO_COMPONENT, "show", "panvo_teleporter"});
  EXPECT_EQ(shown.status, kRunFailed);
  EXPECT_THAT(shown.output, HasSubstr("libpanvo_teleporter_component.so"));
}

TEST_F(Fault, AnUnknownSettingIsRefusedAndTheComponentsAreNamed) {
  const Finished finished = replay(write_walk({.frames = 2}), {"--set", "odometer.speed=2"});
  EXPECT_EQ(finished.status, kBadConfiguration);
  EXPECT_THAT(finished.output, AllOf(HasSubstr("odometer"), HasSubstr("binocular_odometry")));
}

TEST_F(Fault, ATopicThatIsAwaitedAndThatNobodyHereHasIsNamed) {
  const Finished finished = run({PANVO_RUN, kStereo, "--await", "/nothing"});
  EXPECT_EQ(finished.status, kBadConfiguration);
  EXPECT_THAT(finished.output, AllOf(HasSubstr("/nothing"), HasSubstr("/odometry/binocular")));
}

/// Frames 8 to 11 of 20 are spoilt; the odometry must report them as unreliable and be correct again at the end.
struct SpoiltFrames : Fault,
                      testing::WithParamInterface<std::pair<const char*, std::function<void(cv::Mat&, cv::Mat&)>>> {};

TEST_P(SpoiltFrames, AreCarriedWithoutNaNAndTheOdometryRecovers) {
  RenderedWalk walk;
  walk.spoil = [](int frame, cv::Mat& left, cv::Mat& right) {
    if (frame >= 8 && frame < 12) GetParam().second(left, right);
  };
  const Finished finished = replay(write_walk(walk));
  EXPECT_EQ(finished.status, 0) << finished.output;
  EXPECT_EQ(count_sound_poses(), 20U);
  std::istringstream lines(read_file(folder / "out" / "odometry_binocular.tum"));
  std::string line, last;
  while (std::getline(lines, line)) last = line;
  std::istringstream words(last);
  double stamp = 0, x = 0, y = 0, z = 0;
  words >> stamp >> x >> y >> z;
  EXPECT_NEAR(x, 1.9, 0.1);  // the motion model bridges the gap, because the motion is steady
  EXPECT_NEAR(y, 0, 0.1);
  EXPECT_NEAR(z, 0, 0.1);
}

INSTANTIATE_TEST_SUITE_P(
    , SpoiltFrames,
    testing::Values(std::pair{"black", [](cv::Mat& left, cv::Mat& right) { left = 0, right = 0; }},
                    std::pair{"constant", [](cv::Mat& left, cv::Mat& right) { left = 128, right = 128; }},
                    std::pair{"saturated", [](cv::Mat& left, cv::Mat& right) { left = 255, right = 255; }},
                    std::pair{"swapped", [](cv::Mat& left, cv::Mat& right) { cv::swap(left, right); }}),
    [](const auto& spoilt) { return spoilt.param.first; });

TEST_F(Fault, AnUndecodableImageIsNamedAndSkipped) {
  const std::string data = write_walk({});
  std::ofstream(folder / "walk" / "image_0" / "000005.png") << "this is no picture";
  const Finished finished = replay(data);
  EXPECT_EQ(finished.status, 0) << finished.output;
  EXPECT_THAT(finished.output, HasSubstr("000005.png"));
  EXPECT_EQ(count_sound_poses(), 19U);
}

TEST_F(Fault, OneEyeMissingInAPairIsNamedAndThePairLeftOut) {
  const std::string data = write_walk({});
  std::filesystem::remove(folder / "walk" / "image_1" / "000007.png");
  const Finished finished = replay(data);
  EXPECT_EQ(finished.status, 0) << finished.output;
  EXPECT_THAT(finished.output, HasSubstr("000007.png"));
  EXPECT_EQ(count_sound_poses(), 19U);
}

TEST_F(Fault, TimestampsThatGoBackwardsAreRefusedWithTheirLine) {
  const std::string data = write_walk({.frames = 4});
  std::ofstream(folder / "walk" / "times.txt") << "0\n0.1\n0.05\n0.3\n";
  const Finished finished = replay(data);
  EXPECT_EQ(finished.status, kBadConfiguration);
  EXPECT_THAT(finished.output, HasSubstr("times.txt:3"));
}

TEST_F(Fault, SigkillWhileRecordingLeavesAReadableBag) {
  const std::string data = write_walk({.frames = 60});
  const std::string bag = folder / "bag";
  Process recording({PANVO_RUN, SYSTEMS "/record.yaml", "output:=" + bag, "--dataset", data, "--local", "--rate", "1"});
  // Killed after the first commit: the database has grown beyond its empty tables, and the journal is empty again.
  const auto size_of = [&](const char* file) {
    std::error_code error;
    const auto size = std::filesystem::file_size(std::filesystem::path(bag) / file, error);
    return error ? std::uintmax_t{0} : size;
  };
  ASSERT_TRUE(eventually([&] { return size_of("bag_0.db3") >= 1'500'000 && size_of("bag_0.db3-journal") == 0; }))
      << recording.output();
  recording.signal(SIGKILL);
  EXPECT_EQ(recording.wait(), 128 + SIGKILL);
  const Finished info = run({PANVO_BAG, "info", bag});
  EXPECT_EQ(info.status, 0) << info.output;
  EXPECT_THAT(info.output, HasSubstr("/stereo/left/image_raw"));
  const Finished played = run({PANVO_RUN, kStereo, "--bag", bag, "--out", folder / "out", "--replay"});
  EXPECT_EQ(played.status, 0) << played.output;
  EXPECT_GT(count_sound_poses(), 2U);
}

TEST_F(Fault, ABagCutOffInItsMiddleIsPlayedAsFarAsItGoes) {
  const std::string bag = folder / "bag";
  ASSERT_EQ(run({PANVO_RUN, SYSTEMS "/record.yaml", "output:=" + bag, "--dataset", write_walk({}), "--replay"}).status,
            0);
  for (const auto& file : std::filesystem::directory_iterator(bag)) {
    if (file.path().extension() == ".db3") std::filesystem::resize_file(file.path(), file.file_size() / 2);
  }
  const Finished played = run({PANVO_RUN, kStereo, "--bag", bag, "--out", folder / "out", "--replay"});
  EXPECT_EQ(played.status, 0) << played.output;
  EXPECT_THAT(played.output, HasSubstr(".db3"));
  const std::size_t pairs =
      std::min(count_messages(bag, "/stereo/left/image_raw"), count_messages(bag, "/stereo/right/image_raw"));
  EXPECT_GE(pairs, 8U) << "half of the file holds half of the 20 pairs, minus the overhead at its start";
  EXPECT_EQ(count_sound_poses(), pairs) << "every readable pair gives a pose";
}

TEST_F(Fault, SigintEndsARunSoonAndLeavesItsResults) {
  const std::string data = write_walk({.frames = 100});
  Process running({PANVO_RUN, kStereo, "--dataset", data, "--out", folder / "out", "--local", "--rate", "1"});
  ASSERT_TRUE(eventually([&] { return !read_file(folder / "out" / "odometry_binocular.tum").empty(); }))
      << running.output();
  running.signal(SIGINT);
  EXPECT_EQ(running.wait(std::chrono::seconds(30)), 128 + SIGINT) << running.output();
  EXPECT_GT(count_sound_poses(), 0U);
  EXPECT_THAT(read_file(folder / "out" / "summary.json"),
              AllOf(HasSubstr("\"interrupted\": true"), HasSubstr("\"exit_status\": 130")));
}

TEST_F(Fault, ARunThatIsPlayedToItsEndIsNotInterrupted) {
  const Finished finished = replay(write_walk({.frames = 3}));
  EXPECT_EQ(finished.status, 0) << finished.output;
  EXPECT_THAT(read_file(folder / "out" / "summary.json"), HasSubstr("\"interrupted\": false"));
}

TEST_F(Fault, SigintEndsALiveSystemWithoutComplaint) {
  const std::string bag = folder / "bag";
  Process recording({PANVO_RUN, SYSTEMS "/record.yaml", "output:=" + bag, "topics:=/diagnostics", "--domain",
                     std::to_string(runtime::test_domain())});
  ASSERT_TRUE(eventually([&] { return read_file(bag + "/metadata.yaml").find("/diagnostics") != std::string::npos; }))
      << recording.output();
  recording.signal(SIGINT);
  EXPECT_EQ(recording.wait(std::chrono::seconds(30)), 0) << recording.output();
}

TEST_F(Fault, AFolderOfSomebodyElseIsNotWrittenTo) {
  write("out/odometry_binocular.tum", "precious");
  const std::string data = write_walk({.frames = 3});
  const Finished refused = replay(data);
  EXPECT_EQ(refused.status, kBadConfiguration);
  EXPECT_THAT(refused.output, AllOf(HasSubstr("contains odometry_binocular.tum"), HasSubstr("--overwrite")));
  EXPECT_EQ(read_file(folder / "out" / "odometry_binocular.tum"), "precious");
  EXPECT_EQ(replay(data, {"--overwrite"}).status, 0);
  EXPECT_EQ(replay(data).status, 0) << "an earlier run is replaced";
}

TEST_F(Fault, ARunThatWritesNothingFails) {
  const std::string data = write_walk({.frames = 3});
  std::filesystem::remove(folder / "walk" / "poses.txt");  // otherwise ground truth would be written
  const Finished finished = run({PANVO_RUN, SYSTEMS "/record.yaml", "output:=" + (folder / "bag").string(),
                                 "topics:=/tf_static", "--dataset", data, "--out", folder / "out", "--replay"});
  EXPECT_EQ(finished.status, kRunFailed) << finished.output;
  EXPECT_THAT(finished.output, HasSubstr("nothing was written to " + (folder / "out").string()));
}

TEST_F(Fault, ARunThatPlaysNothingFails) {
  const std::string bag = folder / "bag";
  ASSERT_EQ(
      run({PANVO_RUN, SYSTEMS "/record.yaml", "output:=" + bag, "--dataset", write_walk({.frames = 3}), "--replay"})
          .status,
      0);
  const Finished finished = run({PANVO_RUN, SYSTEMS "/play.yaml", "bag:=" + bag, "topics:=/nothing", "--local"});
  EXPECT_NE(finished.status, 0) << finished.output;
}

TEST_F(Fault, ARecordingWhoseFileIsRemovedEndsWithAnErrorAndKeepsWhatItHas) {
  const std::string data = write_walk({.frames = 100});
  const std::string bag = folder / "bag";
  Process recording({PANVO_RUN, SYSTEMS "/record.yaml", "output:=" + bag, "--dataset", data, "--local", "--rate", "2"});
  ASSERT_TRUE(eventually([&] {
    std::error_code error;
    return std::filesystem::file_size(bag + "/bag_0.db3", error) >= 1'500'000 && !error;
  })) << recording.output();
  ASSERT_TRUE(std::filesystem::remove(bag + "/bag_0.db3"));  // in one step: the recorder may recreate it at any time
  EXPECT_EQ(recording.wait(std::chrono::seconds(60)), kRunFailed) << recording.output();
  EXPECT_THAT(recording.output(), HasSubstr("was removed while it was being recorded"));
  const Finished info = run({PANVO_BAG, "info", bag});
  EXPECT_EQ(info.status, 0) << info.output;
  EXPECT_THAT(info.output, HasSubstr("/stereo/left/image_raw"));
}

}  // namespace
}  // namespace panvo::test
