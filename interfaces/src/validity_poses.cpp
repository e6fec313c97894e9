// SPDX-License-Identifier: Apache-2.0
#include "panvo/interfaces/validity.hpp"
#include "validity_parts.hpp"

namespace panvo::interfaces {
namespace {

constexpr std::size_t kMaxPoses = 1'000'000;    // of a path; a day at 10 Hz
constexpr std::size_t kMaxTransforms = 10'000;  // of one message; ten times the joints of any robot

void check(Check& check, std::string_view pose_name, std::string_view covariance_name,
           const geometry_msgs::msg::PoseWithCovariance& pose) {
  check_pose(check, pose_name, pose.pose());
  check.covariance(covariance_name, pose.covariance());
}

void check(Check& check, std::string_view twist_name, std::string_view covariance_name,
           const geometry_msgs::msg::TwistWithCovariance& twist) {
  check_twist(check, twist_name, twist.twist());
  // Drivers that do not measure velocity set the first element to -1, as REP 145 defines it for IMUs.
  if (twist.covariance()[0] != -1.0) check.covariance(covariance_name, twist.covariance());
}

}  // namespace

Problem problem_of(const geometry_msgs::msg::PoseStamped& message) {
  Check check;
  check_header(check, message.header());
  check_pose(check, "pose", message.pose());
  return check.problem();
}

Problem problem_of(const geometry_msgs::msg::PoseWithCovariance& message) {
  Check checked;
  check(checked, "pose", "covariance", message);
  return checked.problem();
}

Problem problem_of(const geometry_msgs::msg::PoseWithCovarianceStamped& message) {
  Check checked;
  check_header(checked, message.header());
  check(checked, "pose.pose", "pose.covariance", message.pose());
  return checked.problem();
}

Problem problem_of(const geometry_msgs::msg::TwistStamped& message) {
  Check check;
  check_header(check, message.header());
  check_twist(check, "twist", message.twist());
  return check.problem();
}

Problem problem_of(const geometry_msgs::msg::TwistWithCovarianceStamped& message) {
  Check checked;
  check_header(checked, message.header());
  check(checked, "twist.twist", "twist.covariance", message.twist());
  return checked.problem();
}

Problem problem_of(const nav_msgs::msg::Odometry& message) {
  Check checked;
  check_header(checked, message.header());
  checked.name("child_frame_id", message.child_frame_id());
  check(checked, "pose.pose", "pose.covariance", message.pose());
  check(checked, "twist.twist", "twist.covariance", message.twist());
  return checked.problem();
}

Problem problem_of(const nav_msgs::msg::Path& message) {
  Check check;
  check_header(check, message.header());
  check.at_most("poses", message.poses().size(), kMaxPoses);
  if (!check.holds()) return check.problem();
  for (const auto& pose : message.poses()) check_pose(check, "poses.pose", pose.pose());
  return check.problem();
}

Problem problem_of(const geometry_msgs::msg::TransformStamped& message) {
  Check check;
  check_header(check, message.header());
  check.name("child_frame_id", message.child_frame_id());
  const auto& translation = message.transform().translation();
  check.bounded({"transform", "translation"}, {translation.x(), translation.y(), translation.z()}, kMaxCoordinate_m);
  check_rotation(check, {"transform", "rotation"}, message.transform().rotation());
  return check.problem();
}

Problem problem_of(const tf2_msgs::msg::TFMessage& message) {
  Check check;
  check.at_most("transforms", message.transforms().size(), kMaxTransforms);
  return check.problem();
}

}  // namespace panvo::interfaces
