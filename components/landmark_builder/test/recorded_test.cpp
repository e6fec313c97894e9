// SPDX-License-Identifier: Apache-2.0
// Junctions of a recorded journey.
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "junction_score.hpp"
#include "panvo/landmark_builder/road_junction_detector.hpp"
#include "panvo/test/recorded_data.hpp"
#include "recording.hpp"

namespace panvo::landmark_builder {
namespace {

TEST(RecordedCampusJourney, EveryJunctionIsFoundOnceAndNothingElse) {
  const auto folder = panvo::test::recorded_data("campus_journey");
  PANVO_NEEDS_RECORDING(folder);
  const Recording recording = read_recording(folder);
  RoadJunctionDetector detector({}, recording.base_from_panorama, {1080, 540});
  JunctionFilter filter({});
  std::vector<PassedJunction> detections;
  for (const auto& frame : recording.panoramas) {
    const auto view = detector.detect(cv::imread(frame.image.string()), frame.map_from_base);
    const auto passed = filter.add(frame.stamp_ns, frame.map_from_base.translation().head<2>(), view.seen);
    detections.insert(detections.end(), passed.begin(), passed.end());
  }
  const JunctionScore score = score_junctions(recording, detections, 8.5);
  EXPECT_EQ(score.found, 9);
  EXPECT_EQ(score.missed, 0);
  EXPECT_TRUE(score.wrong.empty());
}

}  // namespace
}  // namespace panvo::landmark_builder
