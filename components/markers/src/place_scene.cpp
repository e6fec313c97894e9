// SPDX-License-Identifier: Apache-2.0
#include "place_scene.hpp"

#include <algorithm>
#include <array>

#include "panvo/conversions/pose.hpp"

namespace panvo::markers {
namespace {

namespace kinds = visualization_msgs::msg::Marker_Constants;
namespace outcomes = panvo_msgs::msg::CorrectionOutcome_Constants;

// In sizes of a place.
constexpr double kHeadingLength = 2.0, kJunctionHeadingLength = 4.0, kHeadingWidth = 0.15;
constexpr double kSightingWidth = 0.1;
constexpr double kTextHeight = 0.8, kTextBeside = 1.2;
constexpr std::array kGreen{0.0F, 0.62F, 0.45F}, kGrey{0.6F, 0.6F, 0.6F}, kOrange{0.84F, 0.37F, 0.0F};
constexpr std::array kTextGrey{0.45F, 0.45F, 0.45F};  // readable on light and on dark backgrounds

std_msgs::msg::ColorRGBA colour(const std::array<float, 3>& rgb) {
  std_msgs::msg::ColorRGBA colour;
  colour.r(rgb[0]);
  colour.g(rgb[1]);
  colour.b(rgb[2]);
  colour.a(1.0F);
  return colour;
}

std_msgs::msg::ColorRGBA colour_of(std::uint8_t outcome) {
  return colour(outcome == outcomes::APPLIED ? kGreen : outcome == outcomes::BETTER_KNOWN ? kGrey : kOrange);
}

/// A point relative to a pose: forward, left, up.
geometry_msgs::msg::Point at(const geometry_msgs::msg::Pose& pose, const Eigen::Vector3d& offset_m) {
  const auto map_from_base = conversions::to_isometry(pose);
  if (!map_from_base) return pose.position();
  const Eigen::Vector3d there = *map_from_base * offset_m;
  geometry_msgs::msg::Point point;
  point.x(there.x());
  point.y(there.y());
  point.z(there.z());
  return point;
}

}  // namespace

void PlaceScene::add(const panvo_msgs::msg::PanoramicLandmark& landmark) {
  Place& place = places_[landmark.id()];
  if (!place.is_of_this_journey) place.map_from_base = landmark.pose().pose();  // else it has been moved since
  place.is_junction = landmark.is_junction();
  header_ = landmark.header();
  has_changed_ = true;
}

void PlaceScene::add(const panvo_msgs::msg::LandmarkPoses& poses) {
  for (std::size_t i = 0; i < std::min(poses.ids().size(), poses.poses().size()); ++i) {
    Place& place = places_[poses.ids()[i]];
    place.map_from_base = poses.poses()[i].pose();
    place.is_of_this_journey = true;
  }
  header_ = poses.header();
  has_changed_ = true;
}

void PlaceScene::add(const panvo_msgs::msg::CorrectionOutcome& outcome) {
  sightings_.push_back({outcome.landmark_id(), outcome.outcome(), outcome.after().position()});
  while (sightings_.size() > static_cast<std::size_t>(parameters_.max_sightings)) sightings_.pop_front();
  has_changed_ = true;
}

visualization_msgs::msg::MarkerArray PlaceScene::markers() {
  has_changed_ = false;
  visualization_msgs::msg::MarkerArray scene;
  if (places_.empty()) return scene;
  scene.markers({places(), headings(), sightings()});
  if (!parameters_.ids) return scene;
  for (const auto& [number, place] : places_) scene.markers().push_back(id(number, place));
  return scene;
}

PlaceScene::Marker PlaceScene::marker(const char* name_space, std::int32_t type, double width_m) const {
  Marker marker;
  marker.header(header_);
  marker.ns(name_space);
  marker.type(type);
  marker.action(kinds::ADD);
  marker.pose().orientation().w(1.0);
  marker.scale().x(width_m);
  marker.scale().y(width_m);
  marker.scale().z(width_m);
  marker.color(colour(kGrey));
  return marker;
}

PlaceScene::Marker PlaceScene::places() const {
  Marker spheres = marker("places", kinds::SPHERE_LIST, parameters_.size_m);
  for (const auto& [number, place] : places_) {
    spheres.points().push_back(place.map_from_base.position());
    spheres.colors().push_back(colour(place.is_of_this_journey ? kGreen : kGrey));
  }
  return spheres;
}

PlaceScene::Marker PlaceScene::headings() const {
  Marker lines = marker("headings", kinds::LINE_LIST, kHeadingWidth * parameters_.size_m);
  for (const auto& [number, place] : places_) {
    const double length_m = parameters_.size_m * (place.is_junction ? kJunctionHeadingLength : kHeadingLength);
    lines.points().push_back(place.map_from_base.position());
    lines.points().push_back(at(place.map_from_base, {length_m, 0.0, 0.0}));
  }
  return lines;
}

PlaceScene::Marker PlaceScene::sightings() const {
  Marker lines = marker("sightings", kinds::LINE_LIST, kSightingWidth * parameters_.size_m);
  for (const Sighting& sighting : sightings_) {
    const auto place = places_.find(sighting.place);
    if (place == places_.end()) continue;
    lines.points().push_back(sighting.from);
    lines.points().push_back(place->second.map_from_base.position());
    lines.colors().resize(lines.points().size(), colour_of(sighting.outcome));
  }
  if (lines.points().empty()) lines.action(kinds::DELETE);  // viewers complain about lines without points
  return lines;
}

PlaceScene::Marker PlaceScene::id(std::uint32_t number, const Place& place) const {
  Marker text = marker("ids", kinds::TEXT_VIEW_FACING, kTextHeight * parameters_.size_m);
  text.id(static_cast<std::int32_t>(number));
  text.pose(place.map_from_base);
  // Above the place, it would be in front of the sphere when seen from above; ahead, on the path.
  text.pose().position(at(place.map_from_base, {0.0, kTextBeside * parameters_.size_m, 0.0}));
  text.color(colour(kTextGrey));
  text.text(std::to_string(number));
  return text;
}

}  // namespace panvo::markers
