// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/place_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <opencv2/core.hpp>

#include "panvo/evaluation/input_error.hpp"
#include "place_recording_fixture.hpp"

namespace panvo::evaluation {
namespace {

/// Distinguishes places by their mean brightness.
class Brightness final : public PlaceMethod {
 public:
  struct Mean final : PlaceDescriptor {
    double value = 0.0;
  };
  std::string name() const override { return "brightness"; }
  std::unique_ptr<PlaceDescriptor> describe_landmark(const cv::Mat& panorama) const override {
    auto mean = std::make_unique<Mean>();
    mean->value = cv::mean(panorama)[0];
    return mean;
  }
  PlaceDistance distance(const PlaceDescriptor& query, const PlaceDescriptor& landmark) const override {
    return {std::abs(static_cast<const Mean&>(query).value - static_cast<const Mean&>(landmark).value), 0.1};
  }
};

TEST(PlaceTask, TakesFirstVisitsForPlacesAndLaterOnesForRevisits) {
  const PlainRecording made({10, 60, 110, 160, 210}, {{7, 1}, {8, 3}, {7, 4}});
  const auto recording = read_place_recording(made.folder.path());
  const auto task = place_task(recording);
  ASSERT_EQ(task.places.size(), 2U);
  EXPECT_EQ(task.places[0].place, 7);
  EXPECT_EQ(task.places[0].panorama, 1U);
  ASSERT_EQ(task.revisits.size(), 1U);
  EXPECT_EQ(task.revisits[0].known, 0U);
  // The panorama of the pass that is nearest to the place; this drive never turned back.
  EXPECT_EQ(task.revisits[0].panorama, 1U);
  EXPECT_DOUBLE_EQ(task.revisits[0].offset_m, 0.0);
}

TEST(PlaceTask, TakesAllVisitsOfALaterRecordingForRevisits) {
  const PlainRecording first({10, 60, 110}, {{1, 0}, {2, 2}});
  const PlainRecording second({12, 64, 118}, {{2, 2}, {9, 1}});
  const auto earlier = read_place_recording(first.folder.path());
  const auto later = read_place_recording(second.folder.path());
  const auto task = place_task(earlier, &later);
  ASSERT_EQ(task.places.size(), 2U);
  ASSERT_EQ(task.revisits.size(), 1U);  // place 9 is not known
  EXPECT_EQ(task.revisits[0].known, 1U);
}

TEST(PlaceScore, IsThatOfSeparationsDoneByHand) {
  // Places 10, 100, 200. Revisits: 18 of the first (right), and 160 of the second, which is nearer to the third
  // (wrong).
  const PlainRecording first({10, 100, 200}, {{1, 0}, {2, 1}, {3, 2}});
  const PlainRecording second({18, 160, 0}, {{1, 0}, {2, 1}});
  const auto earlier = read_place_recording(first.folder.path());
  const auto later = read_place_recording(second.folder.path());
  const auto score = score_places(Brightness(), place_task(earlier, &later), earlier, later);
  // Negatives 90, 90, 100; positives 8, 40: D' = (D - 8) / 92 [Lu2015 Eq. 14]
  EXPECT_NEAR(score.separation, (82.0 + 82.0 + 92.0) / 3.0 / 92.0 - (0.0 + 32.0) / 2.0 / 92.0,
              1e-9);  // [Lu2015 Eq. 13]
  EXPECT_EQ(score.revisits, 2);
  EXPECT_EQ(score.true_positives, 1);
  EXPECT_EQ(score.false_positives, 0);
  EXPECT_DOUBLE_EQ(score.recall, 0.5);
  EXPECT_DOUBLE_EQ(score.precision, 1.0);
  EXPECT_NEAR(score.median_heading_error_rad, 0.1, 1e-9);
  EXPECT_NE(place_table({score}).find("brightness"), std::string::npos);
}

TEST(PlaceScore, CountsNegativesThatNoThresholdKeepsOut) {
  // The revisit differs by 40 from its place, but two of the places by only 20 from each other.
  const PlainRecording first({10, 100, 120}, {{1, 0}, {2, 1}, {3, 2}});
  const PlainRecording second({50, 0}, {{1, 0}});
  const auto earlier = read_place_recording(first.folder.path());
  const auto later = read_place_recording(second.folder.path());
  const auto score = score_places(Brightness(), place_task(earlier, &later), earlier, later);
  EXPECT_EQ(score.true_positives, 1);
  EXPECT_EQ(score.false_positives, 2);
  EXPECT_NEAR(score.precision, 1.0 / 3.0, 1e-12);
}

TEST(PlaceRecording, SaysWhatIsMissing) {
  const PlainRecording made({10, 60}, {{1, 0}});
  const auto error_without = [&](const std::string& file) {
    const auto path = made.folder / file;
    std::filesystem::rename(path, made.folder / "away");
    std::string message;
    try {
      read_place_recording(made.folder.path());
    } catch (const InputError& error) {
      message = error.what();
    }
    std::filesystem::rename(made.folder / "away", path);
    return message;
  };
  EXPECT_NE(error_without("sequence.yaml").find("sequence.yaml: lists no visits"), std::string::npos);
  EXPECT_NE(error_without("mav0/cam2/sensor.yaml").find("holds no panoramas"), std::string::npos);
  EXPECT_NE(error_without("mav0/cam2/data").find("contains none of the images"), std::string::npos);
  EXPECT_NE(error_without("mav0/state_groundtruth_estimate0/data.csv"), "");
  EXPECT_NO_THROW(read_place_recording(made.folder.path()));
}

TEST(PlaceRecording, NamesTheImageThatCannotBeDecoded) {
  const PlainRecording made({10, 60}, {{1, 0}});
  const auto recording = read_place_recording(made.folder.path());
  std::ofstream(recording.panoramas[1].file) << "not a picture";
  EXPECT_EQ(read_panorama(recording.panoramas[0]).size(), cv::Size(1080, 540));
  EXPECT_THROW(read_panorama(recording.panoramas[1]), InputError);
}

}  // namespace
}  // namespace panvo::evaluation
