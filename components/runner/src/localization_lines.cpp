// SPDX-License-Identifier: Apache-2.0
#include "localization_lines.hpp"

#include <array>
#include <cmath>
#include <string_view>

#include "csv_fields.hpp"
#include "state_names.hpp"

namespace panvo::runner {
namespace {

template <class Pose>
std::array<double, 7> numbers_of(const Pose& pose) {
  const auto& p = pose.position();
  const auto& q = pose.orientation();
  return {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
}

std::string pose_columns(std::string_view prefix) {
  std::string columns;
  for (const char* name : {"x", "y", "z", "qx", "qy", "qz", "qw"}) columns.append(",").append(prefix).append(name);
  return columns;
}

/// False if a number is not finite.
template <class Numbers>
bool append_numbers(std::string& line, const Numbers& numbers) {
  for (const double number : numbers) {
    if (!std::isfinite(number)) return false;
    line += ',' + runtime::to_text(number);
  }
  return true;
}

}  // namespace

std::string quality_header() { return "stamp_ns,reliable,detected,tracked,inliers,inlier_ratio,residual_px,reason"; }

std::optional<std::string> quality_line(const panvo_msgs::msg::OdometryQuality& quality) {
  std::string line = stamp_of(quality) + (quality.reliable() ? ",1" : ",0");
  for (const auto count : {quality.detected(), quality.tracked(), quality.inliers()})
    line += ',' + std::to_string(count);
  line += ',' + number_or_nothing(quality.inlier_ratio()) + ',' + number_or_nothing(quality.residual_px());
  return line + ',' + quoted(quality.reason());
}

std::string azimuth_header() {
  return "stamp_ns,from_stamp_ns,azimuth_change_rad,sigma_rad,side_parallax_rad,motion_azimuth_rad,motion_azimuth_"
         "sigma_rad,valid,"
         "reason";
}

std::optional<std::string> azimuth_line(const panvo_msgs::msg::AzimuthChange& change) {
  std::string line = stamp_of(change) + ',' + time_of(change.from_stamp());
  for (const double number :
       {change.azimuth_change_rad(), std::sqrt(change.variance_rad2()), change.side_parallax_rad(),
        change.motion_azimuth_rad(), std::sqrt(change.motion_azimuth_variance_rad2())}) {
    line += ',' + number_or_nothing(number);
  }
  return line + (change.valid() ? ",1," : ",0,") + quoted(change.reason());
}

std::string correction_header() {
  return "stamp_ns,landmark_id,state,inliers" + pose_columns("") + ",sigma_x_m,sigma_y_m,sigma_yaw_rad,reason";
}

std::optional<std::string> correction_line(const panvo_msgs::msg::PositionCorrection& correction) {
  std::string line = stamp_of(correction) + ',' + std::to_string(correction.landmark_id()) + ',' +
                     name_of(kCorrectionStates, correction.state()) + ',' + std::to_string(correction.inliers());
  if (!append_numbers(line, numbers_of(correction.landmark_from_base().pose()))) return std::nullopt;
  const auto& covariance = correction.landmark_from_base().covariance();
  if (!append_numbers(line,
                      std::array{std::sqrt(covariance[0]), std::sqrt(covariance[7]), std::sqrt(covariance[35])})) {
    return std::nullopt;
  }
  return line + ',' + quoted(correction.reason());
}

std::string outcome_header() {
  return "stamp_ns,landmark_id,outcome,chi_square" + pose_columns("before_") + pose_columns("after_") + ",reason";
}

std::optional<std::string> outcome_line(const panvo_msgs::msg::CorrectionOutcome& outcome) {
  std::string line = stamp_of(outcome) + ',' + std::to_string(outcome.landmark_id()) + ',' +
                     name_of(kOutcomes, outcome.outcome()) + ',' + number_or_nothing(outcome.chi_square());
  if (!append_numbers(line, numbers_of(outcome.before())) || !append_numbers(line, numbers_of(outcome.after())))
    return std::nullopt;
  return line + ',' + quoted(outcome.reason());
}

std::string state_header() { return "stamp_ns,state,position_sigma_m,heading_sigma_rad,reason"; }

std::optional<std::string> state_line(const panvo_msgs::msg::LocalizationState& state) {
  return stamp_of(state) + ',' + name_of(kLocalizationStates, state.state()) + ',' +
         number_or_nothing(state.position_sigma_m()) + ',' + number_or_nothing(state.heading_sigma_rad()) + ',' +
         quoted(state.reason());
}

std::string integrity_header() { return "stamp_ns,usable,reason,risk,hpl_m,alert_limit_m"; }

std::optional<std::string> integrity_line(const panvo_msgs::msg::Integrity& integrity) {
  return stamp_of(integrity) + (integrity.usable() ? ",1," : ",0,") + quoted(integrity.reason()) + ',' +
         number_or_nothing(integrity.risk()) + ',' + number_or_nothing(integrity.horizontal_protection_level_m()) +
         ',' + number_or_nothing(integrity.alert_limit_m());
}

}  // namespace panvo::runner
