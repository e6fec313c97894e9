// SPDX-License-Identifier: Apache-2.0
// Run files with known results: the vehicle drives along x of the map at 1 m/s; the map is aligned at the first pose.
#include "panvo/evaluation/trust_run.hpp"

#include <gtest/gtest.h>

#include "panvo/evaluation/input_error.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::evaluation {
namespace {

class TrustRunFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    // The world frame is rotated by 90 degrees against the map: the vehicle drives along y of the world.
    folder_.write("ground_truth.tum",
                  "100 5 0 0 0 0 0.7071067811865476 0.7071067811865476\n"
                  "101 5 1 0 0 0 0.7071067811865476 0.7071067811865476\n"
                  "102 5 2 0 0 0 0.7071067811865476 0.7071067811865476\n");
    folder_.write("odometry_enhanced.tum",
                  "100 0 0 0 0 0 0 1\n"
                  "101.5 1.5 0.4 0 0 0 0 1\n"
                  "110 9 0 0 0 0 0 1\n"  // stamp too late
                  "101 1.2 0 0 0 0 0 1\n");
    folder_.write("odometry_enhanced_covariance.csv",
                  "stamp_ns,p00,p01,p10,p11\n"
                  "100000000000,0.01,0,0,0.01\n"
                  "101500000000,0.01,0,0,0.04\n"
                  "110000000000,0.01,0,0,0.01\n"
                  "101000000000,0.01,0,0,0.01\n");
    folder_.write("states.csv",
                  "stamp_ns,state\n99000000000,starting\n100000000000,tracking\n101000000000,tracking\n"
                  "101000000000,stale\n"  // published later, with the stamp of the then latest pose
                  "101200000000,lost\n");
  }

  panvo::test::TemporaryFolder folder_;
};

TEST_F(TrustRunFiles, GiveEachPoseItsErrorAndTheStateOfItsTimeInWhateverOrderTheyCame) {
  const auto run = read_trust_run(folder_.path());
  ASSERT_EQ(run.samples.size(), 3U);
  EXPECT_EQ(run.without_truth, 1U);
  EXPECT_NEAR(run.samples[0].error_m, 0.0, 1e-9);
  EXPECT_NEAR(run.samples[1].error_m, 0.2, 1e-9);
  EXPECT_NEAR(run.samples[1].error_over_sigma, 2.0, 1e-9);
  EXPECT_NEAR(run.samples[2].error_m, 0.4, 1e-9);
  EXPECT_NEAR(run.samples[2].error_over_sigma, 2.0, 1e-9);
  EXPECT_TRUE(run.samples[1].is_tracking);
  EXPECT_FALSE(run.samples[2].is_tracking);
  EXPECT_FALSE(run.samples[2].is_usable) << "without integrity, the state decides";
  EXPECT_FALSE(run.samples[1].protection_level_m);
}

TEST_F(TrustRunFiles, TellWhatTheIntegritySaidWhereItWasThere) {
  folder_.write("integrity.csv",
                "stamp_ns,usable,reason,risk,hpl_m,alert_limit_m\n"
                "100500000000,1,,0.001,0.8,5\n"
                "101000000000,0,\"far, too far\",0.001,7.5,5\n"
                "101500000000,1,,0.001,,5\n");
  const auto run = read_trust_run(folder_.path());
  EXPECT_FALSE(run.samples[0].protection_level_m) << "no integrity message yet";
  EXPECT_DOUBLE_EQ(*run.samples[1].protection_level_m, 7.5);
  EXPECT_TRUE(run.samples[1].is_tracking);
  EXPECT_FALSE(run.samples[1].is_usable);
  EXPECT_FALSE(run.samples[2].protection_level_m) << "no number, no protection level";
  EXPECT_FALSE(run.samples[2].is_tracking);
  EXPECT_TRUE(run.samples[2].is_usable);
}

TEST_F(TrustRunFiles, LeaveOutAndCountACovarianceThatIsNone) {
  folder_.write("odometry_enhanced_covariance.csv",
                "stamp_ns,p00,p01,p10,p11\n100000000000,0.01,0,0,0.01\n101000000000,-1,0,0,0.01\n");
  const auto run = read_trust_run(folder_.path());
  EXPECT_EQ(run.samples.size(), 1U);
  EXPECT_EQ(run.without_sigma, 2U);
}

TEST_F(TrustRunFiles, WithoutAPoseOfTheTruthsTimeAreRefused) {
  folder_.write("odometry_enhanced.tum", "500 0 0 0 0 0 0 1\n");
  EXPECT_THROW(read_trust_run(folder_.path()), InputError);
}

}  // namespace
}  // namespace panvo::evaluation
