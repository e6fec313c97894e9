// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/journey_revisits.hpp"

#include <gmock/gmock.h>

#include "journey_fixture.hpp"
#include "panvo/evaluation/journey_evaluation.hpp"

namespace panvo::evaluation {
namespace {

using ::testing::HasSubstr;

class JourneyRevisits : public MadeJourney {
 protected:
  RevisitScore score() const {
    const auto run = read_journey_run(folder_ / "run");
    const auto recording = read_journey_recording(folder_ / "recording");
    return score_revisits(journey_frames(run, recording, nullptr));
  }
};

TEST_F(JourneyRevisits, SayWhatACorrectionDidToTheError) {
  const auto found = score();
  ASSERT_EQ(found.revisits.size(), 1U);
  const auto& revisit = found.revisits[0];
  EXPECT_EQ(revisit.result, RevisitResult::kCorrected);
  EXPECT_EQ(revisit.place, 7);
  EXPECT_EQ(revisit.name, "corner <7>");
  EXPECT_EQ(revisit.route, "7-7");
  EXPECT_EQ(revisit.landmark, 3);
  EXPECT_NEAR(std::abs(revisit.entrance_rad), std::numbers::pi, 1e-9);
  EXPECT_NEAR(*revisit.binocular_m, 1.8, 1e-6);
  EXPECT_NEAR(*revisit.before_m, 1.8, 1e-6);
  EXPECT_NEAR(*revisit.after_m, 0.25, 1e-6);
  EXPECT_NEAR(*revisit.before_heading_rad, 0.045, 1e-6);
  EXPECT_NEAR(*revisit.after_heading_rad, 0.0, 1e-6);
  EXPECT_NEAR(*revisit.landmark_m, 0.2, 1e-6);
  EXPECT_NEAR(*revisit.landmark_heading_rad, 0.005, 1e-6);
  EXPECT_NEAR(*revisit.beyond_m, 0.05, 1e-6);
  EXPECT_NEAR(revisit.travelled_m, 90.0, 1e-6);
  EXPECT_NEAR(revisit.distance_m, 0.0, 1e-6);
  EXPECT_FALSE(revisit.is_wrong);
  EXPECT_EQ(found.listed, 1);
  EXPECT_EQ(found.corrected, 1);
  EXPECT_EQ(found.wrong, 0);
}

TEST_F(JourneyRevisits, AreComparedWithTheTruthOfWhenPanoramasWereTaken) {
  constexpr std::int64_t kAhead_ns = 2'000'000'000;
  auto run = read_journey_run(folder_ / "run");
  for (auto& landmark : run.landmarks) landmark.stamp_ns += kAhead_ns;
  for (auto& outcome : run.outcomes) outcome.stamp_ns += kAhead_ns;
  for (auto& azimuth : run.azimuths) {
    azimuth.stamp_ns += kAhead_ns;
    azimuth.from_ns += kAhead_ns;
  }
  auto recording = read_journey_recording(folder_ / "recording");
  EXPECT_NEAR(*score_revisits(journey_frames(run, recording, nullptr)).revisits[0].after_m, 2.0, 0.1)
      << "compared two metres further on, because the clock offset is unknown";
  recording.panorama_clock_offset_ns = kAhead_ns;
  const auto frames = journey_frames(run, recording, nullptr);
  const auto found = score_revisits(frames);
  ASSERT_EQ(found.revisits.size(), 1U);
  const auto& revisit = found.revisits[0];
  EXPECT_EQ(revisit.stamp_ns, stamp(90));
  EXPECT_NEAR(*revisit.before_m, 1.8, 1e-6);
  EXPECT_NEAR(*revisit.after_m, 0.25, 1e-6);
  EXPECT_NEAR(*revisit.landmark_m, 0.2, 1e-6);
  EXPECT_NEAR(*revisit.landmark_heading_rad, 0.005, 1e-6);
  EXPECT_EQ(revisit.landmark_stamp_ns, stamp(10));
  const auto azimuth = score_azimuth(frames);
  ASSERT_FALSE(azimuth.episodes.empty());
  EXPECT_NEAR(*azimuth.episodes.back().compass_rad, 0.01, 1e-6) << "one milliradian in each of ten seconds";
}

TEST_F(JourneyRevisits, GoFromTheFirstOfSeveralCorrectionsToTheLast) {
  write_outcomes(outcome(88, "applied", off(88, 1.76, 0.04), off(88, 0.5, 0.01)) +
                 outcome(90, "applied", off(90, 0.52, 0.01), enhanced(90)));
  const auto found = score();
  ASSERT_EQ(found.revisits.size(), 1U);
  EXPECT_EQ(found.revisits[0].corrections, 2);
  EXPECT_NEAR(*found.revisits[0].before_m, 1.76, 1e-6);
  EXPECT_NEAR(*found.revisits[0].after_m, 0.25, 1e-6);
  EXPECT_EQ(found.applied.size(), 2U);
}

TEST_F(JourneyRevisits, CountACorrectionThatLeadsAway) {
  write_outcomes(outcome(90, "applied", binocular(90), off(90, 2.85, 0.0)));
  EXPECT_EQ(score().wrong, 1);
  EXPECT_TRUE(score().revisits[0].is_wrong);
  write_outcomes(outcome(90, "applied", binocular(90), off(90, 2.75, 0.0)));
  EXPECT_EQ(score().wrong, 0) << "error less than a metre larger than before";
}

TEST_F(JourneyRevisits, DoNotBlameACorrectionForItsLandmark) {
  const auto three_off = off(10, 3.0, 0.0);
  folder_.write("run/landmarks.csv",
                "stamp_ns,id,is_junction" + pose_columns("") + ",sigma_x_m,sigma_y_m,keypoints,points\n" +
                    fmt::format("{},3,1{},0.1,0.1,250,100\n", stamp(10), numbers_of(three_off, ",")));
  write_outcomes(outcome(90, "applied", binocular(90), off(90, 3.9, 0.0)));
  EXPECT_EQ(score().wrong, 0);
  write_outcomes(outcome(90, "applied", binocular(90), off(90, 4.1, 0.0)));
  EXPECT_EQ(score().wrong, 1);
}

TEST_F(JourneyRevisits, AreMissedInTheMatchersWords) {
  write_outcomes("");
  write_matches(
      fmt::format("{},searching,0,,,,,1,0,0,\"too far\"\n{},rejected,3,179,0.1,0.2,0.3,1,1,1,\"9 inliers, 12 "
                  "are needed\"\n{},searching,0,,,,,1,0,0,\"nothing\"\n",
                  stamp(30), stamp(89), stamp(90)));
  const auto found = score();
  EXPECT_EQ(found.missed, 1);
  EXPECT_EQ(found.revisits[0].result, RevisitResult::kMissed);
  EXPECT_EQ(found.revisits[0].reason, "rejected: 9 inliers, 12 are needed");
  EXPECT_NEAR(*found.revisits[0].before_m, 0.25, 1e-6) << "the published pose";
  EXPECT_FALSE(found.revisits[0].after_m);
}

TEST_F(JourneyRevisits, AreNotMissedByARunThatEndedBefore) {
  auto run = read_journey_run(folder_ / "run");
  run.enhanced.poses.resize(80);
  run.outcomes.clear();
  const auto recording = read_journey_recording(folder_ / "recording");
  const auto found = score_revisits(journey_frames(run, recording, nullptr));
  EXPECT_TRUE(found.revisits.empty());
  EXPECT_EQ(found.missed, 0);
  EXPECT_EQ(found.not_reached, 1);
}

TEST_F(JourneyRevisits, AreRejectedInTheCorrectorsWords) {
  write_outcomes("");
  write_corrections(
      fmt::format("{},3,rejected,4{},1,1,1,\"too few inliers\"\n", stamp(91), numbers_of(binocular(0), ",")));
  const auto found = score();
  EXPECT_EQ(found.rejected, 1);
  EXPECT_EQ(found.revisits[0].landmark, 3);
  EXPECT_EQ(found.revisits[0].reason, "too few inliers");
}

TEST_F(JourneyRevisits, AreGivenUpWhereThePoseIsKnownBetter) {
  write_outcomes(outcome(90, "better_known", binocular(90), binocular(90), "just corrected"));
  const auto found = score();
  EXPECT_EQ(found.given_up, 1);
  EXPECT_EQ(found.revisits[0].reason, "just corrected");
  EXPECT_TRUE(found.applied.empty());
}

TEST_F(JourneyRevisits, AreCorrectedInHeadingOnlyWhereTheCurveIsFlat) {
  write_corrections(
      fmt::format("{},3,rotation_only,40{},1e3,1e3,0.01,\"flat\"\n", stamp(90), numbers_of(binocular(0), ",")));
  EXPECT_EQ(score().heading_only, 1);
  EXPECT_EQ(score().corrected, 0);
}

TEST_F(JourneyRevisits, ComeFromTheOutcomesWhereNobodyListsThem) {
  std::filesystem::remove(folder_ / "recording/sequence.yaml");
  const auto found = score();
  ASSERT_EQ(found.revisits.size(), 1U);
  EXPECT_FALSE(found.revisits[0].place);
  EXPECT_EQ(found.elsewhere, 1);
  EXPECT_EQ(found.listed, 0);
  EXPECT_NEAR(std::abs(found.revisits[0].entrance_rad), std::numbers::pi, 1e-6);
  EXPECT_NEAR(*found.revisits[0].after_m, 0.25, 1e-6);
}

TEST_F(JourneyRevisits, OfASecondJourneyAreThoseOfTheFirst) {
  write_recording("earlier");
  const auto run = read_journey_run(folder_ / "run");
  const auto recording = read_journey_recording(folder_ / "recording");
  const auto earlier = read_journey_recording(folder_ / "earlier");
  const auto found = score_revisits(journey_frames(run, recording, &earlier));
  ASSERT_EQ(found.revisits.size(), 2U) << "the first pass of this journey is also a revisit";
  EXPECT_EQ(found.revisits[0].result, RevisitResult::kMissed);
  EXPECT_NEAR(found.revisits[0].entrance_rad, 0.0, 1e-9);
  EXPECT_TRUE(found.revisits[0].landmark_was_earlier);
  EXPECT_EQ(found.revisits[1].result, RevisitResult::kCorrected);
}

TEST_F(JourneyRevisits, TellLandmarksOfTwoJourneysApartThoughTheirClocksAreOne) {
  // The origin of the map is the start of the earlier journey, 30 m to the left. Its landmark 3 has the stamp of a pose
  // of this journey.
  write_recording("earlier", 30.0);
  auto run = read_journey_run(folder_ / "run");
  const auto in_map = make_pose(0.0, -30.0, 0.0);
  for (auto& pose : run.enhanced.poses) pose.world_from_base = in_map * pose.world_from_base;
  run.outcomes[0].map_from_base_before = in_map * run.outcomes[0].map_from_base_before;
  run.outcomes[0].map_from_base_after = in_map * run.outcomes[0].map_from_base_after;
  const auto recording = read_journey_recording(folder_ / "recording");
  const auto earlier = read_journey_recording(folder_ / "earlier");
  const auto found = score_revisits(journey_frames(run, recording, &earlier));
  ASSERT_EQ(found.revisits.size(), 2U);
  const auto& revisit = found.revisits[1];
  EXPECT_TRUE(revisit.landmark_was_earlier);
  EXPECT_NEAR(*revisit.landmark_m, 0.2, 1e-6);
  EXPECT_NEAR(*revisit.before_m, 1.8, 1e-6);
  EXPECT_NEAR(*revisit.after_m, 0.25, 1e-6);
  EXPECT_NEAR(revisit.distance_m, 30.0, 1e-6);
}

TEST_F(JourneyRevisits, NeedTheTruthOfTheSameClock) {
  auto later = outcome(90, "applied", binocular(90), enhanced(90));
  later.replace(0, 4, "1800");
  write_outcomes(later);
  EXPECT_THAT(input_error_of([&] { score(); }), HasSubstr("outcomes.csv:2: no stamp is within the time span"));
}

TEST_F(JourneyRevisits, AreTold) {
  const auto run = read_journey_run(folder_ / "run");
  const auto recording = read_journey_recording(folder_ / "recording");
  const JourneyReport report{"street", evaluate_run(run, recording, nullptr), {}, false};
  const auto table = journey_table(report);
  EXPECT_THAT(table, HasSubstr("1.80    1.80   0.25     +2.6  +0.0  0.20    0.05         90"));
  EXPECT_THAT(table, HasSubstr("1 revisits: 1 corrected, 0 in heading only"));
  EXPECT_THAT(table, HasSubstr("14-21-25-29-14")) << "the paper's table";
  EXPECT_THAT(table, HasSubstr("landmark_builder/junction     70    7.50  9.00  10.00      4"));
}

}  // namespace
}  // namespace panvo::evaluation
