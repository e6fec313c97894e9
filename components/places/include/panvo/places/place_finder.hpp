// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "panvo/places/metric_places.hpp"
#include "panvo/places/panorama_image.hpp"
#include "panvo/places/place_library.hpp"
#include "panvo/places/shared_view.hpp"

namespace panvo::places {

struct PlaceFinderParameters {
  SharedViewParameters view;
  int max_verified = 40;  ///< places compared by geometry, the most similar ones by their compressive features
};

/// The place that a panorama shows, or why none.
struct PlaceAnswer {
  std::optional<std::size_t> place;        ///< index in the library; nullopt: unknown
  SharedViewResult shared;                 ///< with that place; if unknown, with the one that comes closest
  std::size_t nearest = 0;                 ///< index of the place of `shared`
  std::optional<MetricPosition> position;  ///< if the place has points in metres; bearings alone give none
  int verified = 0;                        ///< places compared by geometry
  int agreeing_places = 0;                 ///< of these, how many the geometry accepts
};

/// Finds places by their compressive features [Lu2015 5.1], which rank, and by geometry, which decides.
class PlaceFinder {
 public:
  PlaceFinder(std::vector<KnownPlace> places, const PlaceFinderParameters& parameters);

  PlaceAnswer find(const PanoramaImage& image) const;

  const std::vector<KnownPlace>& places() const { return places_; }

 private:
  std::vector<std::size_t> most_similar(const PanoramaImage& image) const;

  std::vector<KnownPlace> places_;
  PlaceFinderParameters parameters_;
};

}  // namespace panvo::places
