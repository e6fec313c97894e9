// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "panvo/evaluation/place_journey.hpp"
#include "panvo/test/recorded_data.hpp"

namespace panvo::evaluation {
namespace {

// A rendered town from another source: three revisits, rotated by 88 to 151 degrees, with offsets of 1.4 to 3.1 m.
TEST(CampusJourney, HasEveryRevisitFoundAndNoneWrong) {
  const auto folder = panvo::test::recorded_data("campus_journey");
  PANVO_NEEDS_RECORDING(folder);
  const auto recording = read_place_recording(folder);
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
