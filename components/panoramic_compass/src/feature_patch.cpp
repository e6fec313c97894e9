// SPDX-License-Identifier: Apache-2.0
#include "panvo/panoramic_compass/feature_patch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace panvo::panoramic_compass {
namespace {

constexpr float kMinSpread = 0.05F;

/// Draws a matrix for the patch and moves it to the position of the patch.
vision::MeasurementMatrix draw(cv::Size band, const cv::Rect& place, const FeaturePatchParameters& parameters,
                               std::uint64_t seed) {
  const vision::MatrixParameters drawing{parameters.drawn, parameters.rectangles, true, 1.0};
  // x is drawn cyclically: reserving the largest rectangle width keeps all rectangles inside the patch.
  const cv::Size room(std::max(parameters.bounds.to.width, place.width - parameters.bounds.to.width), place.height);
  const vision::MeasurementMatrix drawn(room, parameters.bounds, drawing, seed);
  std::vector<std::vector<vision::MeasurementMatrix::Element>> rows;
  for (int row = 0; row < drawn.rows(); ++row) {
    auto& moved = rows.emplace_back(drawn.row(row).begin(), drawn.row(row).end());
    for (auto& element : moved) {
      element.rectangle.x = ((element.rectangle.x + place.x) % band.width + band.width) % band.width;
      element.rectangle.y += place.y;
    }
  }
  return {band, rows};
}

}  // namespace

FeatureBand::FeatureBand(const cv::Mat& band, int widest) {
  const cv::Mat prepared = vision::prepare_band(band);
  images = vision::CyclicIntegralImages(prepared, widest);
  normalisation = vision::BandNormalisation::of(prepared, images);
}

FeaturePatch::FeaturePatch(cv::Size band, const cv::Rect& place, const FeaturePatchParameters& parameters,
                           std::uint64_t seed)
    : matrix_(draw(band, place, parameters, seed)), selection_(parameters.selection), seed_(seed) {}

void FeaturePatch::describe(const FeatureBand& band) {
  normalisation_ = band.normalisation;
  features_ = vision::select_features(band.images, matrix_, band.normalisation, selection_, seed_);
}

DistanceCurve FeaturePatch::distances(const FeatureBand& band, int first, int count, int dv) const {
  DistanceCurve curve{first, std::vector<float>(static_cast<std::size_t>(std::max(0, count)), 0.0F)};
  const vision::ResponseReader reader(band.images, matrix_, normalisation_);
  float weights = 0.0F;
  for (const vision::SelectedFeature& feature : features_) {
    const bool is_intensity = feature.row < matrix_.rows();
    const int row = is_intensity ? feature.row : feature.row - matrix_.rows();
    const float per_spread = 1.0F / std::max(kMinSpread, feature.spread);
    for (int i = 0; i < count; ++i) {
      const float response =
          is_intensity ? reader.read_intensity(row, first + i, dv) : reader.read_gradient(row, first + i, dv);
      curve.distances[static_cast<std::size_t>(i)] +=
          feature.weight * std::min(1.0F, std::abs(response - feature.value) * per_spread);
    }
    weights += feature.weight;
  }
  for (float& distance : curve.distances) distance = weights > 0.0F ? distance / weights : 1.0F;
  return curve;
}

}  // namespace panvo::panoramic_compass
