// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "panvo/dataset_player/timeline.hpp"
#include "written_dataset.hpp"

namespace panvo::dataset_player {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using EurocDataset = testing::WrittenDataset;

TEST_F(EurocDataset, GivesStampsAndGeometryAsRecorded) {
  write_euroc();
  const auto dataset = open_dataset(root_);
  const auto& stereo = dataset.stereo.value();
  ASSERT_EQ(stereo.frames.size(), 3u);
  EXPECT_EQ(stereo.frames[1].stamp_ns, 1'050'000'000);
  EXPECT_TRUE(stereo.base_from_left.translation().isApprox(Eigen::Vector3d(2.0, 0.1, 1.5)));
  EXPECT_TRUE(stereo.base_from_right().translation().isApprox(Eigen::Vector3d(2.0, -0.1, 1.5)));
  EXPECT_NEAR(stereo.rectified.baseline_m, 0.2, 1e-12);
  EXPECT_TRUE(stereo.rectified.rectified_left_from_left.isIdentity()) << "the pair is rectified already";
  EXPECT_THAT(dataset.notes, IsEmpty());
}

TEST_F(EurocDataset, IsReadInOpencvsYamlToo) {
  write_euroc();
  write("mav0/cam0/sensor.yaml", "%YAML:1.0\n" + euroc_sensor(2.0, 0.1));
  EXPECT_EQ(open_dataset(root_).stereo->frames.size(), 3u);
}

TEST_F(EurocDataset, IsRectifiedByCalculationWhereItIsDistorted) {
  write_euroc();
  for (const char* camera : {"cam0", "cam1"}) {
    write(std::string("mav0/") + camera + "/sensor.yaml",
          euroc_sensor(2.0, camera[3] == '0' ? 0.1 : -0.1, "pinhole", "[-0.28, 0.07, 0.0002, 1.8e-05]"));
  }
  const auto stereo = open_dataset(root_).stereo.value();
  EXPECT_DOUBLE_EQ(stereo.calibration.left.distortion[0], -0.28);
  EXPECT_NEAR(stereo.rectified.baseline_m, 0.2, 1e-9);
  EXPECT_NE(stereo.rectified.camera.fx, 50.0);
}

TEST_F(EurocDataset, PairsTheNearestWhereCamerasAreStampedOnTheirOwn) {
  write_euroc(3, 2'000'000);
  const auto dataset = open_dataset(root_);
  ASSERT_EQ(dataset.stereo->frames.size(), 3u);
  EXPECT_EQ(dataset.stereo->frames[0].stamp_ns, 1'000'000'000) << "the pair has the left one's stamp";
  EXPECT_THAT(dataset.notes, ElementsAre(HasSubstr("differ by up to 2.000 ms")));
}

TEST_F(EurocDataset, PairsEachImageOnce) {
  write_euroc(3);
  write("mav0/cam0/data.csv",
        "1000000000,1000000000.png\n1010000000,1000000000.png\n1050000000,1050000000.png\n1100000000,1100000000.png\n");
  EXPECT_EQ(open_dataset(root_).stereo->frames.size(), 3u) << "two left images are near the first right one";
}

TEST_F(EurocDataset, LeavesOutImagesWithoutPartner) {
  write_euroc(4);
  write("mav0/cam1/data.csv",
        "#timestamp [ns],filename\n1000000000,1000000000.png\n1100000000,1100000000.png\n1150000000,1150000000.png\n");
  const auto dataset = open_dataset(root_);
  ASSERT_EQ(dataset.stereo->frames.size(), 3u);
  EXPECT_EQ(dataset.stereo->frames[1].stamp_ns, 1'100'000'000);
  EXPECT_THAT(dataset.notes, ElementsAre(HasSubstr("1 images of cam0 and cam1 have no partner")));
}

TEST_F(EurocDataset, LeavesOutPairsThatLackAFile) {
  write_euroc();
  fs::remove(root_ / "mav0/cam1/data/1050000000.png");
  const auto dataset = open_dataset(root_);
  EXPECT_EQ(dataset.stereo->frames.size(), 2u);
  EXPECT_THAT(dataset.notes, ElementsAre(AllOf(HasSubstr("1 pairs lack"), HasSubstr("cam1/data/1050000000.png"))));
}

TEST_F(EurocDataset, HasInertialMeasurementsAroundItsImages) {
  write_euroc(3);  // 1.00 to 1.10 s
  write("mav0/imu0/sensor.yaml",
        "sensor_type: imu\nT_BS:\n  cols: 4\n  rows: 4\n  data: [0, -1, 0, 0.5, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n"
        "rate_hz: 200\ngyroscope_noise_density: 1.0e-03\n");
  std::string lines = "#timestamp [ns],w_x,w_y,w_z,a_x,a_y,a_z\n";
  for (int i = 0; i <= 50; ++i) lines += fmt::format("{},{},0.2,0.3,1,2,9.8\n", 950'000'000 + i * 5'000'000, 0.001 * i);
  write("mav0/imu0/data.csv", lines);
  const auto dataset = open_dataset(root_);
  const auto& imu = dataset.imu.value();
  ASSERT_EQ(imu.samples.size(), 51u);
  EXPECT_TRUE(imu.samples[2].rate_rad_s.isApprox(Eigen::Vector3d(0.002, 0.2, 0.3)));
  EXPECT_TRUE(imu.samples[2].acceleration_m_s2.isApprox(Eigen::Vector3d(1.0, 2.0, 9.8)));
  EXPECT_TRUE(imu.base_from_imu.linear().col(0).isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_NEAR(imu.rate_variance, 200e-6, 1e-12);
  std::vector<std::int64_t> stamps;
  for (const auto& event : timeline(dataset, {})) {
    if (event.kind == TimelineEvent::Kind::kImu) stamps.push_back(event.stamp_ns);
  }
  ASSERT_EQ(stamps.size(), 21u);
  EXPECT_EQ(stamps.front(), 1'000'000'000);
  EXPECT_EQ(stamps.back(), 1'100'000'000);
}

TEST_F(EurocDataset, RefusesInertialMeasurementsOutOfOrder) {
  write_euroc(3);
  write("mav0/imu0/data.csv", "2,0,0,0,0,0,9.8\n1,0,0,0,0,0,9.8\n");
  EXPECT_THAT(error(), HasSubstr("imu0/data.csv:2"));
}

TEST_F(EurocDataset, RefusesToBeWithoutAnEye) {
  write_euroc();
  fs::remove_all(root_ / "mav0/cam1");
  EXPECT_THAT(error(), AllOf(HasSubstr("mav0/cam1: is missing"), HasSubstr("both cameras")));
}

TEST_F(EurocDataset, RefusesAnEmptyFolder) {
  fs::create_directories(root_ / "mav0");
  EXPECT_THAT(error(), HasSubstr("mav0/cam0: is missing"));
}

TEST_F(EurocDataset, NamesTheLineOfAStampThatGoesBack) {
  write_euroc();
  write("mav0/cam0/data.csv", "#timestamp [ns],filename\n1000000000,a.png\n\n1100000000,b.png\n1050000000,c.png\n");
  EXPECT_THAT(error(), AllOf(HasSubstr("cam0/data.csv:5:"), HasSubstr("must increase")));
}

TEST_F(EurocDataset, NamesTheLineOfAStampThatMessagesCannotHold) {
  write_euroc();
  for (const char* stamp : {"2147483648000000000", "9223372036854775807", "-1"}) {
    write("mav0/cam0/data.csv", fmt::format("1000000000,1000000000.png\n{},1050000000.png\n", stamp));
    EXPECT_THAT(error(), AllOf(HasSubstr("cam0/data.csv:2:"), HasSubstr("from 1970 to 2038"))) << stamp;
  }
}

TEST_F(EurocDataset, RefusesAListWithoutImages) {
  write_euroc();
  write("mav0/cam0/data.csv", "#timestamp [ns],filename\n");
  EXPECT_THAT(error(), HasSubstr("cam0/data.csv: lists no image"));
}

TEST_F(EurocDataset, NamesTheLineOfAResolutionThatIsNot) {
  write_euroc();
  auto text = euroc_sensor(2.0, 0.1);
  text.replace(text.find("[64, 48]"), 8, "[64]");
  write("mav0/cam0/sensor.yaml", text);
  EXPECT_THAT(error(), AllOf(HasSubstr("cam0/sensor.yaml:13:"), HasSubstr("resolution must be [width, height]")));
}

TEST_F(EurocDataset, NamesTheLineOfAnImageWithoutAName) {
  write_euroc();
  write("mav0/cam0/data.csv", "1000000000,1000000000.png\n1050000000,\n");
  EXPECT_THAT(error(), AllOf(HasSubstr("cam0/data.csv:2:"), HasSubstr("has no image file name")));
}

TEST_F(EurocDataset, RefusesATransformThatIsNone) {
  write_euroc();
  write("mav0/cam1/sensor.yaml", euroc_sensor(std::numeric_limits<double>::quiet_NaN(), 0.1));
  EXPECT_THAT(error(), AllOf(HasSubstr("cam1/sensor.yaml:5:"), HasSubstr("T_BS must be a list of 16 numbers")));
}

TEST_F(EurocDataset, RefusesABaselineOfZero) {
  write_euroc();
  write("mav0/cam1/sensor.yaml", euroc_sensor(2.0, 0.1));
  EXPECT_THAT(error(), AllOf(HasSubstr("cam1/sensor.yaml"), HasSubstr("baseline")));
}

TEST_F(EurocDataset, OfFisheyesIsRectifiedToAFlatView) {
  write_euroc();
  for (const char* camera : {"cam0", "cam1"}) {
    auto text = euroc_sensor(2.0, camera[3] == '0' ? 0.1 : -0.1, "pinhole", "[0.01, -0.002, 0.0001, 0.0]");
    text.replace(text.find("radial-tangential"), 17, "equidistant");
    write(std::string("mav0/") + camera + "/sensor.yaml", text);
  }
  const auto stereo = open_dataset(root_).stereo.value();
  EXPECT_EQ(stereo.calibration.right.model, vision::LensModel::kEquidistant);
  EXPECT_DOUBLE_EQ(stereo.calibration.right.distortion[1], -0.002);
  EXPECT_NEAR(stereo.rectified.baseline_m, 0.2, 1e-9);
  EXPECT_GT(stereo.rectified.camera.fx, 20.0);
  EXPECT_LT(stereo.rectified.camera.fx, 50.0) << "a flat image of the same width shows less of a fisheye's middle";
}

TEST_F(EurocDataset, RefusesALensModelItDoesNotKnow) {
  write_euroc();
  auto text = euroc_sensor(2.0, 0.1, "pinhole", "[0.9, 0, 0, 0]");
  text.replace(text.find("radial-tangential"), 17, "field-of-view");
  write("mav0/cam0/sensor.yaml", text);
  EXPECT_THAT(error(), AllOf(HasSubstr("cam0/sensor.yaml"), HasSubstr("'field-of-view'"), HasSubstr("plumb_bob")));
}

TEST_F(EurocDataset, HasAPanoramaIfCam2IsOne) {
  write_euroc();
  write("mav0/cam2/sensor.yaml", euroc_sensor(-0.2, 0.0, "equirectangular"));
  write("mav0/cam2/data.csv", "#timestamp [ns],filename\n1000000000,1.png\n1200000000,2.png\n");
  write_image("mav0/cam2/data/1.png", kWidth, kHeight, 3);
  auto dataset = open_dataset(root_);
  ASSERT_TRUE(dataset.panorama);
  EXPECT_EQ(dataset.panorama->frames.size(), 1u);
  EXPECT_DOUBLE_EQ(dataset.panorama->base_from_panorama.translation().x(), -0.2);
  EXPECT_THAT(dataset.notes, ElementsAre(HasSubstr("1 panoramas")));

  write("mav0/cam2/sensor.yaml", euroc_sensor(-0.2, 0.0));
  dataset = open_dataset(root_);
  EXPECT_FALSE(dataset.panorama);
  EXPECT_THAT(dataset.notes, ElementsAre(HasSubstr("not 'equirectangular'")));
}

TEST_F(EurocDataset, MayHaveThePanoramaAlone) {
  write("mav0/cam2/sensor.yaml", euroc_sensor(-0.2, 0.0, "equirectangular"));
  write("mav0/cam2/data.csv", "1000000000,1.png\n");
  write_image("mav0/cam2/data/1.png");
  const auto dataset = open_dataset(root_);
  EXPECT_FALSE(dataset.stereo);
  EXPECT_TRUE(dataset.panorama);
}

TEST_F(EurocDataset, TakesItsGroundTruthFromTheState) {
  write_euroc();
  write(
      "mav0/state_groundtruth_estimate0/data.csv",
      "#timestamp, p_RS_R_x [m], ...\n1000000000,1,2,3,0.7071067811865476,0,0,0.7071067811865476,0,0,0,0,0,0,0,0,0\n");
  const auto poses = open_dataset(root_).ground_truth;
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_TRUE(poses[0].map_from_base.translation().isApprox(Eigen::Vector3d(1, 2, 3)));
  EXPECT_TRUE((poses[0].map_from_base.linear() * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-9));
}

TEST_F(EurocDataset, MovesTheGroundTruthOfAMarkerToTheBody) {
  write_euroc();
  write("mav0/vicon0/sensor.yaml",
        "T_BS:\n  cols: 4\n  rows: 4\n  data: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0.5, 0, 0, 0, 1]\n");
  write("mav0/vicon0/data.csv", "1000000000,1,2,3,1,0,0,0\n");
  EXPECT_TRUE(open_dataset(root_).ground_truth.at(0).map_from_base.translation().isApprox(Eigen::Vector3d(1, 2, 2.5)));
}

TEST_F(EurocDataset, NamesTheLineOfAGroundTruthThatIsNone) {
  write_euroc();
  write("mav0/vicon0/data.csv", "1000000000,1,2,3,1,0,0,0\n1050000000,1,2,3,0,0,0,0\n");
  EXPECT_THAT(error(), AllOf(HasSubstr("vicon0/data.csv:2:"), HasSubstr("quaternion")));
}

TEST_F(EurocDataset, SaysThatThePositionsOfAPrismAreNoPoses) {
  write_euroc();
  write("mav0/leica0/data.csv", "1000000000,1,2,3\n");
  const auto dataset = open_dataset(root_);
  EXPECT_THAT(dataset.ground_truth, IsEmpty());
  EXPECT_THAT(dataset.notes, ElementsAre(HasSubstr("leica0")));
}

}  // namespace
}  // namespace panvo::dataset_player
