// SPDX-License-Identifier: Apache-2.0
// Accuracy on recordings with exact ground truth.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "compass_recording.hpp"
#include "compass_score.hpp"

namespace panvo::panoramic_compass {
namespace {

namespace fs = std::filesystem;

fs::path recordings() {
  const char* root = std::getenv("PANVO_DATA");
  return root != nullptr ? fs::path(root) : fs::path(PANVO_SHARED_DATA);
}

#define PANVO_NEEDS_RECORDING(path) \
  if (!fs::exists(path)) GTEST_SKIP() << (path).string() << " is missing; set PANVO_DATA to the folder of recordings"

void expect_honest_and_exact(const fs::path& folder) {
  const CompassScore all = score(read_compass_recording(folder), CompassParameters{});
  EXPECT_EQ(all.valid, all.changes);
  EXPECT_LT(all.rms_deg, 0.03);
  EXPECT_LT(all.worst_deg, 0.15);
  EXPECT_GT(all.consistency, 0.15);
  EXPECT_LT(all.consistency, 2.0);
  EXPECT_LT(all.drift_rms_deg, 0.25);
}

TEST(RecordedCampusClip, GivesEveryTurnWithAnHonestVariance) {
  PANVO_NEEDS_RECORDING(recordings() / "campus_clip");
  expect_honest_and_exact(recordings() / "campus_clip");
}

TEST(RecordedCampusJourney, GivesEveryTurnWithAnHonestVariance) {
  PANVO_NEEDS_RECORDING(recordings() / "campus_journey");
  expect_honest_and_exact(recordings() / "campus_journey");
}

TEST(RecordedCampusClip, GivesThePapersMethodWhatItCanTell) {
  PANVO_NEEDS_RECORDING(recordings() / "campus_clip");
  CompassParameters paper;
  paper.method = "two_patches";
  const CompassScore all = score(read_compass_recording(recordings() / "campus_clip"), paper);
  EXPECT_GT(all.valid, all.changes / 2);
  EXPECT_LT(all.rms_deg, 0.4);
}

}  // namespace
}  // namespace panvo::panoramic_compass
