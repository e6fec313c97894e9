// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/landmark_library.hpp"
#include "panvo/interfaces/place_rules.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace panvo::landmarks {
namespace {

// Typical distance of landmarks; a search visits (2 radius / cell + 1)^2 cells.
constexpr double kCell_m = 20.0;
// Beyond any journey, and well within the range of a cell index.
constexpr double kMaxCoordinate_m = 1e12;

double horizontal_distance(const PanoramicLandmark& landmark, const Eigen::Vector3d& position) {
  return (landmark.map_from_base.translation() - position).head<2>().norm();
}

void check_pose(const Eigen::Isometry3d& map_from_base, std::uint32_t id) {
  if (!map_from_base.matrix().allFinite()) {
    throw std::invalid_argument("landmark " + std::to_string(id) + ": its pose is not finite");
  }
}

bool has_lower_id(const PanoramicLandmark* a, const PanoramicLandmark* b) { return a->id < b->id; }

}  // namespace

bool fits(const PanoramaDescription& description, const DescriptionLimits& limits) {
  const auto is_of_matrix = [&](const AdaptiveFeature& feature) { return feature.row < limits.rows; };
  return std::all_of(description.large.begin(), description.large.end(), is_of_matrix) &&
         std::all_of(description.small.begin(), description.small.end(), is_of_matrix) &&
         (!limits.bins || description.histogram.size() == *limits.bins);
}

LandmarkLibrary::LandmarkLibrary(std::shared_ptr<const LandmarkSource> source, DescriptionLimits limits)
    : source_(std::move(source)), limits_(limits) {}

std::uint32_t LandmarkLibrary::add(PanoramicLandmark landmark) {
  if (landmark.id == 0) landmark.id = next_id();
  if (landmark.id > interfaces::kMaxLandmarkId) throw std::invalid_argument("the library has no ids left");
  check_pose(landmark.map_from_base, landmark.id);
  if (!fits(landmark.description, limits_)) {
    throw std::invalid_argument("landmark " + std::to_string(landmark.id) +
                                ": its description does not fit the measurement matrices or the histogram");
  }
  const auto at = index_from(landmark.id);
  if (at < by_id_.size() && by_id_[at]->id == landmark.id) {
    throw std::invalid_argument("landmark " + std::to_string(landmark.id) + " is already in the library");
  }
  index_.add(landmark.id, landmark.description);
  if (source_) {
    landmark.description = PanoramaDescription();
    // swap() releases the memory; `= {}` would keep it
    std::vector<Keypoint>().swap(landmark.keypoints);
    std::vector<std::uint8_t>().swap(landmark.thumbnail);
  }
  auto& kept = landmarks_.emplace_back(std::move(landmark));
  by_id_.insert(by_id_.begin() + static_cast<std::ptrdiff_t>(at), &kept);
  put_into_cell(kept);
  return kept.id;
}

bool LandmarkLibrary::set_pose(std::uint32_t id, const Eigen::Isometry3d& map_from_base,
                               const Eigen::Matrix<double, 6, 6>& covariance) {
  check_pose(map_from_base, id);
  const auto at = index_from(id);
  if (at == by_id_.size() || by_id_[at]->id != id) return false;
  auto& landmark = *by_id_[at];
  take_from_cell(landmark);
  landmark.map_from_base = map_from_base;
  landmark.covariance = covariance;
  put_into_cell(landmark);
  return true;
}

const PanoramicLandmark* LandmarkLibrary::find(std::uint32_t id) const {
  const auto at = index_from(id);
  return at < by_id_.size() && by_id_[at]->id == id ? by_id_[at] : nullptr;
}

std::vector<const PanoramicLandmark*> LandmarkLibrary::within(const Eigen::Vector3d& position, double radius_m) const {
  std::vector<const PanoramicLandmark*> found;
  if (!(radius_m >= 0.0) || !position.head<2>().allFinite()) return found;
  const auto take_near = [&](const auto& landmarks) {
    for (const auto* landmark : landmarks) {
      if (horizontal_distance(*landmark, position) <= radius_m) found.push_back(landmark);
    }
  };
  const double cells_across = 2.0 * radius_m / kCell_m + 1.0;
  if (cells_across * cells_across > static_cast<double>(cells_.size())) {  // fewer landmarks than cells to visit
    take_near(by_id_);
    return found;
  }
  const auto [first_x, first_y] = cell_of(position - Eigen::Vector3d::Constant(radius_m));
  const auto [last_x, last_y] = cell_of(position + Eigen::Vector3d::Constant(radius_m));
  for (std::int64_t x = first_x; x <= last_x; ++x) {
    for (auto cell = cells_.lower_bound({x, first_y}); cell != cells_.end() && cell->first <= Cell{x, last_y}; ++cell) {
      take_near(cell->second);
    }
  }
  std::sort(found.begin(), found.end(), has_lower_id);
  return found;
}

std::optional<LandmarkLibrary::Near> LandmarkLibrary::nearest(const Eigen::Vector3d& position) const {
  if (by_id_.empty() || !position.head<2>().allFinite()) return std::nullopt;
  std::vector<const PanoramicLandmark*> candidates;
  for (double radius = kCell_m; candidates.empty(); radius *= 2.0) {
    // Beyond this radius within() visits all landmarks anyway.
    candidates = within(position, radius > kMaxCoordinate_m ? std::numeric_limits<double>::infinity() : radius);
  }
  Near best{nullptr, std::numeric_limits<double>::infinity()};
  for (const auto* candidate : candidates) {
    const double distance = horizontal_distance(*candidate, position);
    if (!best.landmark || distance < best.distance_m) best = {candidate, distance};
  }
  return best;
}

std::vector<Keypoint> LandmarkLibrary::keypoints(std::uint32_t id) const {
  if (source_) return source_->keypoints(id);
  const auto* landmark = find(id);
  return landmark ? landmark->keypoints : std::vector<Keypoint>{};
}

PanoramaDescription LandmarkLibrary::description(std::uint32_t id) const {
  if (source_) return source_->description(id);
  const auto* landmark = find(id);
  return landmark ? landmark->description : PanoramaDescription();
}

LandmarkLibrary::Cell LandmarkLibrary::cell_of(const Eigen::Vector3d& position) {
  const auto index = [](double coordinate) {
    return static_cast<std::int64_t>(std::floor(std::clamp(coordinate, -kMaxCoordinate_m, kMaxCoordinate_m) / kCell_m));
  };
  return {index(position.x()), index(position.y())};
}

std::size_t LandmarkLibrary::index_from(std::uint32_t id) const {
  const auto found = std::lower_bound(by_id_.begin(), by_id_.end(), id,
                                      [](const auto* landmark, std::uint32_t value) { return landmark->id < value; });
  return static_cast<std::size_t>(found - by_id_.begin());
}

void LandmarkLibrary::put_into_cell(const PanoramicLandmark& landmark) {
  cells_[cell_of(landmark.map_from_base.translation())].push_back(&landmark);
}

void LandmarkLibrary::take_from_cell(const PanoramicLandmark& landmark) {
  const auto cell = cells_.find(cell_of(landmark.map_from_base.translation()));
  std::erase(cell->second, &landmark);
  if (cell->second.empty()) cells_.erase(cell);
}

}  // namespace panvo::landmarks
