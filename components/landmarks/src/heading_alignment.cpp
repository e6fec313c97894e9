// SPDX-License-Identifier: Apache-2.0
#include "heading_alignment.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>
#include "turn.hpp"

namespace panvo::landmarks {
namespace {

constexpr int kIterations = 10;
constexpr int kHalfStep = 3;  // columns, of the response's derivative
constexpr double kMinSpread = 0.05;
constexpr double kLossScale = 0.3;   // spreads: typical effect of noise and slight parallax on a response
constexpr double kParallax = 12.0;   // columns: prior sigma of the parallax shift
constexpr double kMaxChange = 15.0;  // columns per iteration
constexpr double kReach = 60.0;      // columns from the start: farther is a different heading

/// A feature and the azimuth of its patch, as an angle over the landmark's columns.
struct Observation {
  const AdaptiveFeature* feature;
  int row;
  bool is_intensity;
  double sine, cosine;
};

std::vector<Observation> observe(const vision::MeasurementMatrix& matrix,
                                 const std::vector<AdaptiveFeature>& features) {
  std::vector<Observation> observations;
  for (const AdaptiveFeature& feature : features) {
    const bool is_intensity = feature.row < matrix.rows();
    const int row = is_intensity ? feature.row : feature.row - matrix.rows();
    double sine = 0.0, cosine = 0.0;
    for (const vision::MeasurementMatrix::Element& element : matrix.row(row)) {
      const double angle = kTurn * (element.rectangle.x + 0.5 * element.rectangle.width) / matrix.band().width;
      sine += std::sin(angle);
      cosine += std::cos(angle);
    }
    const double length = std::max(1e-6, std::hypot(sine, cosine));
    observations.push_back({&feature, row, is_intensity, sine / length, cosine / length});
  }
  return observations;
}

}  // namespace

double align_heading(const QueryDescription& query, const PanoramaDescription& landmark, double start_rad) {
  const vision::MeasurementMatrix& matrix = query.basis->small;
  const vision::ResponseReader reader(query.images, matrix, query.normalisation);
  const std::vector<Observation> observations = observe(matrix, landmark.small);
  const double start = start_rad * matrix.band().width / kTurn;
  Eigen::Vector3d shift(start, 0.0, 0.0);  // columns: rotation, and parallax along two directions
  const Eigen::Vector3d prior(0.0, 1.0 / (kParallax * kParallax), 1.0 / (kParallax * kParallax));
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Eigen::Matrix3d information = prior.asDiagonal();
    Eigen::Vector3d gradient = prior.asDiagonal() * Eigen::Vector3d(0.0, shift.y(), shift.z());
    for (const Observation& o : observations) {
      const Eigen::Vector3d by_shift(1.0, o.sine, o.cosine);
      const double place = by_shift.dot(shift);
      const int column = static_cast<int>(std::lround(place));
      const auto read = [&](int du) {
        return static_cast<double>(o.is_intensity ? reader.read_intensity(o.row, du) : reader.read_gradient(o.row, du));
      };
      const double per_spread = 1.0 / std::max<double>(kMinSpread, o.feature->scale);
      const double slope = (read(column + kHalfStep) - read(column - kHalfStep)) / (2.0 * kHalfStep) * per_spread;
      const double residual = (read(column) - o.feature->value) * per_spread + slope * (place - column);
      const double ratio = residual / kLossScale;
      const double weight = o.feature->weight / (kLossScale * kLossScale * (1.0 + ratio * ratio));  // Cauchy loss
      information += weight * slope * slope * by_shift * by_shift.transpose();
      gradient += weight * slope * residual * by_shift;
    }
    Eigen::Vector3d change = information.ldlt().solve(-gradient);
    if (!change.allFinite()) return start_rad;
    change = change.cwiseMax(-kMaxChange).cwiseMin(kMaxChange);
    shift += change;
    if (change.cwiseAbs().maxCoeff() < 0.02) break;
  }
  if (std::abs(shift.x() - start) > kReach) return start_rad;
  return shift.x() * kTurn / matrix.band().width;
}

}  // namespace panvo::landmarks
