// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/relative_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "panvo/evaluation/input_error.hpp"
#include "panvo/evaluation/pose_error.hpp"

namespace panvo::evaluation {
namespace {

// Rounding can make a sum of steps slightly too short, which would extend a segment by a whole frame.
constexpr double kLengthToleranceM = 1e-9;
constexpr double kMinKittiLengthM = 100.0;

struct RelativeError {
  double translation_m = 0.0;
  double rotation_deg = 0.0;
};

RelativeError relative_error(const PosePair& from, const PosePair& to) {
  const Eigen::Isometry3d truth = from.map_from_base.inverse() * to.map_from_base;
  const Eigen::Isometry3d estimate = from.odom_from_base.inverse() * to.odom_from_base;
  const Eigen::Isometry3d error = truth.inverse() * estimate;
  return {error.translation().norm(), rotation_vector(error.linear()).norm() * 180.0 / std::numbers::pi};
}

// Index of the first pair at least `length_m` after `first`; the number of pairs if there is none.
std::size_t end_of_segment(const std::vector<double>& distances, std::size_t first, double length_m) {
  const auto end = std::lower_bound(distances.begin() + static_cast<std::ptrdiff_t>(first), distances.end(),
                                    distances[first] + length_m - kLengthToleranceM);
  return static_cast<std::size_t>(end - distances.begin());
}

std::optional<RelativePoseError> summarize_errors(const std::vector<RelativeError>& errors) {
  std::vector<double> translations;
  std::vector<double> rotations;
  for (const RelativeError& error : errors) {
    translations.push_back(error.translation_m);
    rotations.push_back(error.rotation_deg);
  }
  const auto translation = summarize(std::move(translations));
  const auto rotation = summarize(std::move(rotations));
  if (!translation || !rotation) return std::nullopt;
  return RelativePoseError{*translation, *rotation};
}

}  // namespace

std::vector<double> suitable_segment_lengths_m(double path_length_m) {
  const double unit = path_length_m >= 200.0 ? 100.0 : path_length_m >= 50.0 ? 10.0 : 0.1 * path_length_m;
  const int count = path_length_m >= 200.0 ? 8 : 5;
  std::vector<double> lengths;
  for (int i = 1; i <= count && unit > 0.0; ++i) lengths.push_back(unit * i);
  return lengths;
}

std::optional<SegmentErrors> segment_errors(std::span<const PosePair> pairs, const SegmentOptions& options) {
  const std::vector<double> distances = distances_m(pairs);
  if (distances.empty()) return std::nullopt;
  const std::vector<double> lengths =
      options.lengths_m.empty() ? suitable_segment_lengths_m(distances.back()) : options.lengths_m;
  for (const double length : lengths) {
    if (!(length > 0.0) || !std::isfinite(length)) {
      throw InputError("segment length " + std::to_string(length) + " m: must be positive; lengths are in metres");
    }
  }
  if (lengths.empty()) return std::nullopt;
  const bool as_kitti = *std::min_element(lengths.begin(), lengths.end()) >= kMinKittiLengthM;
  const std::size_t step = options.step > 0 ? options.step : as_kitti ? 10 : 1;

  SegmentErrors result;
  for (const double length : lengths) {
    SegmentError sum{length, 0, 0.0, 0.0};
    for (std::size_t first = 0; first < pairs.size(); first += step) {
      const std::size_t last = end_of_segment(distances, first, length);
      if (last == pairs.size()) break;
      const RelativeError error = relative_error(pairs[first], pairs[last]);
      sum.translation_percent += 100.0 * error.translation_m / length;
      sum.rotation_deg_per_m += error.rotation_deg / length;
      ++sum.count;
    }
    if (sum.count == 0) continue;
    result.count += sum.count;
    result.translation_percent += sum.translation_percent;
    result.rotation_deg_per_m += sum.rotation_deg_per_m;
    sum.translation_percent /= static_cast<double>(sum.count);
    sum.rotation_deg_per_m /= static_cast<double>(sum.count);
    result.by_length.push_back(sum);
  }
  if (result.count == 0) return std::nullopt;
  result.translation_percent /= static_cast<double>(result.count);
  result.rotation_deg_per_m /= static_cast<double>(result.count);
  return result;
}

std::optional<RelativePoseError> relative_error_per_frame(std::span<const PosePair> pairs) {
  std::vector<std::int64_t> periods;
  for (std::size_t i = 1; i < pairs.size(); ++i) periods.push_back(pairs[i].stamp_ns - pairs[i - 1].stamp_ns);
  if (periods.empty()) return std::nullopt;
  std::vector<std::int64_t> sorted = periods;
  std::sort(sorted.begin(), sorted.end());
  const double max_ns = 1.5 * static_cast<double>(sorted[sorted.size() / 2]);
  std::vector<RelativeError> errors;
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    if (static_cast<double>(periods[i - 1]) <= max_ns) errors.push_back(relative_error(pairs[i - 1], pairs[i]));
  }
  return summarize_errors(errors);
}

std::optional<RelativePoseError> relative_error_per_metre(std::span<const PosePair> pairs) {
  const std::vector<double> distances = distances_m(pairs);
  std::vector<RelativeError> errors;
  for (std::size_t first = 0; first < pairs.size(); ++first) {
    const std::size_t last = end_of_segment(distances, first, 1.0);
    if (last == pairs.size()) break;
    const double length_m = distances[last] - distances[first];
    const RelativeError error = relative_error(pairs[first], pairs[last]);
    errors.push_back({error.translation_m / length_m, error.rotation_deg / length_m});
  }
  return summarize_errors(errors);
}

}  // namespace panvo::evaluation
