// SPDX-License-Identifier: Apache-2.0
#include "place_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "csv_fields.hpp"
#include "panvo/runtime/parameters.hpp"
#include "state_names.hpp"

namespace panvo::runner {

std::string landmark_header() {
  return "stamp_ns,id,is_junction,x,y,z,qx,qy,qz,qw,sigma_x_m,sigma_y_m,keypoints,points";
}

std::optional<std::string> landmark_line(const panvo_msgs::msg::PanoramicLandmark& landmark) {
  const auto& p = landmark.pose().pose().position();
  const auto& q = landmark.pose().pose().orientation();
  const auto& covariance = landmark.pose().covariance();
  std::string line = stamp_of(landmark) + ',' + std::to_string(landmark.id()) + (landmark.is_junction() ? ",1" : ",0");
  for (const double number :
       {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w(), std::sqrt(covariance[0]), std::sqrt(covariance[7])}) {
    if (!std::isfinite(number)) return std::nullopt;
    line += ',' + runtime::to_text(number);
  }
  const auto& keypoints = landmark.keypoints();
  const auto points =
      std::count_if(keypoints.begin(), keypoints.end(), [](const auto& keypoint) { return keypoint.has_point(); });
  return line + ',' + std::to_string(keypoints.size()) + ',' + std::to_string(points);
}

std::string match_header() {
  return "stamp_ns,state,landmark_id,heading_deg,histogram_distance,large_distance,small_distance,candidates,"
         "kept_after_histogram,kept_after_large,reason";
}

std::optional<std::string> match_line(const panvo_msgs::msg::LandmarkMatch& match) {
  if (!std::isfinite(match.heading_rad())) return std::nullopt;
  std::string line =
      stamp_of(match) + ',' + name_of(kMatchStates, match.state()) + ',' + std::to_string(match.landmark_id());
  line += ',' +
          (match.landmark_id() != 0 ? runtime::to_text(match.heading_rad() * 180.0 / std::numbers::pi) : std::string());
  for (const double distance : {match.histogram_distance(), match.large_distance(), match.small_distance()}) {
    line += ',' + number_or_nothing(distance);
  }
  for (const auto count : {match.candidates(), match.kept_after_histogram(), match.kept_after_large()}) {
    line += ',' + std::to_string(count);
  }
  return line + ',' + quoted(match.reason());
}

}  // namespace panvo::runner
