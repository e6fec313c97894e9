// SPDX-License-Identifier: Apache-2.0
#include "panvo/interfaces/place_rules.hpp"
#include "panvo/interfaces/validity.hpp"
#include "validity_parts.hpp"

namespace panvo::interfaces {
namespace {

constexpr std::size_t kMaxLandmarks = 1'000'000;  // ten thousand landmarks cover a town

void check_features(Check& check, std::string_view name, const std::vector<panvo_msgs::msg::AdaptiveFeature>& features,
                    const DescriptionSize& size) {
  FeatureRule rule(check, name, features.size(), size);
  for (const auto& feature : features) {
    if (!check.holds()) return;
    rule.check(feature.row(), feature.value(), feature.scale(), feature.weight());
  }
}

}  // namespace

Problem problem_of(const panvo_msgs::msg::PanoramicLandmark& message) {
  Check check;
  check_header(check, message.header());
  check.require(message.id() != 0, "id", "is 0");
  check.require(message.id() <= kMaxLandmarkId, "id", "is above 4000000000");
  check_pose(check, "pose.pose", message.pose().pose());
  check.covariance("pose.covariance", message.pose().covariance());
  check_pose(check, "panorama_pose", message.panorama_pose());
  check.text("settings", message.settings());
  check.at_most("thumbnail", message.thumbnail().size(), kMaxThumbnail);
  check.at_most("keypoints", message.keypoints().size(), kMaxKeypoints);
  if (!check.holds()) return check.problem();
  const auto size = description_size(message.settings());
  check_histogram(check, message.histogram(), size);
  check_features(check, "large_features", message.large_features(), size);
  check_features(check, "small_features", message.small_features(), size);
  for (const auto& keypoint : message.keypoints()) {
    if (!check.holds()) break;
    check_keypoint(check, keypoint.bearing(), keypoint.size_px(), keypoint.has_point(), keypoint.point(),
                   keypoint.inverse_range_sigma());
  }
  return check.problem();
}

Problem problem_of(const panvo_msgs::msg::LandmarkPoses& message) {
  Check check;
  check_header(check, message.header());
  check.at_most("ids", message.ids().size(), kMaxLandmarks);
  check.require(message.ids().size() == message.poses().size(), "poses", "differ in number from ids");
  for (const auto id : message.ids()) {
    check.require(id != 0, "ids", "contain 0");
    check.require(id <= kMaxLandmarkId, "ids", "contain one above 4000000000");
  }
  for (const auto& pose : message.poses()) {
    if (!check.holds()) break;
    check_pose(check, "poses.pose", pose.pose());
    check.covariance("poses.covariance", pose.covariance());
  }
  return check.problem();
}

Problem problem_of(const panvo_msgs::msg::LandmarkMatch& message) {
  Check check;
  check_header(check, message.header());
  check.within("state", message.state(), panvo_msgs::msg::LandmarkMatch_Constants::SEARCHING,
               panvo_msgs::msg::LandmarkMatch_Constants::UNUSABLE);
  check.text("reason", message.reason());
  check.finite("heading_rad", {message.heading_rad()});  // distances are NaN for levels that were not compared
  return check.problem();
}

}  // namespace panvo::interfaces
