// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "panvo/interfaces/validity.hpp"
#include "validity_parts.hpp"

namespace panvo::interfaces {
namespace {

constexpr double kMaxTurn_rad = std::numbers::pi + 1e-6;  // allows for rounding of a wrapped angle
constexpr double kMaxAngleVariance = 1e3;                 // larger than any angle squared, so "unknown"
constexpr double kMaxSigma = 1e9;                         // of an unknown pose
constexpr double kMaxResidual_px = 1e6;
constexpr double kMaxLean = 10.0;          // rad/m
constexpr double kMaxBearingError = 1e-3;  // of the length of a unit vector
constexpr std::size_t kMaxTracks = 16;
constexpr std::size_t kMaxTrackedPoints = 100'000;
constexpr std::size_t kMaxStatuses = 10'000;
constexpr std::size_t kMaxValues = 10'000;

void check_bearing(Check& check, MemberName name, const geometry_msgs::msg::Vector3& bearing) {
  const double length = std::hypot(bearing.x(), bearing.y(), bearing.z());
  check.require(std::abs(length - 1.0) < kMaxBearingError, name, "is not a unit vector");
}

}  // namespace

Problem problem_of(const panvo_msgs::msg::AzimuthChange& message) {
  Check check;
  check_header(check, message.header());
  check_stamp(check, "from_stamp", message.from_stamp());
  check.text("reason", message.reason());
  if (!message.valid()) return check.problem();
  check.bounded("azimuth_change_rad", {message.azimuth_change_rad()}, kMaxTurn_rad);
  check.within("variance_rad2", message.variance_rad2(), kMinVariance, kMaxAngleVariance);
  check.finite("side_parallax_rad", {message.side_parallax_rad()});
  check.bounded("motion_azimuth_rad", {message.motion_azimuth_rad()}, kMaxTurn_rad);
  check.within("motion_azimuth_variance_rad2", message.motion_azimuth_variance_rad2(), 0.0, kMaxAngleVariance);
  return check.problem();
}

Problem problem_of(const panvo_msgs::msg::CorrectionOutcome& message) {
  Check check;
  check_header(check, message.header());
  check.within("outcome", message.outcome(), panvo_msgs::msg::CorrectionOutcome_Constants::APPLIED,
               panvo_msgs::msg::CorrectionOutcome_Constants::REJECTED);
  check.text("reason", message.reason());
  check.finite("chi_square", {message.chi_square()});
  check_pose(check, "before", message.before());
  check_pose(check, "after", message.after());
  return check.problem();
}

Problem problem_of(const panvo_msgs::msg::Integrity& message) {
  Check check;
  check_header(check, message.header());
  check.text("reason", message.reason());
  check.within("risk", message.risk(), 0.0, 1.0);
  check.within("alert_limit_m", message.alert_limit_m(), 0.0, kMaxSigma);
  // The level may be infinite if it is unknown, but then the pose is not usable.
  if (message.usable()) {
    check.within("horizontal_protection_level_m", message.horizontal_protection_level_m(), 0.0, kMaxSigma);
  }
  return check.problem();
}

Problem problem_of(const panvo_msgs::msg::LocalizationState& message) {
  Check check;
  check_header(check, message.header());
  check_stamp(check, "since", message.since());
  check.within("state", message.state(), panvo_msgs::msg::LocalizationState_Constants::STARTING,
               panvo_msgs::msg::LocalizationState_Constants::STALE);
  check.text("reason", message.reason());
  check.within("position_sigma_m", message.position_sigma_m(), 0.0, kMaxSigma);
  check.within("heading_sigma_rad", message.heading_sigma_rad(), 0.0, kMaxSigma);
  return check.problem();
}

Problem problem_of(const panvo_msgs::msg::OdometryQuality& message) {
  Check check;
  check_header(check, message.header());
  check.text("reason", message.reason());
  check.within("inlier_ratio", message.inlier_ratio(), 0.0, 1.0);
  check.within("residual_px", message.residual_px(), 0.0, kMaxResidual_px);
  check.within("lean_sigma_rad_per_m", message.lean_sigma_rad_per_m(), 0.0, kMaxLean);
  return check.problem();
}

Problem problem_of(const panvo_msgs::msg::PanoramaPoints& message) {
  Check check;
  check_header(check, message.header());
  check.at_most("tracks", message.tracks().size(), kMaxTracks);
  if (!check.holds() || message.tracks().empty()) return check.problem();
  check_rotation(check, "now_from_then", message.now_from_then());
  for (const auto& track : message.tracks()) {
    check_stamp(check, "tracks.from_stamp", track.from_stamp());
    check.at_most("tracks.points", track.points().size(), kMaxTrackedPoints);
    for (const auto& point : track.points()) {
      if (!check.holds()) break;
      check_bearing(check, "tracks.points.then", point.then());
      check_bearing(check, "tracks.points.now", point.now());
      check.within("tracks.points.azimuth_variance_rad2", point.azimuth_variance_rad2(), kMinVariance,
                   kMaxAngleVariance);
      check.within("tracks.points.elevation_variance_rad2", point.elevation_variance_rad2(), kMinVariance,
                   kMaxAngleVariance);
    }
  }
  return check.problem();
}

Problem problem_of(const panvo_msgs::msg::PositionCorrection& message) {
  Check check;
  check_header(check, message.header());
  check.within("state", message.state(), panvo_msgs::msg::PositionCorrection_Constants::FULL,
               panvo_msgs::msg::PositionCorrection_Constants::REJECTED);
  check.text("reason", message.reason());
  check_pose(check, "landmark_from_base.pose", message.landmark_from_base().pose());
  // A rejected correction is for information only and not used as a measurement.
  const bool measures = message.state() != panvo_msgs::msg::PositionCorrection_Constants::REJECTED;
  if (measures) {
    check.measured_covariance("landmark_from_base.covariance", message.landmark_from_base().covariance());
  } else {
    check.covariance("landmark_from_base.covariance", message.landmark_from_base().covariance());
  }
  return check.problem();
}

Problem problem_of(const diagnostic_msgs::msg::DiagnosticArray& message) {
  Check check;
  check_header(check, message.header());
  check.at_most("status", message.status().size(), kMaxStatuses);
  if (!check.holds()) return check.problem();
  for (const auto& status : message.status()) {
    check.text("status.name", status.name()).text("status.message", status.message());
    check.at_most("status.values", status.values().size(), kMaxValues);
  }
  return check.problem();
}

Problem problem_of(const rcl_interfaces::msg::Log& message) {
  Check check;
  check_stamp(check, "stamp", message.stamp());
  check.text("name", message.name()).text("msg", message.msg()).text("file", message.file());
  return check.problem();
}

Problem problem_of(const rosgraph_msgs::msg::Clock& message) {
  Check check;
  check_stamp(check, "clock", message.clock());
  return check.problem();
}

}  // namespace panvo::interfaces
