// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/journey_video.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "journey_fixture.hpp"
#include "panvo/evaluation/plot.hpp"
#include "video_encoder.hpp"

namespace panvo::evaluation {
namespace {

using ::testing::HasSubstr;

bool has(const std::string& program) { return std::system(("command -v " + program + " > /dev/null").c_str()) == 0; }

class JourneyVideo : public MadeJourney {
 protected:
  void SetUp() override {
    if (!has("ffmpeg")) GTEST_SKIP() << "ffmpeg is not installed";
    MadeJourney::SetUp();
    write_matches(fmt::format("{},matched,3,180,0.1,0.2,0.3,1,1,1,\"\"\n", stamp(90)));
  }

  /// The pictures of a video, decoded.
  std::vector<cv::Mat3b> pictures_of(const std::filesystem::path& video) const {
    const auto folder = folder_ / "decoded";
    std::filesystem::create_directories(folder);
    const std::string decode =
        "ffmpeg -nostdin -loglevel error -i '" + video.string() + "' '" + folder.string() + "/%04d.png'";
    EXPECT_EQ(std::system(decode.c_str()), 0);
    std::vector<cv::Mat3b> pictures;
    for (int i = 1;; ++i) {
      const auto file = folder / fmt::format("{:04}.png", i);
      if (!std::filesystem::exists(file)) return pictures;
      pictures.emplace_back(cv::imread(file.string(), cv::IMREAD_COLOR));
    }
  }

  int call(const std::string& arguments, const std::string& before = "") const {
    const std::string command = "cd '" + folder_.path().string() + "' && " + before + " " PANVO_EVALUATE_JOURNEY " " +
                                arguments + " > out.txt 2> err.txt < /dev/null";
    return WEXITSTATUS(std::system(command.c_str()));
  }
};

/// Pixels near a colour; encoding changes colours of thin lines.
int count(const cv::Mat3b& picture, const cv::Rect& part, const cv::Vec3b& colour) {
  int found = 0;
  for (const cv::Vec3b& pixel : cv::Mat3b(picture(part).clone())) {
    if (cv::norm(cv::Vec3i(pixel) - cv::Vec3i(colour)) < 60.0) ++found;
  }
  return found;
}

TEST_F(JourneyVideo, HasThePicturesThatWereAdded) {
  VideoEncoder encoder(folder_ / "v.mp4", {64, 48}, 25);
  for (int i = 0; i < 10; ++i) encoder.add(cv::Mat3b(48, 64, i < 5 ? cv::Vec3b(200, 0, 0) : cv::Vec3b(0, 0, 200)));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "v.mp4")) << "not complete yet";
  encoder.finish();
  const auto pictures = pictures_of(folder_ / "v.mp4");
  ASSERT_EQ(pictures.size(), 10U);
  EXPECT_LT(cv::norm(cv::Vec3i(pictures[0](24, 32)) - cv::Vec3i(200, 0, 0)), 25.0);
  EXPECT_LT(cv::norm(cv::Vec3i(pictures[9](24, 32)) - cv::Vec3i(0, 0, 200)), 25.0);
}

TEST_F(JourneyVideo, LeavesNoFileIfItIsNotFinished) {
  {
    VideoEncoder encoder(folder_ / "cut.mp4", {64, 48}, 25);
    encoder.add(cv::Mat3b(48, 64, cv::Vec3b(0, 0, 0)));
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cut.mp4"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cut.part.mp4"));
}

TEST_F(JourneyVideo, SaysWhatTheEncoderSaid) {
  VideoEncoder encoder(folder_ / "no such folder/v.mp4", {64, 48}, 25);
  const auto fill = [&] {
    for (int i = 0; i < 1000; ++i) encoder.add(cv::Mat3b(48, 64, cv::Vec3b(0, 0, 0)));
    encoder.finish();
  };
  try {
    fill();
    FAIL() << "no error";
  } catch (const PlotError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no such folder/v.part.mp4"));
  }
}

TEST_F(JourneyVideo, ShowsTheGrowingPathsThePanoramaAndTheRecognisedPlace) {
  ASSERT_EQ(call("run --recording recording --out result --video drive.mp4 --video-speed 20"), 0)
      << folder_.read("err.txt");
  EXPECT_THAT(folder_.read("out.txt"), HasSubstr("written: drive.mp4"));
  const auto pictures = pictures_of(folder_ / "drive.mp4");
  ASSERT_EQ(pictures.size(), 126U + 25U) << "100 s at 20 x 25 pictures per second, both ends included, and one second";
  const cv::Rect plan(0, 0, 640, 600), panorama(648, 360, 628, 136), place(648, 520, 628, 136);
  const cv::Vec3b orange(0, 94, 213), blue(178, 114, 0), white(255, 255, 255);
  EXPECT_EQ(count(pictures[0], plan, orange), 0);
  EXPECT_GT(count(pictures[40], plan, blue), 50);
  EXPECT_GT(count(pictures[125], plan, orange), 100) << "a line of 600 pixels, half of it beside the other path";
  EXPECT_EQ(count(pictures[5], panorama, white), panorama.area());
  EXPECT_LT(count(pictures[13], panorama, white), panorama.area() / 10) << "10.4 s, the panorama is of 10 s";
  EXPECT_EQ(count(pictures[111], place, white), place.area()) << "88.8 s";
  EXPECT_LT(count(pictures[113], place, white), place.area() / 10) << "90.4 s, recognised at 90 s";
}

TEST_F(JourneyVideo, NamesTheProgramThatIsMissing) {
  ASSERT_EQ(call("run --recording recording --out result --video drive.mp4",
                 "mkdir bin && ln -s \"$(command -v gnuplot)\" bin/gnuplot && PATH=$PWD/bin"),
            3);
  EXPECT_THAT(folder_.read("err.txt"), HasSubstr("ffmpeg is not installed"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "drive.mp4"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "result/report.html"));
}

}  // namespace
}  // namespace panvo::evaluation
