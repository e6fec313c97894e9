// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/geodesy.hpp"

#include <gtest/gtest.h>

namespace panvo::vision {
namespace {

// One degree at 45 degrees of latitude: 111,131.745 m along the meridian, 78,846.805 m along the parallel.
TEST(TangentPlane, HasTheKnownLengthsOfADegree) {
  const TangentPlane plane({45.0, 10.0, 0.0});
  const auto north = plane.enu({45.001, 10.0, 0.0}), east = plane.enu({45.0, 10.001, 0.0});
  EXPECT_NEAR(north.y(), 111.1317, 0.002);
  EXPECT_NEAR(north.x(), 0.0, 1e-6);
  EXPECT_NEAR(east.x(), 78.8468, 0.002);
  EXPECT_NEAR(east.y(), 0.0, 0.001);
  EXPECT_TRUE(plane.enu({45.0, 10.0, 7.0}).isApprox(Eigen::Vector3d(0, 0, 7), 1e-9));
}

TEST(TangentPlane, FallsAwayFromTheEarthWithDistance) {
  // d^2 / 2R: 10 km away, 7.85 m.
  EXPECT_NEAR(TangentPlane({45.0, 10.0, 0.0}).enu({45.08998, 10.0, 0.0}).z(), -7.85, 0.02);
}

TEST(TangentPlane, IsInvertedToAMillimetre) {
  for (const auto& origin : {GeoPoint{52.1, 21.0, 110.0}, GeoPoint{-33.9, 151.2, 3.0}, GeoPoint{0.0, 179.9999, -20.0},
                             GeoPoint{89.9, -60.0, 1000.0}}) {
    const TangentPlane plane(origin);
    for (const Eigen::Vector3d& enu_m :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1500, -800, 25), Eigen::Vector3d(-40e3, 60e3, 9e3)}) {
      const Eigen::Vector3d back_m = plane.enu(plane.geodetic(enu_m));
      EXPECT_LT((back_m - enu_m).norm(), 1e-3) << origin.latitude_deg << ", " << enu_m.transpose();
    }
  }
}

}  // namespace
}  // namespace panvo::vision
