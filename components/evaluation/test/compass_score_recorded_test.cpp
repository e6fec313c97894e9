// SPDX-License-Identifier: Apache-2.0
// Accuracy on recordings with exact ground truth.
#include <gtest/gtest.h>

#include <filesystem>

#include "panvo/evaluation/compass_score.hpp"
#include "panvo/evaluation/journey_recording.hpp"
#include "panvo/test/recorded_data.hpp"

namespace panvo::evaluation {
namespace {

using panvo::test::recorded_data;

CompassScore score_recorded(const std::filesystem::path& folder,
                            const panoramic_compass::CompassParameters& parameters = {}) {
  const auto recording = read_journey_recording(folder);
  return score_compass(recording.base_from_panorama.linear(), panoramas_as_stamped(recording), parameters);
}

void expect_honest_and_exact(const std::filesystem::path& folder) {
  const CompassScore all = score_recorded(folder);
  EXPECT_EQ(all.valid, all.changes);
  EXPECT_LT(all.rms_deg, 0.03);
  EXPECT_LT(all.worst_deg, 0.15);
  EXPECT_GT(all.consistency, 0.15);
  EXPECT_LT(all.consistency, 2.0);
  ASSERT_TRUE(all.drift_rms_deg);
  EXPECT_LT(*all.drift_rms_deg, 0.25);
}

TEST(RecordedCampusClip, GivesEveryTurnWithAnHonestVariance) {
  PANVO_NEEDS_RECORDING(recorded_data("campus_clip"));
  expect_honest_and_exact(recorded_data("campus_clip"));
}

TEST(RecordedCampusJourney, GivesEveryTurnWithAnHonestVariance) {
  PANVO_NEEDS_RECORDING(recorded_data("campus_journey"));
  expect_honest_and_exact(recorded_data("campus_journey"));
}

TEST(RecordedCampusClip, GivesThePapersMethodWhatItCanTell) {
  PANVO_NEEDS_RECORDING(recorded_data("campus_clip"));
  panoramic_compass::CompassParameters paper;
  paper.method = "two_patches";
  const CompassScore all = score_recorded(recorded_data("campus_clip"), paper);
  EXPECT_GT(all.valid, all.changes / 2);
  EXPECT_LT(all.rms_deg, 0.4);
}

}  // namespace
}  // namespace panvo::evaluation
