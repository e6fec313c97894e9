// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/trajectory_files.hpp"

#include <gmock/gmock.h>

#include <sstream>

#include "panvo/evaluation/run_folder.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "trajectories.hpp"

namespace panvo::evaluation {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kKittiStill = "1 0 0 0 0 1 0 0 0 0 1 0\n";

class TrajectoryFiles : public ::testing::Test {
 protected:
  std::string error_of(const std::string& name, const std::string& text) {
    const auto file = folder_.write(name, text);
    return input_error_of([&] { read_trajectory(file); });
  }

  panvo::test::TemporaryFolder folder_;
};

TEST_F(TrajectoryFiles, TumKeepsNanosecondsAndTheOrderOfTheQuaternion) {
  const auto file = folder_.write("a.tum",
                                  "# a comment\n\n1403636579.763555584 1 2 3 0 0 0.6 0.8\r\n"
                                  "1403636579.8 4 5 6 0 0 0 -1\n");
  const Trajectory trajectory = read_trajectory(file);
  EXPECT_EQ(trajectory.format, "TUM");
  ASSERT_EQ(trajectory.poses.size(), 2u);
  EXPECT_EQ(trajectory.poses[0].stamp_ns, 1403636579763555584);
  EXPECT_EQ(trajectory.poses[1].stamp_ns, 1403636579800000000);
  EXPECT_TRUE(trajectory.poses[0].world_from_base.isApprox(make_pose(1, 2, 3, 2.0 * std::asin(0.6)), 1e-12));
  EXPECT_TRUE(trajectory.poses[1].world_from_base.isApprox(make_pose(4, 5, 6), 1e-12));
}

TEST_F(TrajectoryFiles, EurocHasTheScalarOfTheQuaternionFirst) {
  const auto file = folder_.write("data.csv",
                                  "#timestamp [ns], p_RS_R_x [m], ...\n"
                                  "1700021000000000001,1,2,3,0.8,0,0,0.6,0,0,0,0,0,0,0,0,0\n"
                                  "1700021000040000001, 1, 2, 3, 1, 0, 0, 0\n");
  const Trajectory trajectory = read_trajectory(file);
  EXPECT_EQ(trajectory.format, "EuRoC");
  ASSERT_EQ(trajectory.poses.size(), 2u);
  EXPECT_EQ(trajectory.poses[0].stamp_ns, 1700021000000000001);
  EXPECT_TRUE(trajectory.poses[0].world_from_base.isApprox(make_pose(1, 2, 3, 2.0 * std::asin(0.6)), 1e-12));
}

// The optical frame moves 5 m along z, 1 m along x (right), 2 m along y (down), and rotates by 0.1 rad about y, that is
// to the right. In base axes: 5 m forward, 1 m to the right, 2 m down, heading -0.1 rad.
TEST_F(TrajectoryFiles, KittiIsTurnedFromOpticalToBaseAxes) {
  const double c = std::cos(0.1);
  const double s = std::sin(0.1);
  std::ostringstream second;
  second.precision(17);
  second << c << " 0 " << s << " 1  0 1 0 2  " << -s << " 0 " << c << " 5\n";
  const auto file = folder_.write("poses.txt", kKittiStill + second.str());
  const Trajectory trajectory = read_trajectory(file);
  EXPECT_EQ(trajectory.format, "KITTI, nominal 10 Hz");
  ASSERT_EQ(trajectory.poses.size(), 2u);
  EXPECT_TRUE(trajectory.poses[1].world_from_base.isApprox(make_pose(5, -1, -2, -0.1), 1e-9));
  EXPECT_EQ(trajectory.poses[1].stamp_ns, 100'000'000);
}

TEST_F(TrajectoryFiles, KittiTakesItsTimesFromBesideThePoses) {
  folder_.write("poses.txt", std::string(kKittiStill) + kKittiStill);
  folder_.write("times.txt", "0.000000e+00\n1.037875e-01\n2.1e-01\n");
  const Trajectory trajectory = read_trajectory(folder_.path());
  EXPECT_EQ(trajectory.format, "KITTI");
  EXPECT_EQ(trajectory.poses.size(), 2u);
  EXPECT_EQ(trajectory.poses[1].stamp_ns, 103'787'500);
}

TEST_F(TrajectoryFiles, KittiIsFoundInItsOwnLayout) {
  folder_.write("poses/03.txt", std::string(kKittiStill) + kKittiStill);
  folder_.write("sequences/03/times.txt", "0.5\n0.6\n");
  EXPECT_EQ(read_trajectory(folder_ / "sequences/03").poses.at(1).stamp_ns, 600'000'000);
  EXPECT_EQ(read_trajectory(folder_ / "sequences/03/").poses.at(1).stamp_ns, 600'000'000);
  EXPECT_EQ(read_trajectory(folder_ / "poses/03.txt").poses.at(1).stamp_ns, 600'000'000);
}

TEST_F(TrajectoryFiles, ARunsEnhancedOdometryComesFirst) {
  folder_.write("odometry_binocular.tum", "0 1 0 0 0 0 0 1\n");
  EXPECT_EQ(read_trajectory(folder_.path()).source.filename(), "odometry_binocular.tum");
  folder_.write("odometry_enhanced.tum", "");  // the localizer has not published a pose
  EXPECT_EQ(read_trajectory(folder_.path()).source.filename(), "odometry_binocular.tum");
  folder_.write("odometry_enhanced.tum", "0 1 0 0 0 0 0 1\n");
  EXPECT_EQ(read_trajectory(folder_.path()).source.filename(), "odometry_enhanced.tum");
}

TEST_F(TrajectoryFiles, AslGroundTruthIsFoundFromAnyOfItsFolders) {
  folder_.write("mav0/state_groundtruth_estimate0/data.csv", "1,0,0,0,1,0,0,0\n");
  for (const char* part :
       {"", "mav0", "mav0/state_groundtruth_estimate0", "mav0/state_groundtruth_estimate0/data.csv"}) {
    EXPECT_EQ(read_trajectory(folder_ / part).format, "EuRoC") << part;
  }
}

TEST_F(TrajectoryFiles, GroundTruthIsFoundWhereThePlayerFindsIt) {
  folder_.write("one/poses/03.txt", std::string(kKittiStill) + kKittiStill);
  folder_.write("one/03/times.txt", "0.5\n0.6\n");
  EXPECT_EQ(read_trajectory(folder_ / "one/03").poses.at(1).stamp_ns, 600'000'000);
  EXPECT_EQ(read_trajectory(folder_ / "one/poses/03.txt").poses.at(1).stamp_ns, 600'000'000);
  for (const char* system : {"vicon0", "mocap0"}) {
    // The marker is 0.5 m above the body.
    const std::string place = std::string(system) + "/mav0/" + system;
    folder_.write(place + "/sensor.yaml", "T_BS:\n  data: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0.5, 0, 0, 0, 1]\n");
    folder_.write(place + "/data.csv", "1,1,2,3,1,0,0,0\n");
    for (const auto& path : {folder_ / system, folder_ / place, folder_ / place / "data.csv"}) {
      EXPECT_TRUE(read_trajectory(path).poses.at(0).world_from_base.isApprox(make_pose(1, 2, 2.5), 1e-12)) << path;
    }
  }
}

TEST_F(TrajectoryFiles, ErrorsOfADataSetAreThoseOfItsReader) {
  folder_.write("mav0/vicon0/data.csv", "1,1,2,3,1,0,0,0\n2,1,2,3,0.5,0,0,0\n");
  EXPECT_THAT(input_error_of([&] { read_trajectory(folder_.path()); }),
              HasSubstr("vicon0/data.csv:2: contains a quaternion whose norm is not 1"));
  folder_.write("prism/mav0/leica0/data.csv", "1,1,2,3\n");
  EXPECT_THAT(input_error_of([&] { read_trajectory(folder_ / "prism"); }), HasSubstr("leica0 holds positions only"));
}

TEST_F(TrajectoryFiles, AFolderWithoutTrajectorySaysWhatItLookedFor) {
  EXPECT_THAT(input_error_of([&] { read_trajectory(folder_.path()); }),
              AllOf(HasSubstr(folder_.path().string()), HasSubstr("odometry_binocular.tum"), HasSubstr("poses.txt")));
}

TEST_F(TrajectoryFiles, AMissingFileIsNamed) {
  EXPECT_THAT(input_error_of([&] { read_trajectory(folder_ / "no.tum"); }),
              HasSubstr("no.tum: no such file or folder"));
}

TEST_F(TrajectoryFiles, AnEmptyFileIsNamed) {
  EXPECT_THAT(error_of("a.tum", ""), HasSubstr("a.tum: is empty"));
  EXPECT_THAT(error_of("b.tum", "# only a comment\n\n"), HasSubstr("b.tum: is empty"));
}

TEST_F(TrajectoryFiles, ARunThatWroteNothingIsNamed) {
  folder_.write("odometry_binocular.tum", "");
  EXPECT_THAT(input_error_of([&] { read_trajectory(folder_.path()); }), HasSubstr("odometry_binocular.tum: is empty"));
}

TEST_F(TrajectoryFiles, StampsThatGoBackOrStandStillAreNamedByLine) {
  EXPECT_THAT(error_of("a.tum", "2 0 0 0 0 0 0 1\n3 0 0 0 0 0 0 1\n# x\n1 0 0 0 0 0 0 1\n"),
              AllOf(HasSubstr("a.tum:4: the stamp 1000000000 ns is not after"), HasSubstr("sort the file")));
  EXPECT_THAT(error_of("b.csv", "5,0,0,0,1,0,0,0\n5,0,0,0,1,0,0,0\n"), HasSubstr("b.csv:2: stamp 5 ns is not later"));
  folder_.write("times.txt", "0\n0\n");
  EXPECT_THAT(error_of("poses.txt", std::string(kKittiStill) + kKittiStill),
              HasSubstr("times.txt:2: stamp 0 ns is not later"));
}

TEST_F(TrajectoryFiles, NumbersThatAreNoneAreNamedByField) {
  EXPECT_THAT(error_of("a.tum", "0 0 nan 0 0 0 0 1\n"), HasSubstr("a.tum:1: field 3 is not a finite number: 'nan'"));
  EXPECT_THAT(error_of("b.tum", "0 0 0 0 0 0 0 1\n1 0 0 inf 0 0 0 1\n"), HasSubstr("b.tum:2: field 4"));
  EXPECT_THAT(error_of("c.tum", "0 0 0 0 0 0 0 1x\n"), HasSubstr("field 8 is not a finite number: '1x'"));
  EXPECT_THAT(error_of("d.csv", "1.5,0,0,0,1,0,0,0\n"), HasSubstr("stamp '1.5' is not a whole number of nanoseconds"));
  EXPECT_THAT(error_of("e.csv", "1,,0,0,1,0,0,0\n"), HasSubstr("field 2 '' is not a finite number"));
  EXPECT_THAT(error_of("f.tum", "-1 0 0 0 0 0 0 1\n"), HasSubstr("stamps are seconds from 0"));
}

TEST_F(TrajectoryFiles, QuaternionsThatAreNoRotationAreNamedByLine) {
  EXPECT_THAT(error_of("a.tum", "0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 0.5\n"),
              AllOf(HasSubstr("a.tum:2: the quaternion has norm 0.5"), HasSubstr("order of the columns")));
  EXPECT_THAT(error_of("b.tum", "0 0 0 0 0 0 0 0\n"), HasSubstr("the quaternion has norm 0.0"));
}

TEST_F(TrajectoryFiles, MatricesThatAreNoRotationAreNamedByLine) {
  EXPECT_THAT(error_of("a.txt", std::string(kKittiStill) + "2 0 0 0 0 1 0 0 0 0 1 0\n"),
              HasSubstr("a.txt:2: is not a pose: its first three columns are not a rotation"));
  EXPECT_THAT(error_of("b.txt", "1 0 0 0 0 1 0 0 0 0 -1 0\n"), HasSubstr("not a rotation"));  // a mirror
}

TEST_F(TrajectoryFiles, LinesOfAnotherLengthAreNamed) {
  EXPECT_THAT(error_of("a.tum", "0 0 0 0 0 0 0 1\n1 0 0\n"), HasSubstr("a.tum:2: 3 fields, 8 expected"));
  EXPECT_THAT(error_of("b.txt", "1 2 3\n"), HasSubstr("b.txt:1: unknown trajectory format: 3 columns"));
  EXPECT_THAT(error_of("c.png", std::string("\x89PNG\r\n\x1a\n\0\0\0", 11)), HasSubstr("unknown trajectory format"));
}

TEST_F(TrajectoryFiles, TooFewKittiTimesAreNamed) {
  folder_.write("times.txt", "0\n");
  EXPECT_THAT(error_of("poses.txt", std::string(kKittiStill) + kKittiStill), HasSubstr("1 stamps for the 2 poses"));
}

TEST_F(TrajectoryFiles, ARunBringsItsTimesAndCovariances) {
  folder_.write("run/odometry_binocular.tum", "0 1 0 0 0 0 0 1\n");
  folder_.write("run/odometry_enhanced.tum", "0 2 0 0 0 0 0 1\n");
  folder_.write("run/timing.json", R"({"components":{}})");
  folder_.write("run/quality.csv", "stamp_ns,reliable,reason\n0,1,\n40,0,left image is black\n80,1,\n");
  std::string covariance = "0";
  for (int i = 0; i < 78; ++i) covariance += ",1";
  folder_.write("run/odometry_binocular_covariance.csv", covariance + "\n");
  for (const char* path : {"run", "run/", "run/odometry_binocular.tum"}) {
    const Estimate estimate = read_estimate(folder_ / path);
    EXPECT_EQ(estimate.name, std::string(path).ends_with("tum") ? "odometry_binocular" : "run");
    EXPECT_TRUE(estimate.timing);
    EXPECT_EQ(estimate.unreliable, 1u);
    ASSERT_TRUE(estimate.covariances);
    EXPECT_EQ(estimate.covariances->size(), 1u);
    // The covariances belong to the binocular odometry, whichever path is evaluated.
    EXPECT_EQ(estimate.odometry.poses.at(0).world_from_base.translation().x(), 1.0);
  }
}

TEST_F(TrajectoryFiles, ALoneTrajectoryHasNeitherTimesNorCovariances) {
  folder_.write("timing.json", "invalid, but unrelated to this trajectory");
  const Estimate estimate = read_estimate(folder_.write("other.tum", "0 1 0 0 0 0 0 1\n"));
  EXPECT_EQ(estimate.name, "other");
  EXPECT_FALSE(estimate.timing);
  EXPECT_FALSE(estimate.unreliable);
  EXPECT_FALSE(estimate.covariances);
}

}  // namespace
}  // namespace panvo::evaluation
