// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/place_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "angle_units.hpp"
#include "panvo/vision/equirectangular.hpp"

namespace panvo::evaluation {
namespace {

constexpr double kNearby_m =
    15.0;  // distance travelled from the closest approach within which the nearest panorama is searched

double flat_distance(const RecordedPanorama& a, const RecordedPanorama& b) {
  return (a.world_from_base.translation() - b.world_from_base.translation()).head<2>().norm();
}

double true_turn(const RecordedPanorama& now, const RecordedPanorama& then) {
  return vision::wrap(yaw_of(now.world_from_base) - yaw_of(then.world_from_base), 2.0 * std::numbers::pi);
}

/// The panorama of the same pass that is nearest to the known one.
std::size_t nearest_of_pass(const PlaceRecording& recording, const RecordedVisit& visit,
                            const RecordedPanorama& known) {
  const auto& all = recording.panoramas;
  std::size_t best = visit.panorama;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (std::abs(all[i].travelled_m - all[visit.panorama].travelled_m) > kNearby_m) continue;
    if (flat_distance(all[i], known) < flat_distance(all[best], known)) best = i;
  }
  return best;
}

struct Nearest {
  std::size_t place = 0;
  PlaceDistance distance{std::numeric_limits<double>::infinity(), 0.0};
};

using Descriptors = std::vector<std::unique_ptr<PlaceDescriptor>>;

Nearest nearest_place(const PlaceMethod& method, const PlaceDescriptor& query, const Descriptors& places,
                      std::size_t but_not) {
  Nearest nearest;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i == but_not) continue;
    const auto distance = method.distance(query, *places[i]);
    if (distance.distance < nearest.distance.distance) nearest = {i, distance};
  }
  return nearest;
}

double mean_distance(const std::vector<PlaceSample>& samples) {
  double sum = 0.0;
  for (const auto& sample : samples) sum += sample.distance;
  return samples.empty() ? 0.0 : sum / static_cast<double>(samples.size());
}

/// D' [Lu2015 Eq. 14]
void scale_to_unit(PlaceScore& score) {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (const auto* samples : {&score.positives, &score.negatives}) {
    for (const auto& sample : *samples) {
      least = std::min(least, sample.distance);
      most = std::max(most, sample.distance);
    }
  }
  for (auto* samples : {&score.positives, &score.negatives}) {
    for (auto& sample : *samples) sample.distance = most > least ? (sample.distance - least) / (most - least) : 0.0;
  }
}

}  // namespace

PlaceTask place_task(const PlaceRecording& first, const PlaceRecording* then) {
  PlaceTask task;
  std::map<int, std::size_t> known;
  const auto revisit = [&](const PlaceRecording& recording, const RecordedVisit& visit, std::size_t index) {
    const auto& then_panorama = first.panoramas[task.places[index].panorama];
    const auto panorama = nearest_of_pass(recording, visit, then_panorama);
    const auto& now = recording.panoramas[panorama];
    task.revisits.push_back({index, panorama, true_turn(now, then_panorama), flat_distance(now, then_panorama)});
  };
  for (const auto& visit : first.visits) {
    const auto [found, is_new] = known.try_emplace(visit.place, task.places.size());
    if (is_new) {
      task.places.push_back({visit.place, visit.panorama});
    } else if (then == nullptr) {
      revisit(first, visit, found->second);
    }
  }
  if (then != nullptr) {
    for (const auto& visit : then->visits) {
      const auto found = known.find(visit.place);
      if (found != known.end()) revisit(*then, visit, found->second);
    }
  }
  return task;
}

PlaceScore score_places(const PlaceMethod& method, const PlaceTask& task, const PlaceRecording& first,
                        const PlaceRecording& then) {
  constexpr auto kNone = std::numeric_limits<std::size_t>::max();
  PlaceScore score;
  score.method = method.name();
  Descriptors places;
  Descriptors queries;
  for (const auto& place : task.places) {
    const auto image = read_panorama(first.panoramas[place.panorama]);
    places.push_back(method.describe_landmark(image));
    queries.push_back(method.describe_query(image));
  }
  for (std::size_t i = 0; i < places.size() && places.size() > 1; ++i) {
    const auto nearest = nearest_place(method, *queries[i], places, i);
    score.negatives.push_back({i, nearest.place, nearest.distance.distance, 0.0, false});
  }
  for (std::size_t i = 0; i < task.revisits.size(); ++i) {
    const auto& revisit = task.revisits[i];
    const auto query = method.describe_query(read_panorama(then.panoramas[revisit.panorama]));
    const auto nearest = nearest_place(method, *query, places, kNone);
    const double error = vision::wrap(nearest.distance.heading_rad - revisit.entrance_rad, 2.0 * std::numbers::pi);
    score.positives.push_back({i, nearest.place, nearest.distance.distance, error, nearest.place == revisit.known});
  }
  scale_to_unit(score);
  score.separation = mean_distance(score.negatives) - mean_distance(score.positives);  // [Lu2015 Eq. 13]

  double threshold = -std::numeric_limits<double>::infinity();
  double least_wrong = std::numeric_limits<double>::infinity();
  std::vector<double> errors;
  for (const auto& sample : score.positives) {
    if (!sample.is_right) {
      least_wrong = std::min(least_wrong, sample.distance);
      continue;
    }
    ++score.true_positives;
    threshold = std::max(threshold, sample.distance);
    errors.push_back(std::abs(sample.heading_error_rad));
  }
  for (const auto& sample : score.negatives) {
    score.false_positives += sample.distance <= threshold ? 1 : 0;
    least_wrong = std::min(least_wrong, sample.distance);
  }
  score.revisits = static_cast<int>(score.positives.size());
  const int passed = score.true_positives + score.false_positives;
  score.recall = score.revisits > 0 ? static_cast<double>(score.true_positives) / score.revisits : 0.0;
  const auto sure = std::count_if(score.positives.begin(), score.positives.end(), [&](const PlaceSample& sample) {
    return sample.is_right && sample.distance < least_wrong;
  });
  score.recall_at_full_precision = score.revisits > 0 ? static_cast<double>(sure) / score.revisits : 0.0;
  score.precision = passed > 0 ? static_cast<double>(score.true_positives) / passed : 0.0;
  if (!errors.empty()) {
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
    score.median_heading_error_rad = errors[errors.size() / 2];
  }
  return score;
}

std::string place_table(const std::vector<PlaceScore>& scores) {
  std::string text = fmt::format("{:<28} {:>6} {:>4} {:>4} {:>7} {:>10} {:>15} {:>14}\n", "Method", "V_sc", "TP", "FP",
                                 "Recall", "Precision", "Recall at P = 1", "heading (deg)");
  for (const auto& score : scores) {
    text += fmt::format("{:<28} {:>6.2f} {:>4} {:>4} {:>7.2f} {:>10.2f} {:>15.2f} {:>14.1f}\n", score.method,
                        score.separation, score.true_positives, score.false_positives, score.recall, score.precision,
                        score.recall_at_full_precision, score.median_heading_error_rad * kDegrees);
  }
  return text;
}

}  // namespace panvo::evaluation
