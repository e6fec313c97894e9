// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/drive_page.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "drive_rows.hpp"
#include "journey_fixture.hpp"
#include "panvo/evaluation/input_error.hpp"

namespace panvo::evaluation {
namespace {

using ::testing::DoubleNear;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;
using Json = nlohmann::ordered_json;

class DrivePage : public MadeJourney {
 protected:
  void SetUp() override {
    MadeJourney::SetUp();
    write_matches(fmt::format("{},matched,3,180,0.1,0.2,0.3,1,1,1,\"\"\n", stamp(90)));
    folder_.write("page/index.html",
                  "<html><link rel=\"icon\" href=\"icon.svg\"><link rel=\"manifest\" href=\"m\">\n"
                  "<link rel=\"stylesheet\" href=\"style.css\"><body><p>map</p><script src=\"page.js\" defer></script>"
                  "</body></html>\n");
    folder_.write("page/style.css", "p { color: red }");
    folder_.write("page/page.js", "say('</script>');");
  }

  std::string page(const std::string& title = "street") const {
    const auto run = read_journey_run(folder_ / "run");
    const auto recording = read_journey_recording(folder_ / "recording");
    const JourneyReport report{title, evaluate_run(run, recording, nullptr), {}, false};
    return drive_page(report, folder_ / "page");
  }

  static Json drive_in(const std::string& page) {
    const std::string begin = "id=\"recorded-drive\">";
    const std::size_t from = page.find(begin) + begin.size();
    return Json::parse(page.substr(from, page.find("</script>", from) - from));
  }

  static cv::Mat picture_in(const Json& base64_jpeg) {
    const auto text = base64_jpeg.get<std::string>();
    const auto value = [](char letter) {
      static const std::string kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
      return static_cast<unsigned>(kLetters.find(letter));
    };
    std::vector<unsigned char> bytes;
    for (std::size_t i = 0; i + 3 < text.size(); i += 4) {
      const unsigned bits = value(text[i]) << 18U | value(text[i + 1]) << 12U | (value(text[i + 2]) & 63U) << 6U |
                            (value(text[i + 3]) & 63U);
      for (const unsigned shift : {16U, 8U, 0U}) bytes.push_back(static_cast<unsigned char>(bits >> shift));
    }
    return cv::imdecode(bytes, cv::IMREAD_COLOR);
  }
};

TEST_F(DrivePage, IsOneFileWithScriptStyleAndDrive) {
  const auto text = page("</script><b>");
  EXPECT_THAT(text, HasSubstr("<style>p { color: red }</style><body><p>map</p>"));
  EXPECT_THAT(text, HasSubstr("<script>say('<\\/script>');</script></body>"));
  const auto drive = drive_in(text);
  EXPECT_EQ(drive["title"], "</script><b>");
  const std::size_t data = text.find("recorded-drive\">");
  for (const auto& part : {text.substr(0, data), text.substr(text.find("</script>", data))}) {
    for (const char* reference : {"src=", "href=", "<link"}) EXPECT_THAT(part, Not(HasSubstr(reference)));
  }
}

TEST_F(DrivePage, HasThePosesInTheMapWithTheirTimes) {
  const auto drive = drive_in(page());
  for (const char* path : {"enhanced", "binocular", "truth"}) ASSERT_EQ(drive[path].size(), kSeconds + 1U) << path;
  const auto row = [&](const char* path, std::size_t second) { return drive[path][second].get<std::vector<double>>(); };
  EXPECT_THAT(row("truth", 20), testing::Pointwise(testing::DoubleNear(2e-4), {20.0, 20.0, 0.0, 0.0}));
  EXPECT_THAT(row("binocular", 20), testing::Pointwise(testing::DoubleNear(2e-4), {20.0, 20.0, 0.4, 0.01}));
  // Covariance as in the fixture; the speed is that of the odometry, along and across.
  EXPECT_THAT(row("enhanced", 95),
              testing::Pointwise(testing::DoubleNear(2e-4),
                                 {95.0, 5.0, 0.25, std::numbers::pi, 1.0, 0.0, 0.0625, std::hypot(1.0, kDrift)}));
}

TEST_F(DrivePage, HasTheTruthAtTheTimesOfThePosesThoughItsOwnAreOthers) {
  auto recording = read_journey_recording(folder_ / "recording");
  const auto frames = evaluate_run(read_journey_run(folder_ / "run"), recording, nullptr).frames;
  std::vector<StampedPose> between;
  for (int second = 0; second < kSeconds; ++second) {
    const auto stamp_ns = stamp(second) + 500'000'000;
    between.push_back({stamp_ns, pose_at(recording.truth.poses, stamp_ns).value()});
  }
  recording.truth.poses = between;
  const auto drive = drive_rows(frames);
  ASSERT_EQ(drive["truth"].size(), kSeconds - 1U) << "those between two of the truth";
  EXPECT_THAT(drive["truth"][19].get<std::vector<double>>(),
              testing::Pointwise(testing::DoubleNear(2e-4), {20.0, 20.0, 0.0, 0.0}));
}

TEST(DriveRows, HaveBothPathsOfALongDriveAndWhatLastsForOnePose) {
  constexpr std::size_t kPoses = 30'000, kLost = 12'345;
  const JourneyRecording recording;
  JourneyFrames frames{.run = {}, .recording = recording};
  for (std::size_t i = 0; i < kPoses; ++i) {
    const auto stamp_ns = 100'000'000 * static_cast<std::int64_t>(i);
    frames.run.enhanced.poses.push_back({stamp_ns, Eigen::Isometry3d::Identity()});
    frames.run.binocular.poses.push_back({stamp_ns + 50'000'000, Eigen::Isometry3d::Identity()});
    RunQuality quality;
    quality.stamp_ns = stamp_ns + 50'000'000;
    quality.reliable = i != kLost;
    frames.run.qualities.push_back(quality);
    RunIntegrity integrity;
    integrity.stamp_ns = stamp_ns;
    integrity.usable = i != kLost;
    frames.run.integrity.push_back(integrity);
  }
  const auto drive = drive_rows(frames);
  EXPECT_EQ(drive["enhanced"].size(), kPoses / 2);
  EXPECT_EQ(drive["binocular"].size(), kPoses / 2);
  for (const char* judged : {"quality", "integrity"}) {
    const auto bad = std::ranges::count_if(drive[judged], [](const Json& row) { return row[1] == false; });
    EXPECT_EQ(bad, 1) << judged;
    EXPECT_EQ(drive[judged].size(), kPoses / 2 + 1) << judged << ": the one, and every second";
  }
}

TEST_F(DrivePage, ReplacesWhatIsNotUtf8) {
  EXPECT_EQ(drive_in(page("stra\xdf"
                          "e"))["title"],
            "stra\xef\xbf\xbd"
            "e");
}

TEST_F(DrivePage, HasPlacesSightingsStatesAndTurns) {
  const auto drive = drive_in(page());
  ASSERT_EQ(drive["places"].size(), 1U);
  EXPECT_EQ(drive["places"][0]["id"], 3);
  EXPECT_EQ(drive["places"][0]["time"], 10.0);
  EXPECT_EQ(drive["places"][0]["junction"], true);
  EXPECT_EQ(picture_in(drive["places"][0]["thumbnail"]).size(), cv::Size(360, 180));
  ASSERT_EQ(drive["outcomes"].size(), 1U);
  EXPECT_EQ(drive["outcomes"][0][2], "applied");
  EXPECT_THAT(drive["outcomes"][0][4][1].get<double>(), DoubleNear(1.8, 1e-3)) << "before";
  EXPECT_THAT(drive["outcomes"][0][5][1].get<double>(), DoubleNear(0.25, 1e-3)) << "after";
  EXPECT_EQ(drive["matches"].size(), 1U);
  EXPECT_EQ(drive["states"][1], (Json{41.0, "compass_only", "few features, \"all\" moving", 0.2, nullptr}));
  EXPECT_EQ(drive["azimuth"].size(), kSeconds - 1U) << "one of them is invalid";
  EXPECT_EQ(drive["quality"][40], (Json{41.0, false, 9, 9}));
  EXPECT_EQ(drive["integrity"][1], (Json{1.0, false, "lost", 0.001, nullptr, 2.0}));
}

TEST_F(DrivePage, HasTheWholeReport) {
  const auto report = drive_in(page("</script><b>"))["report"].get<std::string>();
  EXPECT_THAT(report, HasSubstr("&lt;/script&gt;&lt;b&gt;"));
  EXPECT_THAT(report, HasSubstr("<h2>Results</h2>"));
  EXPECT_THAT(report, testing::EndsWith("</html>\n"));
}

TEST_F(DrivePage, HasPicturesOfTheRecordingWhereThereAreSome) {
  const auto drive = drive_in(page());
  EXPECT_TRUE(drive["pictures"]["left"].empty());
  ASSERT_EQ(drive["pictures"]["panorama"].size(), 2U);
  EXPECT_EQ(drive["pictures"]["panorama"][1][0], 90.0);
  EXPECT_EQ(picture_in(drive["pictures"]["panorama"][1][1]).size(), cv::Size(900, 450));
  EXPECT_THAT(drive["panoramaYaw"].get<double>(), DoubleNear(0.0, 1e-9));
}

TEST_F(DrivePage, NamesAPageOfAnotherVersion) {
  folder_.write("page/index.html", "<html></html>\n");
  EXPECT_THAT([&] { page(); }, ThrowsMessage<InputError>(HasSubstr("build panvo again")));
}

}  // namespace
}  // namespace panvo::evaluation
