// SPDX-License-Identifier: Apache-2.0
// Command line of panvo_evaluate_places.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "place_recording_fixture.hpp"

namespace panvo::evaluation {
namespace {

using ::testing::HasSubstr;

/// Gives each panorama a texture of its own: even ones are refused.
void paint(const PlainRecording& recording, std::uint64_t seed) {
  cv::RNG random(seed);
  for (const auto& file : std::filesystem::directory_iterator(recording.folder / "mav0/cam2/data")) {
    cv::Mat coarse(16, 32, CV_8UC1), image;
    random.fill(coarse, cv::RNG::UNIFORM, 0, 255);
    cv::resize(coarse, image, {256, 128}, 0.0, 0.0, cv::INTER_NEAREST);
    cv::imwrite(file.path().string(), image);
  }
}

class PlacesProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    paint(library_, 1);
    paint(elsewhere_, 2);
  }

  /// Exit status with the arguments; output in out.txt and err.txt of the folder.
  int call(const std::string& arguments) const {
    const std::string command = "cd '" + folder_.path().string() + "' && " PANVO_EVALUATE_PLACES " " + arguments +
                                " > out.txt 2> err.txt < /dev/null";
    return WEXITSTATUS(std::system(command.c_str()));
  }

  const panvo::test::TemporaryFolder folder_;
  const PlainRecording library_{{10, 100, 200}, {{1, 0}, {2, 1}, {3, 2}}};
  const PlainRecording elsewhere_{{18, 160}, {{7, 1}}};
  const std::string pair_ = "'" + elsewhere_.folder.path().string() + "' --library-from '" +
                            library_.folder.path().string() + "' --out result";
};

TEST_F(PlacesProgram, OnlyMatchesTheJourneyAlsoWhereNoPlaceOfTheLibraryOccurs) {
  ASSERT_EQ(call(pair_ + " --only-journey"), 0) << folder_.read("err.txt");
  const auto json = nlohmann::json::parse(folder_.read("result/places.json"));
  EXPECT_EQ(json["places"], 3);
  EXPECT_EQ(json["revisits"], 0);
  EXPECT_EQ(json["panoramas"], 2);
  EXPECT_EQ(json["journey"]["matches"].size(), 0U);
  EXPECT_FALSE(json.contains("methods"));
}

TEST_F(PlacesProgram, OtherwiseAsksForPlacesThatOccur) {
  EXPECT_EQ(call(pair_), 1);
  EXPECT_THAT(folder_.read("err.txt"), HasSubstr("lists no revisits"));
}

TEST_F(PlacesProgram, DoesNotLeaveOutBothParts) {
  EXPECT_EQ(call(pair_ + " --only-journey --only-table"), 2);
  EXPECT_THAT(folder_.read("err.txt"), HasSubstr("--only-table excludes --only-journey"));
}

TEST_F(PlacesProgram, FailsOnBadUsageAndExplainsItself) {
  EXPECT_EQ(call(""), 2);
  EXPECT_THAT(folder_.read("err.txt"), HasSubstr("recording is required"));
  EXPECT_EQ(call("--help"), 0);
}

}  // namespace
}  // namespace panvo::evaluation
