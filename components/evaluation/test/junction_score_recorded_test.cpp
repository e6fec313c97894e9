// SPDX-License-Identifier: Apache-2.0
// Junctions of a recorded journey.
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "panvo/evaluation/journey_recording.hpp"
#include "panvo/evaluation/junction_score.hpp"
#include "panvo/landmark_builder/road_junction_detector.hpp"
#include "panvo/test/recorded_data.hpp"

namespace panvo::evaluation {
namespace {

TEST(RecordedCampusJourney, EveryJunctionIsFoundOnceAndNothingElse) {
  const auto folder = panvo::test::recorded_data("campus_journey");
  PANVO_NEEDS_RECORDING(folder);
  const auto recording = read_journey_recording(folder);
  const auto panoramas = panoramas_as_stamped(recording);
  landmark_builder::RoadJunctionDetector detector({}, recording.base_from_panorama, {1080, 540});
  landmark_builder::JunctionFilter filter({});
  std::vector<landmark_builder::PassedJunction> detections;
  for (const auto& frame : panoramas) {
    const auto view = detector.detect(cv::imread(frame.file.string()), frame.world_from_base);
    const auto passed = filter.add(frame.stamp_ns, frame.world_from_base.translation().head<2>(), view.seen);
    detections.insert(detections.end(), passed.begin(), passed.end());
  }
  const JunctionScore score = score_junctions(panoramas, recording.places, detections, 8.5);
  EXPECT_EQ(score.found, 9);
  EXPECT_EQ(score.missed, 0);
  EXPECT_TRUE(score.wrong.empty());
}

}  // namespace
}  // namespace panvo::evaluation
