// SPDX-License-Identifier: Apache-2.0
#include "panvo/places/place_finder.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "panvo/landmarks/landmark_distance.hpp"

namespace panvo::places {

PlaceFinder::PlaceFinder(std::vector<KnownPlace> places, const PlaceFinderParameters& parameters)
    : places_(std::move(places)), parameters_(parameters) {}

PlaceAnswer PlaceFinder::find(const PanoramaImage& image) const {
  PlaceAnswer answer;
  if (places_.empty()) {
    answer.shared.reason = "the library is empty";
    return answer;
  }
  const auto keypoints = detect_keypoints(image.grey, place_keypoints(), image.seen);
  const double log10_places = std::log10(static_cast<double>(places_.size()));
  for (const std::size_t i : most_similar(image)) {
    auto shared = find_shared_view(keypoints, places_[i].keypoints, log10_places, parameters_.view);
    const bool is_first = answer.verified++ == 0;
    answer.agreeing_places += shared.view ? 1 : 0;
    const bool is_better = shared.view.has_value() != answer.shared.view.has_value()
                               ? shared.view.has_value()
                               : shared.log10_expected < answer.shared.log10_expected;
    if (!is_first && !is_better) continue;
    answer.nearest = i;
    answer.shared = std::move(shared);
  }
  if (answer.shared.view) {
    answer.place = answer.nearest;
    answer.position = metric_position(keypoints, places_[answer.nearest], answer.shared.view->heading_rad);
  }
  return answer;
}

std::vector<std::size_t> PlaceFinder::most_similar(const PanoramaImage& image) const {
  std::vector<std::size_t> order(places_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto most = std::min(order.size(), static_cast<std::size_t>(parameters_.max_verified));
  if (most == order.size()) return order;
  const auto query = place_describer().query(image.grey);
  std::vector<float> distances;
  for (const auto& place : places_) distances.push_back(match_large_scale(query, place.description).distance);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return distances[a] < distances[b]; });
  order.resize(most);
  return order;
}

}  // namespace panvo::places
