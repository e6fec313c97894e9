// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/compass_score.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <vector>

#include "panvo/vision/angle.hpp"
#include "panvo/vision/equirectangular.hpp"

namespace panvo::evaluation {
namespace {

constexpr std::size_t kDriftPanoramas = 50;

/// Yaw of the vehicle at `now` minus that at `then`, about its upward axis at `then`.
double true_change_rad(const RecordedPanorama& then, const RecordedPanorama& now) {
  return yaw_of(then.world_from_base.inverse() * now.world_from_base);
}

/// Errors of the heading accumulated from valid changes. No valid change leads to a reference taken after failures: the
/// turn up to it is unknown, and a new chain begins.
class HeadingErrors {
 public:
  void add(std::int64_t from_ns, std::int64_t to_ns, double change_error_rad) {
    const auto [from, is_unknown] = at_.try_emplace(from_ns, 0.0);
    if (is_unknown) chains_.emplace_back();
    const double error = from->second + change_error_rad;
    at_[to_ns] = error;
    chains_.back().push_back(error);
  }

  /// RMS over all windows of kDriftPanoramas within a chain; nullopt if there are none.
  std::optional<double> drift_rms_rad() const {
    double squares = 0.0;
    int windows = 0;
    for (const auto& errors : chains_) {
      for (std::size_t i = kDriftPanoramas; i < errors.size(); ++i, ++windows) {
        squares += std::pow(errors[i] - errors[i - kDriftPanoramas], 2);
      }
    }
    if (windows == 0) return std::nullopt;
    return std::sqrt(squares / windows);
  }

 private:
  std::map<std::int64_t, double> at_;
  std::vector<std::vector<double>> chains_;
};

}  // namespace

CompassScore score_compass(const Eigen::Matrix3d& base_from_panorama, const std::vector<RecordedPanorama>& panoramas,
                           const panoramic_compass::CompassParameters& parameters,
                           const std::function<void(const panoramic_compass::AzimuthChange&, double)>& look) {
  panoramic_compass::PanoramicCompass compass(parameters, 1, base_from_panorama);
  CompassScore score;
  std::map<std::int64_t, const RecordedPanorama*> by_stamp;
  std::vector<double> errors;
  double squares = 0.0, whitened = 0.0, step_squares = 0.0, last_error = 0.0;
  int steps = 0;
  std::int64_t last_from = -1;
  HeadingErrors headings;
  for (const RecordedPanorama& panorama : panoramas) {
    by_stamp[panorama.stamp_ns] = &panorama;
    const auto change = compass.track(panorama.stamp_ns, cv::imread(panorama.file.string()));
    if (!change) continue;
    ++score.changes;
    const double truth = true_change_rad(*by_stamp.at(change->from_stamp_ns), panorama);
    if (look) look(*change, truth);
    if (!change->valid) {
      last_from = -1;
      continue;
    }
    ++score.valid;
    const double error = vision::wrap(change->change_rad - truth, 2.0 * std::numbers::pi);
    squares += error * error;
    whitened += error * error / change->variance_rad2;
    if (errors.empty() || std::abs(error) > *std::max_element(errors.begin(), errors.end())) {
      score.worst_ns = panorama.stamp_ns;
    }
    errors.push_back(std::abs(error));
    const double step_error = change->from_stamp_ns == last_from ? error - last_error : error;
    headings.add(change->from_stamp_ns, panorama.stamp_ns, error);
    step_squares += step_error * step_error;
    ++steps;
    last_from = change->from_stamp_ns;
    last_error = error;
  }
  if (errors.empty()) return score;
  const auto count = static_cast<double>(errors.size());
  std::sort(errors.begin(), errors.end());
  score.rms_deg = std::sqrt(squares / count) / vision::kDegree;
  score.p95_deg = errors[errors.size() * 95 / 100] / vision::kDegree;
  score.worst_deg = errors.back() / vision::kDegree;
  score.consistency = whitened / count;
  if (const auto drift_rad = headings.drift_rms_rad()) score.drift_rms_deg = *drift_rad / vision::kDegree;
  score.step_rms_deg = std::sqrt(step_squares / steps) / vision::kDegree;
  return score;
}

}  // namespace panvo::evaluation
