// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <string>

#include "panvo/interfaces/topic.hpp"
#include "panvo_msgs/msg/CorrectionOutcome.h"
#include "panvo_msgs/msg/LandmarkPoses.h"
#include "panvo_msgs/msg/PanoramicLandmark.h"
#include "visualization_msgs/msg/MarkerArray.h"

namespace panvo::markers {

/// Places and sightings, for viewers.
inline constexpr interfaces::Topic<visualization_msgs::msg::MarkerArray> kPlaceMarkers{
    "places/markers", {.durability = interfaces::Durability::kTransientLocal, .depth = 1}};

struct SceneParameters {
  double size_m = 1.5;
  bool ids = true;
  int max_sightings = 500;

  template <class Field>
  static void describe(Field&& field) {
    using P = SceneParameters;
    field(&P::size_m, "size_m", "m", "diameter of a place", 0.01, 100.0);
    field(&P::ids, "ids", "", "show the numbers of the places");
    field(&P::max_sightings, "max_sightings", "", "number of sightings shown; the oldest are dropped", 0, 100000);
  }
};

/// What is known of the places, as markers.
class PlaceScene {
 public:
  explicit PlaceScene(const SceneParameters& parameters) : parameters_(parameters) {}

  void add(const panvo_msgs::msg::PanoramicLandmark& landmark);
  void add(const panvo_msgs::msg::LandmarkPoses& poses);
  /// A sighting of an unknown place is shown once the place is known.
  void add(const panvo_msgs::msg::CorrectionOutcome& outcome);

  /// Whether anything was added since the last markers().
  bool has_changed() const noexcept { return has_changed_; }
  /// One marker of spheres, two of lines, and one for each number; empty without places.
  visualization_msgs::msg::MarkerArray markers();

 private:
  struct Place {
    geometry_msgs::msg::Pose map_from_base;
    bool is_junction = false;
    bool is_of_this_journey = false;
  };
  struct Sighting {
    std::uint32_t place;
    std::uint8_t outcome;
    geometry_msgs::msg::Point from;
  };
  using Marker = visualization_msgs::msg::Marker;

  Marker marker(const char* name_space, std::int32_t type, double width_m) const;
  Marker places() const;
  Marker headings() const;
  Marker sightings() const;
  Marker id(std::uint32_t number, const Place& place) const;

  SceneParameters parameters_;
  std_msgs::msg::Header header_;  // of the newest message
  std::map<std::uint32_t, Place> places_;
  std::deque<Sighting> sightings_;
  bool has_changed_ = false;
};

}  // namespace panvo::markers
