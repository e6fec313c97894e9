// SPDX-License-Identifier: Apache-2.0
#include <cstdint>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/interfaces/gnss_topics.hpp"
#include "panvo/runtime/component.hpp"
#include "panvo/simulation/gnss_receiver.hpp"
#include "panvo/vision/geodesy.hpp"

namespace panvo::simulation {

struct GnssReceiverParameters {
  GnssErrors errors;
  double latitude_deg = 52.2297, longitude_deg = 21.0122, altitude_m = 113.0;
  int seed = 1;

  template <class Field>
  static void describe(Field&& field) {
    using P = GnssReceiverParameters;
    field.group(&P::errors, "errors");
    field(&P::latitude_deg, "latitude_deg", "deg", "of the world's origin; its axes are east, north, up", -89.0, 89.0);
    field(&P::longitude_deg, "longitude_deg", "deg", "of the world's origin", -180.0, 180.0);
    field(&P::altitude_m, "altitude_m", "m", "of the world's origin", -500.0, 9000.0);
    field(&P::seed, "seed", "1", "seed of the errors", 0, 1'000'000'000);
  }
};

/// ground_truth/odometry -> gnss/fix.
class GnssReceiverComponent final : public runtime::Component {
 public:
  explicit GnssReceiverComponent(runtime::Context& context)
      : parameters_(context.parameters<GnssReceiverParameters>()),
        receiver_(parameters_.errors, static_cast<std::uint64_t>(parameters_.seed)),
        plane_({parameters_.latitude_deg, parameters_.longitude_deg, parameters_.altitude_m}),
        fix_(context.output(topics::kGnssFix)) {
    context.input(topics::kGroundTruth, [this](const auto& message) { on_truth(*message); });
  }

 private:
  void on_truth(const nav_msgs::msg::Odometry& truth) {
    const auto pose = conversions::to_isometry(truth.pose().pose());
    const std::int64_t stamp_ns = conversions::stamp_ns(truth);
    if (!pose || stamp_ns <= last_ns_) return;
    last_ns_ = stamp_ns;
    if (const auto fix = receiver_.step(stamp_ns, pose->translation())) publish(*fix);
  }

  void publish(const GnssReceiver::Fix& fix) {
    const auto point = plane_.geodetic(fix.world_m);
    sensor_msgs::msg::NavSatFix message;
    message.header().stamp(conversions::to_stamp(fix.stamp_ns));
    message.header().frame_id("base_link");
    message.status().status(fix.has_position ? sensor_msgs::msg::NavSatStatus_Constants::STATUS_FIX
                                             : sensor_msgs::msg::NavSatStatus_Constants::STATUS_NO_FIX);
    message.status().service(sensor_msgs::msg::NavSatStatus_Constants::SERVICE_GPS);
    if (fix.has_position) {
      message.latitude(point.latitude_deg);
      message.longitude(point.longitude_deg);
      message.altitude(point.altitude_m);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const double sigma_m = fix.sigma_m(static_cast<Eigen::Index>(i));
      message.position_covariance()[4 * i] = sigma_m * sigma_m;
    }
    message.position_covariance_type(sensor_msgs::msg::NavSatFix_Constants::COVARIANCE_TYPE_DIAGONAL_KNOWN);
    fix_.publish(std::move(message));
  }

  const GnssReceiverParameters parameters_;
  GnssReceiver receiver_;
  const vision::TangentPlane plane_;
  runtime::Output<sensor_msgs::msg::NavSatFix> fix_;
  std::int64_t last_ns_ = INT64_MIN;
};

PANVO_REGISTER_COMPONENT(GnssReceiverComponent)

}  // namespace panvo::simulation
