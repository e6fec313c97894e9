// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "panvo/evaluation/place_journey.hpp"

namespace panvo::evaluation {
namespace {

std::filesystem::path campus_journey() {
  const char* const data = std::getenv("PANVO_DATA");
  return std::filesystem::path(data != nullptr ? data : PANVO_SHARED_DATA) / "campus_journey";
}

// A rendered town from another source: three revisits, rotated by 88 to 151 degrees, with offsets of 1.4 to 3.1 m.
TEST(CampusJourney, HasEveryRevisitFoundAndNoneWrong) {
  if (!std::filesystem::exists(campus_journey())) {
    GTEST_SKIP() << campus_journey() << " not found; set PANVO_DATA to the folder of recordings";
  }
  const auto recording = read_place_recording(campus_journey());
  const auto task = place_task(recording);
  ASSERT_EQ(task.revisits.size(), 3U);
  const auto score = match_journey(task, recording, recording, {}, [](std::size_t, std::size_t) {});
  EXPECT_EQ(score.wrong, 0);
  for (const bool found : score.found) EXPECT_TRUE(found);
  for (const auto& match : score.matches) {
    EXPECT_LT(std::abs(match.heading_error_rad), 0.5 * M_PI / 180.0) << "place " << task.places[match.known].place;
    EXPECT_LT(match.position_error_m, 0.3) << "place " << task.places[match.known].place;
  }
}

}  // namespace
}  // namespace panvo::evaluation
