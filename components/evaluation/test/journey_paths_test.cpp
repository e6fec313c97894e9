// SPDX-License-Identifier: Apache-2.0
// Whole paths, azimuth episodes and times of a journey with known results.
#include <gtest/gtest.h>

#include "journey_fixture.hpp"
#include "panvo/evaluation/journey_evaluation.hpp"
#include "panvo/evaluation/paper_figures.hpp"

namespace panvo::evaluation {
namespace {

class Journey : public MadeJourney {
 protected:
  void SetUp() override {
    MadeJourney::SetUp();
    run_ = read_journey_run(folder_ / "run");
    recording_ = read_journey_recording(folder_ / "recording");
  }
  JourneyFrames frames() const { return journey_frames(run_, recording_, nullptr); }

  JourneyRun run_;
  JourneyRecording recording_;
};

TEST_F(Journey, HasTheErrorsOfBothPaths) {
  const auto paths = score_paths(frames());
  EXPECT_NEAR(paths.travelled_m, 100.0, 1e-6);
  EXPECT_NEAR(paths.duration_s, 100.0, 1e-6);
  EXPECT_NEAR(paths.binocular.final_m, 2.0, 1e-6);
  EXPECT_NEAR(paths.enhanced.final_m, 0.25, 1e-6);
  EXPECT_NEAR(paths.enhanced.worst_m, 1.78, 1e-6);
  EXPECT_NEAR(paths.enhanced.worst_at_m, 89.0, 1e-6);
  // 0.02 m times the integers up to 100
  EXPECT_NEAR(paths.binocular.flat_m.rmse, 0.02 * std::sqrt(100.0 * 101.0 * 201.0 / 6.0 / 101.0), 1e-6);
  EXPECT_NEAR(paths.binocular.ate_m.rmse, paths.binocular.flat_m.rmse, 1e-9);
  const double squares = 0.0004 * 89.0 * 90.0 * 179.0 / 6.0 + 11.0 * 0.0625;
  EXPECT_NEAR(paths.enhanced.flat_m.rmse, std::sqrt(squares / 101.0), 1e-6);
  EXPECT_NEAR(paths.ratio, paths.enhanced.flat_m.rmse / paths.binocular.flat_m.rmse, 1e-12);
  EXPECT_NEAR(paths.enhanced.percent_of_way, paths.enhanced.flat_m.rmse, 1e-6) << "of 100 m";
  EXPECT_LT(paths.binocular.ate_se3_m->rmse, paths.binocular.ate_m.rmse);
}

TEST_F(Journey, IsScoredFromWhereItWasLocated) {
  run_.states = {{stamp(0), "unlocated", "", {}, {}}, {stamp(41), "relocalised", "", {}, {}}};
  const auto paths = score_paths(frames());
  EXPECT_NEAR(paths.unlocated_m, 41.0, 1e-6);
  ASSERT_EQ(paths.enhanced.errors.size(), 60U);
  EXPECT_NEAR(paths.enhanced.errors.front().distance_m, 41.0, 1e-6);
  EXPECT_EQ(paths.binocular.errors.size(), 101U);
  run_.states.resize(1);
  EXPECT_NE(input_error_of([&] { score_paths(frames()); }), "");
}

TEST_F(Journey, HasTheConsistencyOfThePublishedPose) {
  const auto nees = score_paths(frames()).consistency;
  ASSERT_TRUE(nees);
  // Errors of one standard deviation to the left and in heading up to 89 s, then only to the left. No covariance at 0
  // s.
  EXPECT_NEAR(nees->plane.mean, (89.0 * 2.0 + 11.0) / 100.0, 1e-4);
  EXPECT_NEAR(nees->full.mean, (89.0 * 2.0 + 11.0) / 100.0, 1e-4);
  EXPECT_EQ(nees->plane.dimension, 3);
  EXPECT_EQ(nees->plane.samples, 100U);
  EXPECT_EQ(nees->unusable, 1U);
  EXPECT_NEAR(nees->plane.inside_95, 1.0, 1e-12);
}

TEST_F(Journey, HasTheAzimuthGainedThroughEpisodes) {
  const auto azimuth = score_azimuth(frames());
  ASSERT_EQ(azimuth.episodes.size(), 2U) << "two movers at one time are one episode";
  const auto& unreliable = azimuth.episodes[0];
  EXPECT_EQ(unreliable.kind, "unreliable");
  EXPECT_EQ(unreliable.from_ns, stamp(40));
  EXPECT_EQ(unreliable.to_ns, stamp(45));
  EXPECT_NEAR(*unreliable.binocular_rad, 5.0 * kTurn, 1e-6);
  EXPECT_NEAR(*unreliable.compass_rad, 0.005, 1e-6);
  const auto& movers = azimuth.episodes[1];
  EXPECT_EQ(movers.kind, "movers");
  EXPECT_EQ(movers.to_ns, stamp(30));
  EXPECT_NEAR(*movers.binocular_rad, 10.0 * kTurn, 1e-6);
  EXPECT_NEAR(*movers.enhanced_rad, 10.0 * kTurn, 1e-6);
  EXPECT_NEAR(*movers.compass_rad, 0.01, 1e-6);
  EXPECT_NEAR(movers.compass_share, 1.0, 1e-9);
  ASSERT_EQ(azimuth.kinds.size(), 2U);
  EXPECT_EQ(azimuth.kinds[0].kind, "movers");
  EXPECT_NEAR(*azimuth.kinds[0].compass_rms_rad, 0.01, 1e-6);

  const auto curve = worst_episode(frames(), azimuth);
  ASSERT_TRUE(curve);
  EXPECT_EQ(curve->episode.kind, "movers");
  EXPECT_NEAR(curve->compass.back().time_s, 13.0, 1e-9) << "three seconds on";
  EXPECT_NEAR(curve->binocular.front().error_rad, -3.0 * kTurn, 1e-6);
}

TEST_F(Journey, LeavesOutWhatTheCompassDidNotTell) {
  recording_.disturbances = {{stamp(55), stamp(65), "fog"}};
  run_.qualities.clear();
  const auto azimuth = score_azimuth(frames());
  ASSERT_EQ(azimuth.episodes.size(), 1U);
  EXPECT_NEAR(*azimuth.episodes[0].compass_rad, 0.009, 1e-6) << "one of ten is not valid";
  EXPECT_NEAR(azimuth.episodes[0].compass_share, 0.9, 1e-9);
  run_.azimuths.clear();
  EXPECT_FALSE(score_azimuth(frames()).episodes[0].compass_rad);
}

TEST_F(Journey, DrawsTheCompassWithTheTurnsThatItDidNotReport) {
  recording_.disturbances = {{stamp(45), stamp(55), "fog"}};
  run_.qualities.clear();
  std::erase_if(run_.azimuths,
                [](const auto& azimuth) { return azimuth.stamp_ns == stamp(50); });  // the vehicle turns back
  const auto curve = worst_episode(frames(), score_azimuth(frames()));
  ASSERT_TRUE(curve);
  EXPECT_NEAR(curve->compass[3].time_s, 4.0, 1e-9);
  EXPECT_NEAR(curve->compass[3].azimuth_rad, 0.004, 1e-6);
  EXPECT_NEAR(curve->compass[4].time_s, 6.0, 1e-9);
  EXPECT_NEAR(std::abs(curve->compass[4].azimuth_rad), std::numbers::pi, 0.006);
  EXPECT_NEAR(curve->compass[4].error_rad, 0.005, 1e-6);
}

TEST_F(Journey, HasTheTimesBesideThePapers) {
  const auto rows = stage_rows(run_.times);
  ASSERT_EQ(rows.size(), paper::table_3().size());
  EXPECT_EQ(rows[0].item, "Landmark detection");
  EXPECT_EQ(rows[0].paper_ms, 70.0);
  EXPECT_EQ(rows[0].ours->wall.median_ms, 7.5);
  EXPECT_EQ(rows[8].item, "Panoramic compass");
  EXPECT_EQ(rows[8].paper_ms, 100.0);
  EXPECT_FALSE(rows[8].ours);
}

TEST(Paper, HasTheTablesAsPrinted) {
  ASSERT_EQ(paper::table_2().size(), 8U);
  ASSERT_EQ(paper::table_4().size(), 14U);
  double reduced = 0;
  for (const auto& row : paper::table_2()) reduced += row.binocular_m.value_or(0) - row.enhanced_m.value_or(0);
  EXPECT_NEAR(reduced, 138.4 - 21.0, 1e-9);
  double time_ms = 0;
  for (const auto& stage : paper::table_3()) time_ms += stage.time_ms;
  EXPECT_NEAR(time_ms, 493.0, 1e-9);
}

}  // namespace
}  // namespace panvo::evaluation
