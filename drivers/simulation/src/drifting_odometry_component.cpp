// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/component.hpp"
#include "panvo/simulation/drifting_odometry.hpp"

namespace panvo::simulation {

struct DriftingOdometryParameters {
  DriftParameters drift;
  int seed = 1;

  template <class Field>
  static void describe(Field&& field) {
    using P = DriftingOdometryParameters;
    field.group(&P::drift, "drift");
    field(&P::seed, "seed", "1", "seed of the errors", 0, 1'000'000'000);
  }
};

/// ground_truth/odometry -> odometry/binocular with modelled drift.
class DriftingOdometryComponent final : public runtime::Component {
 public:
  explicit DriftingOdometryComponent(runtime::Context& context)
      : parameters_(context.parameters<DriftingOdometryParameters>()),
        odometry_(parameters_.drift, static_cast<std::uint64_t>(parameters_.seed)),
        output_(context.output(topics::kOdometryBinocular)) {
    context.input(topics::kGroundTruth, [this](const auto& message) { on_truth(*message); });
  }

 private:
  void on_truth(const nav_msgs::msg::Odometry& truth) {
    const auto pose = conversions::to_isometry(truth.pose().pose());
    if (!pose) return;
    const std::int64_t stamp_ns = conversions::stamp_ns(truth);
    const auto now = odometry_.step(*pose);
    nav_msgs::msg::Odometry message;
    message.header().stamp(truth.header().stamp());
    message.header().frame_id("odom");
    message.child_frame_id("base_link");
    message.pose().pose(conversions::to_pose(now.odom_from_base));
    message.pose().covariance(conversions::to_array(now.covariance));
    if (last_ && stamp_ns > last_->stamp_ns) {
      const vision::Vector6d twist = vision::se3_log(last_->odom_from_base.inverse() * now.odom_from_base) * 1e9 /
                                     static_cast<double>(stamp_ns - last_->stamp_ns);
      message.twist().twist().linear().x(twist[0]);
      message.twist().twist().linear().y(twist[1]);
      message.twist().twist().linear().z(twist[2]);
      message.twist().twist().angular().x(twist[3]);
      message.twist().twist().angular().y(twist[4]);
      message.twist().twist().angular().z(twist[5]);
    }
    last_ = Last{stamp_ns, now.odom_from_base};
    output_.publish(std::move(message));
  }

  struct Last {
    std::int64_t stamp_ns;
    Eigen::Isometry3d odom_from_base;
  };

  const DriftingOdometryParameters parameters_;
  DriftingOdometry odometry_;
  runtime::Output<nav_msgs::msg::Odometry> output_;
  std::optional<Last> last_;
};

PANVO_REGISTER_COMPONENT(DriftingOdometryComponent)

}  // namespace panvo::simulation
