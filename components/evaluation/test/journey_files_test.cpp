// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "journey_fixture.hpp"
#include "panvo/evaluation/journey_recording.hpp"
#include "panvo/evaluation/journey_revisits.hpp"
#include "panvo/evaluation/journey_run.hpp"

namespace panvo::evaluation {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class JourneyFiles : public MadeJourney {
 protected:
  std::string run_error() const {
    return input_error_of([&] { read_journey_run(folder_ / "run"); });
  }
  std::string recording_error() const {
    return input_error_of([&] { read_journey_recording(folder_ / "recording"); });
  }
};

TEST_F(JourneyFiles, AreReadWithTheirQuotes) {
  const auto run = read_journey_run(folder_ / "run");
  EXPECT_TRUE(run.missing.empty());
  ASSERT_EQ(run.states.size(), 2U);
  EXPECT_EQ(run.states[1].reason, "few features, \"all\" moving");
  EXPECT_FALSE(run.states[1].heading_sigma_rad);
  EXPECT_EQ(run.facts->system, "enhanced_vo.yaml");
  ASSERT_EQ(run.facts->changed_parameters.size(), 1U);
  EXPECT_EQ(run.facts->changed_parameters[0].first, "landmark_store.file");
  EXPECT_EQ(run.azimuths.size(), 100U);
}

TEST_F(JourneyFiles, OfSightingsAreNotMissingWhereThereWasNone) {
  for (const char* name : {"corrections.csv", "outcomes.csv"}) std::filesystem::remove(folder_ / "run" / name);
  EXPECT_THAT(read_journey_run(folder_ / "run").missing, IsEmpty());
  write_matches(fmt::format("{},matched,1,0,,,,1,0,0,\n", stamp(1)));
  EXPECT_THAT(read_journey_run(folder_ / "run").missing, ElementsAre("corrections.csv", "outcomes.csv"));
}

TEST_F(JourneyFiles, ThatAreMissingAreNamed) {
  write_matches(fmt::format("{},matched,1,0,,,,1,0,0,\n", stamp(1)));
  for (const char* name : {"outcomes.csv", "timing.json", "summary.json", "odometry_enhanced_covariance.csv"}) {
    std::filesystem::remove(folder_ / "run" / name);
  }
  EXPECT_THAT(read_journey_run(folder_ / "run").missing,
              ElementsAre("odometry_enhanced_covariance.csv", "outcomes.csv", "timing.json", "summary.json"));
  std::filesystem::remove(folder_ / "run/odometry_enhanced.tum");
  EXPECT_THAT(run_error(), AllOf(HasSubstr("odometry_enhanced.tum: not found"), HasSubstr("panvo run enhanced_vo")));
  EXPECT_THAT(input_error_of([&] { read_journey_run(folder_ / "nowhere"); }), HasSubstr("nowhere: is not a folder"));
}

TEST_F(JourneyFiles, ThatAreEmptyOrCutOffAreRefusedByLine) {
  folder_.write("run/outcomes.csv", "");
  EXPECT_THAT(run_error(), AllOf(HasSubstr("outcomes.csv: is empty"), HasSubstr("run again")));
  write_outcomes(outcome(90, "applied", binocular(90), enhanced(90)) + "1700000091000000000,3,app");
  EXPECT_THAT(run_error(), AllOf(HasSubstr("outcomes.csv:3: does not have the header's 19 fields"),
                                 HasSubstr("remove the line, or run again")));
  write_outcomes("");
  write_matches(fmt::format("{},searching,0,,,,,1,0,0,\"nothing li", stamp(1)));
  EXPECT_THAT(run_error(), HasSubstr("matches.csv:2: does not have the header's 11 fields"));
  write_matches(fmt::format("{},searching,none,,,,,1,0,0,\"\"\n", stamp(1)));
  EXPECT_THAT(run_error(), HasSubstr("matches.csv:2: 'none' is not a whole number"));
  write_matches("");
  folder_.write("run/azimuth.csv", "stamp_ns,from_stamp_ns,valid\n");
  EXPECT_THAT(run_error(), HasSubstr("azimuth.csv:1: has no column 'azimuth_change_rad'"));
  std::filesystem::remove(folder_ / "run/azimuth.csv");
  folder_.write("run/summary.json", "{\"version\": ");
  EXPECT_THAT(run_error(), HasSubstr("summary.json: is not valid JSON"));
  folder_.write("run/odometry_binocular.tum", "");
  EXPECT_THAT(run_error(), HasSubstr("odometry_binocular.tum: is empty"));
}

TEST_F(JourneyFiles, OfTheRecordingSayWhatThePanoramasClockIsAhead) {
  EXPECT_EQ(read_journey_recording(folder_ / "recording").panoramas.at(0).stamp_ns, stamp(10));
  folder_.write("recording/sequence.yaml", "panorama_clock_offset_ns: -20000000\n");
  const auto recording = read_journey_recording(folder_ / "recording");
  EXPECT_EQ(recording.panorama_clock_offset_ns, -20'000'000);
  EXPECT_EQ(recording.panoramas.at(0).stamp_ns, stamp(10) + 20'000'000);
  folder_.write("recording/sequence.yaml", "seed: 4\npanorama_clock_offset_ns: late\n");
  EXPECT_THAT(recording_error(), AllOf(HasSubstr("sequence.yaml:2:"), HasSubstr("a whole number of nanoseconds")));
}

TEST_F(JourneyFiles, OfTheRecordingKeepTheStampsOfItsPanoramasForTheirOwnScores) {
  folder_.write("recording/sequence.yaml", "panorama_clock_offset_ns: -20000000\n");
  const auto panoramas = panoramas_as_stamped(read_journey_recording(folder_ / "recording"), 500'000'000);
  ASSERT_EQ(panoramas.size(), 2U);
  EXPECT_EQ(panoramas[0].stamp_ns, stamp(10));
  EXPECT_TRUE(panoramas[0].world_from_base.isApprox(world_from_map() * make_pose(10.5, 0.0, 0.0), 1e-9));
  folder_.write("recording/mav0/cam2/data.csv", fmt::format("{},{}.png\n", stamp(kSeconds + 1), stamp(10)));
  EXPECT_THAT(input_error_of([&] { panoramas_as_stamped(read_journey_recording(folder_ / "recording")); }),
              HasSubstr("no panorama covered by the ground truth"));
}

TEST_F(JourneyFiles, OfTheRecordingAreRefusedByLine) {
  folder_.write("recording/sequence.yaml", "visits:\n  - {id: 7, t_ns: 1800000000000000000}\n");
  EXPECT_THAT(recording_error(), HasSubstr("sequence.yaml:2: a visit is outside the time span"));
  folder_.write("recording/sequence.yaml", "visits:\n  - {id: seven, t_ns: 3}\n");
  EXPECT_THAT(recording_error(), AllOf(HasSubstr("sequence.yaml:2:"), HasSubstr("a visit needs an id and t_ns")));
  folder_.write("recording/sequence.yaml", "movers:\n  - {from_ns: 5}\n");
  EXPECT_THAT(recording_error(), HasSubstr("an interval needs from_ns and to_ns"));
  std::filesystem::remove(folder_ / "recording/mav0/state_groundtruth_estimate0/data.csv");
  EXPECT_THAT(recording_error(), AllOf(HasSubstr("holds no ground truth"), HasSubstr("--recording")));
}

TEST_F(JourneyFiles, OfARunAreTruthEnoughWhereItLeftSome) {
  EXPECT_THAT(input_error_of([&] { read_journey_recording(folder_ / "run"); }), HasSubstr("holds no ground truth"));
  std::string truth;
  for (int s = 0; s <= kSeconds; ++s) {
    truth += fmt::format("{}.000000000", stamp(s) / 1'000'000'000) + numbers_of(map_from_base(s), " ") + "\n";
  }
  folder_.write("run/ground_truth.tum", truth);
  const auto run = read_journey_run(folder_ / "run");
  const auto recording = read_journey_recording(folder_ / "run");
  EXPECT_TRUE(recording.visits.empty());
  EXPECT_EQ(score_revisits(journey_frames(run, recording, nullptr)).applied.size(), 1U);
}

TEST_F(JourneyFiles, OfAnotherClockDoNotMeet) {
  const auto run = read_journey_run(folder_ / "run");
  auto recording = read_journey_recording(folder_ / "recording");
  for (auto& pose : recording.truth.poses) pose.stamp_ns -= 1'000'000'000'000'000'000;
  EXPECT_NE(input_error_of([&] { journey_frames(run, recording, nullptr); }), "");
}

}  // namespace
}  // namespace panvo::evaluation
