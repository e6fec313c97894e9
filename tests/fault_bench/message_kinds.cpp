// SPDX-License-Identifier: Apache-2.0
// Stopped components and invalid messages.
#include <cmath>
#include <limits>

#include "kinds.hpp"
#include "passages.hpp"

namespace panvo::test {
namespace {

using nav_msgs::msg::Odometry;
using panvo_msgs::msg::AzimuthChange;
using panvo_msgs::msg::OdometryQuality;
using panvo_msgs::msg::PanoramicLandmark;
using panvo_msgs::msg::PositionCorrection;

Fault odometry_stopped(Draw&, const FaultWindow&) {
  return {.odometry = stopped<Odometry>(), .qualities = stopped<OdometryQuality>()};
}

Fault quality_stopped(Draw&, const FaultWindow&) { return {.qualities = stopped<OdometryQuality>()}; }
Fault compass_stopped(Draw&, const FaultWindow&) { return {.azimuths = stopped<AzimuthChange>()}; }
Fault builder_stopped(Draw&, const FaultWindow&) { return {.landmarks = stopped<PanoramicLandmark>()}; }
Fault corrector_stopped(Draw&, const FaultWindow&) { return {.corrections = stopped<PositionCorrection>()}; }

/// Replaces every seventh message by an invalid one.
template <class Spoil>
Passage<Odometry> now_and_then(Spoil spoil) {
  return altered<Odometry>([spoil, count = 0](Odometry& odometry, const Moment&) mutable {
    constexpr int kEvery = 7;
    if (count++ % kEvery == 0) spoil(odometry);
  });
}

Fault odometry_nan(Draw& draw, const FaultWindow&) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const bool in_covariance = draw.chance(0.5);
  return {.odometry = now_and_then([nan, in_covariance](Odometry& odometry) {
            if (in_covariance) {
              odometry.pose().covariance()[7] = nan;
              odometry.twist().covariance()[0] = nan;
            } else {
              odometry.pose().pose().position().x(nan);
            }
          })};
}

Fault odometry_absurd(Draw& draw, const FaultWindow&) {
  const double far_m = draw.chance(0.5) ? 1e200 : 5e3;
  return {.odometry = now_and_then([far_m](Odometry& odometry) {
            auto& position = odometry.pose().pose().position();
            position.x(position.x() + far_m);
          })};
}

/// Invalid covariance with negative variances.
Fault odometry_indefinite(Draw&, const FaultWindow&) {
  return {.odometry = now_and_then([](Odometry& odometry) {
            for (auto* covariance : {&odometry.pose().covariance(), &odometry.twist().covariance()}) {
              for (std::size_t i = 0; i < covariance->size(); i += 7) (*covariance)[i] = -1e-3;
            }
          })};
}

/// Landmark poses with an error of some metres and an unchanged covariance.
Fault landmark_wrong(Draw& draw, const FaultWindow&) {
  const double x_m = draw.sign() * draw.uniform(2.0, 6.0), y_m = draw.sign() * draw.uniform(2.0, 6.0);
  return {.landmarks = altered<PanoramicLandmark>([x_m, y_m](PanoramicLandmark& landmark, const Moment&) {
            auto& position = landmark.pose().pose().position();
            position.x(position.x() + x_m);
            position.y(position.y() + y_m);
          })};
}

/// Sightings with a position error of some metres.
Fault correction_wrong(Draw& draw, const FaultWindow&) {
  const double x_m = draw.sign() * draw.uniform(2.0, 6.0);
  return {.corrections = altered<PositionCorrection>([x_m](PositionCorrection& correction, const Moment&) {
            auto& position = correction.landmark_from_base().pose().position();
            position.x(position.x() + x_m);
          })};
}

/// Constant error in each azimuth change.
Fault azimuth_wrong(Draw& draw, const FaultWindow&) {
  const double by_rad = draw.sign() * draw.uniform(0.05, 0.2);
  return {.azimuths = altered<AzimuthChange>([by_rad](AzimuthChange& change, const Moment&) {
            change.azimuth_change_rad(change.azimuth_change_rad() + by_rad);
          })};
}

}  // namespace

std::vector<FaultKind> message_kinds() {
  return {
      {"odometry_stopped", "no messages of the stereo odometry", Lasting::kWhile, odometry_stopped},
      {"quality_stopped", "no odometry quality messages", Lasting::kWhile, quality_stopped},
      {"compass_stopped", "no messages of the compass", Lasting::kWhile, compass_stopped},
      {"builder_stopped", "no messages of the landmark builder", Lasting::kWhile, builder_stopped},
      {"corrector_stopped", "no messages of the position corrector", Lasting::kOnward, corrector_stopped},
      {"odometry_nan", "occasional odometry messages with NaN", Lasting::kWhile, odometry_nan},
      {"odometry_absurd", "occasional odometry messages with a far position", Lasting::kWhile, odometry_absurd},
      {"odometry_indefinite", "occasional odometry messages with negative variances", Lasting::kWhile,
       odometry_indefinite},
      {"landmark_wrong", "landmark poses with an error of some metres", Lasting::kOnward, landmark_wrong},
      {"correction_wrong", "landmark sightings with an error of some metres", Lasting::kOnward, correction_wrong},
      {"azimuth_wrong", "compass error of 3 to 11 degrees per panorama", Lasting::kWhile, azimuth_wrong},
  };
}

}  // namespace panvo::test
