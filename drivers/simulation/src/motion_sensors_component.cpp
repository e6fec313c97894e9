// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/component.hpp"
#include "panvo/simulation/motion_sensors.hpp"

namespace panvo::simulation {

struct MotionSensorsParameters {
  GyroErrors gyro;
  WheelErrors wheels;
  bool has_gyro = true, has_wheels = true;
  int seed = 1;

  template <class Field>
  static void describe(Field&& field) {
    using P = MotionSensorsParameters;
    field.group(&P::gyro, "gyro");
    field.group(&P::wheels, "wheels");
    field(&P::has_gyro, "has_gyro", "", "publish imu/data");
    field(&P::has_wheels, "has_wheels", "", "publish wheel/odometry");
    field(&P::seed, "seed", "1", "seed of the errors", 0, 1'000'000'000);
  }
};

/// ground_truth/odometry -> imu/data (gyroscope only), wheel/odometry (velocity only).
class MotionSensorsComponent final : public runtime::Component {
 public:
  explicit MotionSensorsComponent(runtime::Context& context)
      : parameters_(context.parameters<MotionSensorsParameters>()),
        sensors_(parameters_.gyro, parameters_.wheels, static_cast<std::uint64_t>(parameters_.seed)) {
    if (parameters_.has_gyro) imu_.emplace(context.output(topics::kImu));
    if (parameters_.has_wheels) wheels_.emplace(context.output(topics::kWheelOdometry));
    context.input(topics::kGroundTruth, [this](const auto& message) { on_truth(*message); });
  }

 private:
  void on_truth(const nav_msgs::msg::Odometry& truth) {
    const auto pose = conversions::to_isometry(truth.pose().pose());
    const std::int64_t stamp_ns = conversions::stamp_ns(truth);
    if (!pose || stamp_ns <= last_ns_) return;
    last_ns_ = stamp_ns;
    const auto samples = sensors_.step(stamp_ns, *pose);
    if (imu_) std::ranges::for_each(samples.gyro, [this](const auto& one) { publish(one); });
    if (wheels_) std::ranges::for_each(samples.wheels, [this](const auto& one) { publish(one); });
  }

  void publish(const MotionSensors::Gyro& sample) {
    sensor_msgs::msg::Imu message;
    message.header().stamp(conversions::to_stamp(sample.stamp_ns));
    message.header().frame_id("base_link");
    message.angular_velocity().x(sample.rate_rad_s.x());
    message.angular_velocity().y(sample.rate_rad_s.y());
    message.angular_velocity().z(sample.rate_rad_s.z());
    message.orientation_covariance()[0] = message.linear_acceleration_covariance()[0] = kNotMeasured;
    imu_->publish(std::move(message));
  }

  void publish(const MotionSensors::Wheels& sample) {
    nav_msgs::msg::Odometry message;
    message.header().stamp(conversions::to_stamp(sample.stamp_ns));
    message.header().frame_id("wheel_odom");
    message.child_frame_id("base_link");
    message.pose().pose().orientation().w(1.0);
    message.pose().covariance(conversions::to_array(kUnknown * vision::Matrix6d::Identity()));
    message.twist().twist().linear().x(sample.forward_m_s);
    message.twist().twist().angular().z(sample.yaw_rate_rad_s);
    wheels_->publish(std::move(message));
  }

  static constexpr double kNotMeasured = -1.0;  // REP 145
  static constexpr double kUnknown = 1e6;

  const MotionSensorsParameters parameters_;
  MotionSensors sensors_;
  std::optional<runtime::Output<sensor_msgs::msg::Imu>> imu_;
  std::optional<runtime::Output<nav_msgs::msg::Odometry>> wheels_;
  std::int64_t last_ns_ = INT64_MIN;
};

PANVO_REGISTER_COMPONENT(MotionSensorsComponent)

}  // namespace panvo::simulation
