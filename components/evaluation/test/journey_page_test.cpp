// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/journey_page.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <nlohmann/json.hpp>

#include "html_sections.hpp"
#include "html_text.hpp"
#include "journey_fixture.hpp"
#include "panorama_pair.hpp"

namespace panvo::evaluation {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class JourneyPage : public MadeJourney {
 protected:
  std::string page(const std::string& title = "street") const {
    const auto run = read_journey_run(folder_ / "run");
    const auto recording = read_journey_recording(folder_ / "recording");
    const JourneyReport report{title, evaluate_run(run, recording, nullptr), {}, false};
    return journey_page(report);
  }
  int call(const std::string& arguments, const std::string& before = "") const {
    const std::string command = "cd '" + folder_.path().string() + "' && " + before + " " PANVO_EVALUATE_JOURNEY " " +
                                arguments + " > out.txt 2> err.txt < /dev/null";
    return WEXITSTATUS(std::system(command.c_str()));
  }
};

TEST_F(JourneyPage, NeedsNothingBesideItself) {
  const auto text = page();
  for (const char* reference : {"http:", "https:", "src=", "url(", "@import", "<script", "<link", "file:"}) {
    EXPECT_THAT(text, Not(HasSubstr(reference)));
  }
  for (std::size_t at = text.find("href="); at != std::string::npos; at = text.find("href=", at + 1)) {
    EXPECT_EQ(text.substr(at, 28), "href=\"data:image/jpeg;base64");
  }
  EXPECT_THAT(text, HasSubstr("prefers-color-scheme: dark"));
  EXPECT_THAT(text, HasSubstr("@media print"));
}

TEST_F(JourneyPage, ShowsEveryRevisitWithBothPanoramas) {
  const auto text = page();
  EXPECT_THAT(text, HasSubstr("id=\"revisit-1\""));
  EXPECT_THAT(text, Not(HasSubstr("id=\"revisit-2\"")));
  std::size_t pictures = 0;
  for (std::size_t at = text.find("data:image"); at != std::string::npos; at = text.find("data:image", at + 1))
    ++pictures;
  EXPECT_EQ(pictures, 2U);
  EXPECT_THAT(text, HasSubstr("<b>1.80 m &rarr; 0.25 m</b>"));
  EXPECT_THAT(text, HasSubstr("100 m in 100 s"));
  EXPECT_THAT(text, HasSubstr("landmark_store.file = kept.sqlite"));
}

TEST_F(JourneyPage, PutsThePapersOwnCorrectionBeside) {
  const auto run = read_journey_run(folder_ / "run");
  const auto recording = read_journey_recording(folder_ / "recording");
  auto papers = run;
  papers.outcomes.clear();
  JourneyReport report{"street", evaluate_run(run, recording, nullptr), {}, false};
  report.paper_run.emplace(evaluate_run(papers, recording, nullptr));
  const auto compared = side_by_side(report);
  ASSERT_EQ(compared.size(), 1U);
  EXPECT_EQ(compared[0].ours->result, RevisitResult::kCorrected);
  EXPECT_EQ(compared[0].papers->result, RevisitResult::kMissed);
  EXPECT_THAT(journey_page(report), HasSubstr("side by side"));
}

TEST_F(JourneyPage, CountsListedRevisitsAndOtherPlacesApart) {
  EXPECT_THAT(
      page(),
      HasSubstr("<b>1 of 1</b><small>listed revisits corrected the pose; 0 given up, 0 rejected, 0 missed</small>"));
  RevisitScore score;
  score.elsewhere = 1;
  EXPECT_EQ(elsewhere_words(score), "; 1 recognised at a place that the recording does not list");
  score.elsewhere = 2;
  EXPECT_EQ(elsewhere_words(score), "; 2 recognised at places that the recording does not list");
}

TEST_F(JourneyPage, CanBeReadOnAPhone) {
  auto text = page();
  const std::string start = "@media (max-width: 640px) {";
  text.erase(0, text.find(start));
  const auto number_after = [&](const std::string& rule) {
    const auto at = text.find(rule);
    return at == std::string::npos ? 0.0 : std::stod(text.substr(at + rule.size()));
  };
  constexpr double kChart_px = 1060.0, kPhone_px = 316.0,
                   kReadable_px = 11.0;  // widths: of the viewBox, and of a figure's inside
  EXPECT_GE(number_after("figure svg .small { font-size: ") * number_after("figure svg { min-width: ") / kChart_px,
            kReadable_px);
  EXPECT_EQ(number_after(".plan svg { min-width: "), 0.0);
  EXPECT_GE(number_after("figure.plan svg .small { font-size: ") * kPhone_px / kChart_px, kReadable_px);
}

TEST_F(JourneyPage, IsTheSameEveryTime) { EXPECT_EQ(page(), page()); }

TEST_F(JourneyPage, SaysWhatItWasGivenAndNoMarkup) {
  const auto text = page("<img onerror=\"x\">");
  EXPECT_THAT(text, Not(HasSubstr("<img")));
  EXPECT_THAT(text, HasSubstr("&lt;img onerror=&quot;x&quot;&gt;"));
  EXPECT_THAT(text, HasSubstr("corner &lt;7&gt;"));
}

TEST_F(JourneyPage, DoesWithoutPicturesWhereThereAreNone) {
  std::filesystem::remove_all(folder_ / "recording/mav0/cam2");
  EXPECT_THAT(page(), HasSubstr("No panoramas of both visits in the recording."));
}

TEST_F(JourneyPage, NamesThePictureThatCannotBeDecoded) {
  folder_.write("recording/mav0/cam2/data/" + std::to_string(stamp(90)) + ".png", "no picture");
  EXPECT_THAT(input_error_of([&] { page(); }), HasSubstr(std::to_string(stamp(90)) + ".png: cannot be decoded"));
}

TEST_F(JourneyPage, AlignsPanoramasByTheHeading) {
  // The view 90 degrees to the right is now ahead: the vehicle turned right by 90 degrees.
  const auto folder = folder_ / "pair";
  std::filesystem::create_directories(folder);
  cv::Mat then(540, 1080, CV_8UC3), now;
  cv::RNG(5).fill(then, cv::RNG::UNIFORM, 0, 255);
  cv::hconcat(then.colRange(270, 1080), then.colRange(0, 270), now);
  cv::imwrite((folder / "then.png").string(), then);
  cv::imwrite((folder / "now.png").string(), now);
  const auto pair = panorama_pair(folder / "then.png", folder / "now.png", -std::numbers::pi / 2.0);
  EXPECT_EQ(pair.columns, 1080);
  EXPECT_EQ(pair.landmark_jpeg, pair.revisit_jpeg);
  ASSERT_GT(pair.inliers.size(), 20U);
  for (const auto& match : pair.inliers) EXPECT_LT((match.landmark_px - match.revisit_px).norm(), 3.0);
}

TEST_F(JourneyPage, LeavesPanoramasOfOneHeadingAsTheyAre) {
  const auto image = folder_ / "recording/mav0/cam2/data" / (std::to_string(stamp(10)) + ".png");
  const auto pair = panorama_pair(image, image, 1e-4);
  EXPECT_EQ(pair.landmark_jpeg, pair.revisit_jpeg);
}

TEST_F(JourneyPage, IsWrittenByTheProgram) {
  ASSERT_EQ(call("run --recording recording --out result", "PATH=/nonexistent"), 3) << folder_.read("err.txt");
  EXPECT_THAT(folder_.read("err.txt"), HasSubstr("gnuplot"));
  EXPECT_THAT(folder_.read("result/report.html"), HasSubstr("</html>"));
  const auto json = nlohmann::json::parse(folder_.read("result/journey.json"));
  EXPECT_NEAR(json["run"]["revisits"]["rows"][0]["after_m"], 0.25, 1e-6);
  EXPECT_NEAR(json["run"]["paths"]["binocular"]["final_m"], 2.0, 1e-6);
  EXPECT_THAT(folder_.read("out.txt"), HasSubstr("1 corrected"));
}

TEST_F(JourneyPage, IsNotWrittenWhereOnlyTheTableIsWanted) {
  ASSERT_EQ(call("run --recording recording --only-table --paper-run run"), 0) << folder_.read("err.txt");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "run/report.html"));
  EXPECT_THAT(folder_.read("out.txt"), HasSubstr("7 corner <7>  corrected    1.80   0.25    corrected    1.80   0.25"));
}

TEST_F(JourneyPage, FailsNamingWhatIsAtFault) {
  EXPECT_EQ(call("run"), 1);
  EXPECT_THAT(folder_.read("err.txt"), HasSubstr("holds no ground truth"));
  EXPECT_EQ(call("nowhere --recording recording"), 1);
  EXPECT_EQ(call("--recording recording"), 2);
}

TEST(Base64, IsThatOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace panvo::evaluation
