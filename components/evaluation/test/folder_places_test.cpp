// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/folder_places.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "panvo/evaluation/input_error.hpp"
#include "panvo/evaluation/place_recording.hpp"
#include "place_recording_fixture.hpp"

namespace panvo::evaluation {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Distinguishes places by one pixel, and always finds a heading of 0.1 rad.
class OnePixel final : public PlaceMethod {
 public:
  struct Grey final : PlaceDescriptor {
    double value = 0.0;
  };
  std::string name() const override { return "one pixel"; }
  std::unique_ptr<PlaceDescriptor> describe_landmark(const cv::Mat& panorama) const override {
    auto grey = std::make_unique<Grey>();
    grey->value = panorama.at<uchar>(0, 0);
    return grey;
  }
  PlaceDistance distance(const PlaceDescriptor& query, const PlaceDescriptor& landmark) const override {
    return {std::abs(static_cast<const Grey&>(query).value - static_cast<const Grey&>(landmark).value), 0.1};
  }
};

FolderPanorama panorama(const std::string& name, const std::string& place, int grey) {
  FolderPanorama made;
  made.name = name;
  made.place = place;
  made.image.grey = cv::Mat(4, 8, CV_8UC1, cv::Scalar(grey));
  made.heading_rad = 0.0;
  return made;
}

FolderPanorama at(double x_m) {
  auto made = panorama(std::to_string(x_m), "", 0);
  made.world_from_base = Eigen::Isometry3d(Eigen::Translation3d(x_m, 0.0, 0.0));
  return made;
}

TEST(FolderTask, TakesTheFirstPanoramaOfEachLabelForThePlace) {
  const std::vector<FolderPanorama> folder{panorama("1", "hall", 10), panorama("2", "yard", 60),
                                           panorama("3", "hall", 12)};
  const auto task = folder_task(folder, nullptr, 15.0);
  EXPECT_THAT(task.library, ElementsAre(&folder[0], &folder[1]));
  EXPECT_THAT(task.queries, ElementsAre(&folder[2]));
}

TEST(FolderTask, CountsAPanoramaOfAPoseAsARevisitOnlyAfterTheVehicleLeft) {
  std::vector<FolderPanorama> folder;
  for (const double x_m : {0.0, 5.0, 40.0, 3.0}) folder.push_back(at(x_m));
  const auto task = folder_task(folder, nullptr, 15.0);
  EXPECT_THAT(task.library, ElementsAre(&folder[0], &folder[2]));
  EXPECT_THAT(task.queries, ElementsAre(&folder[3])) << "5 m further is the same pass";
  EXPECT_EQ(folder_task(folder, nullptr, 4.0).library.size(), 3U) << "the distance of one place is a parameter";
}

TEST(FolderScore, CountsRightAnswersThatAreSurerThanEveryWrongOne) {
  const std::vector<FolderPanorama> earlier{panorama("a", "hall", 10), panorama("b", "yard", 100)};
  const std::vector<FolderPanorama> folder{panorama("1", "hall", 11), panorama("2", "yard", 110),
                                           panorama("3", "elsewhere", 15)};
  const auto score = score_folder(OnePixel(), folder_task(folder, &earlier, 15.0));
  EXPECT_EQ(score.known, 2);
  EXPECT_EQ(score.unknown, 1);
  EXPECT_EQ(score.right_first, 2);
  EXPECT_EQ(score.right_at_full_precision, 1) << "10 off for the yard, 5 off for the place that is not known";
  ASSERT_EQ(score.heading_errors_rad.size(), 2U);
  EXPECT_NEAR(score.heading_errors_rad[0], 0.1, 1e-12);
}

TEST(FolderPanoramas, AreReadWithLabelsAndBadOnesSkipped) {
  const panvo::test::TemporaryFolder folder;
  cv::Mat noise(64, 128, CV_8UC1);
  cv::RNG random(1);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  for (const char* name : {"1.png", "2.png", "4.png"}) cv::imwrite((folder / name).string(), noise);
  folder.write("3.jpg", "no image");
  folder.write("places.csv", "image,place,heading_deg\n1.png,hall,90\n2.png,\n3.jpg,hall\n");
  std::vector<std::string> skipped;
  const auto read =
      read_folder_panoramas(folder.path(), {}, {}, [&](const std::string& problem) { skipped.push_back(problem); });
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].place, "hall");
  EXPECT_NEAR(*read[0].heading_rad, 1.5708, 1e-4);
  EXPECT_EQ(read[1].place, "only 2.png");
  EXPECT_THAT(skipped, ElementsAre(HasSubstr("3.jpg: cannot be decoded"), HasSubstr("4.png: has neither a pose")));
}

TEST(PlaceRecording, LosesOnlyThePanoramasThatCannotBeRead) {
  const PlainRecording made({10, 60, 110}, {{7, 0}, {8, 2}});
  auto recording = read_place_recording(made.folder.path());
  cv::Mat noise(256, 512, CV_8UC1);
  cv::RNG random(1);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::imwrite(recording.panoramas[1].file.string(), noise);
  cv::imwrite(recording.panoramas[2].file.string(), noise);
  made.folder.write("mav0/cam2/data/" + recording.panoramas[0].file.filename().string(), "no image");
  std::vector<std::string> skipped;
  drop_unreadable(recording, [&](const std::string& problem) { skipped.push_back(problem); });
  EXPECT_THAT(skipped, ElementsAre(HasSubstr("cannot be decoded")));
  ASSERT_EQ(recording.panoramas.size(), 2U);
  EXPECT_EQ(recording.visits[0].panorama, 0U) << "the nearest that is left";
  EXPECT_EQ(recording.visits[1].panorama, 1U);
}

}  // namespace
}  // namespace panvo::evaluation
