// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/adaptive_selection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "seeded_random.hpp"

namespace panvo::vision {
namespace {

constexpr int kTurnSamples = 36;

struct Displacement {
  int du = 0;
  int dv = 0;
};

/// Random displacements between two radii (px), uniform over the area of the ring.
std::vector<Displacement> draw_ring(double inner_px, double outer_px, double upright, int count, SeededRandom& random) {
  std::vector<Displacement> places;
  while (static_cast<int>(places.size()) < count) {
    const double radius = std::sqrt(random.between(inner_px * inner_px, outer_px * outer_px));
    const double angle = random.between(0.0, 2.0 * std::numbers::pi);
    places.push_back({static_cast<int>(std::lround(radius * std::cos(angle))),
                      static_cast<int>(std::lround(upright * radius * std::sin(angle)))});
  }
  return places;
}

/// Gaussians of the positive and negative samples of one feature.
struct Discrimination {
  Gaussian positive, negative;

  double hellinger() const { return hellinger_distance(positive, negative); }
  bool varies(double min_deviation) const {
    return positive.deviation >= min_deviation || negative.deviation >= min_deviation;
  }
};

/// Standard deviation of a feature over the full turn: a training-free measure of how much it differs between places.
float deviation_over_turn(const ResponseReader& reader, int row, bool is_intensity, int columns) {
  std::array<float, kTurnSamples> responses{};
  for (int i = 0; i < kTurnSamples; ++i) {
    const int du = i * columns / kTurnSamples;
    responses[static_cast<std::size_t>(i)] =
        is_intensity ? reader.read_intensity(row, du) : reader.read_gradient(row, du);
  }
  return static_cast<float>(fit_gaussian(responses).deviation);
}

/// Sector of the full turn that contains the mean azimuth of a row's rectangles.
std::size_t sector_of(const MeasurementMatrix& matrix, int row, int sectors) {
  double along = 0.0, across = 0.0;
  for (const MeasurementMatrix::Element& element : matrix.row(row)) {
    const BandRectangle& r = element.rectangle;
    const double angle = (r.x + 0.5 * r.width) * 2.0 * std::numbers::pi / matrix.band().width;
    along += std::cos(angle);
    across += std::sin(angle);
  }
  const double share = std::atan2(across, along) / (2.0 * std::numbers::pi) + 0.5;
  return static_cast<std::size_t>(std::min(sectors - 1, static_cast<int>(share * sectors)));
}

/// From features sorted by descending weight: the best of each sector up to its share, then the best of the rest.
std::vector<SelectedFeature> take_best(const std::vector<SelectedFeature>& ranked, const MeasurementMatrix& matrix,
                                       const SelectionParameters& parameters) {
  const int share = (parameters.kept + parameters.sectors - 1) / parameters.sectors;
  const auto kept = std::min(ranked.size(), static_cast<std::size_t>(parameters.kept));
  std::vector<int> taken(static_cast<std::size_t>(parameters.sectors), 0);
  std::vector<bool> is_taken(ranked.size(), false);
  std::size_t count = 0;
  for (const bool by_sector : {true, false}) {
    for (std::size_t i = 0; i < ranked.size() && count < kept; ++i) {
      if (is_taken[i]) continue;
      int& of_sector = taken[sector_of(matrix, ranked[i].row % matrix.rows(), parameters.sectors)];
      if (by_sector && of_sector >= share) continue;
      ++of_sector;
      ++count;
      is_taken[i] = true;
    }
  }
  std::vector<SelectedFeature> best;
  best.reserve(kept);
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    if (is_taken[i]) best.push_back(ranked[i]);
  }
  return best;
}

}  // namespace

Gaussian fit_gaussian(std::span<const float> samples) {
  if (samples.empty()) return {};
  double sum = 0.0, square = 0.0;
  for (const float sample : samples) sum += sample;
  const double mean = sum / static_cast<double>(samples.size());
  for (const float sample : samples) square += (sample - mean) * (sample - mean);
  return {mean, std::sqrt(square / static_cast<double>(samples.size()))};
}

// [Lu2015 Eq. 7]
double hellinger_distance(const Gaussian& a, const Gaussian& b) {
  const double variances = a.deviation * a.deviation + b.deviation * b.deviation;
  const double apart = a.mean - b.mean;
  if (variances <= 0.0) return apart == 0.0 ? 0.0 : 1.0;
  const double overlap =
      std::sqrt(2.0 * a.deviation * b.deviation / variances) * std::exp(-0.25 * apart * apart / variances);
  return std::sqrt(std::max(0.0, 1.0 - overlap));
}

std::vector<SelectedFeature> select_features(const CyclicIntegralImages& images, const MeasurementMatrix& matrix,
                                             const BandNormalisation& normalisation,
                                             const SelectionParameters& parameters, std::uint64_t seed) {
  if (!(parameters.alpha_px > 0.0 && parameters.alpha_px < parameters.beta_px &&
        parameters.beta_px < parameters.gamma_px) ||
      parameters.samples < 2 || parameters.kept < 1 || parameters.sectors < 1) {
    throw std::invalid_argument(
        "adaptive selection: 0 < alpha < beta < gamma, at least 2 samples, 1 feature and 1 sector needed");
  }
  SeededRandom random(seed);
  const std::vector<Displacement> nearby =
      draw_ring(0.0, parameters.alpha_px, parameters.upright, parameters.samples, random);
  const std::vector<Displacement> farther =
      draw_ring(parameters.beta_px, parameters.gamma_px, parameters.upright, parameters.samples, random);

  const ResponseReader reader(images, matrix, normalisation);
  const auto samples = static_cast<std::size_t>(parameters.samples);
  std::vector<float> intensity(samples), gradient(samples);
  const auto fit = [&](int row, const std::vector<Displacement>& places) {
    for (std::size_t i = 0; i < samples; ++i) {
      const CompressiveFeature feature = reader.read(row, places[i].du, places[i].dv);
      intensity[i] = feature.intensity;
      gradient[i] = feature.gradient;
    }
    return std::array{fit_gaussian(intensity), fit_gaussian(gradient)};
  };

  std::vector<SelectedFeature> features;
  for (int row = 0; row < matrix.rows(); ++row) {
    const auto positive = fit(row, nearby);
    const auto negative = fit(row, farther);
    const Discrimination by_intensity{positive[0], negative[0]}, by_gradient{positive[1], negative[1]};
    if (!by_intensity.varies(parameters.min_deviation) && !by_gradient.varies(parameters.min_deviation)) {
      continue;  // uniform background, not distinctive
    }
    const CompressiveFeature here = reader.read(row);
    features.push_back({row, here.intensity, 1.0F, static_cast<float>(by_intensity.hellinger())});
    features.push_back({row + matrix.rows(), here.gradient, 1.0F, static_cast<float>(by_gradient.hellinger())});
  }
  std::stable_sort(features.begin(), features.end(),
                   [](const SelectedFeature& a, const SelectedFeature& b) { return a.weight > b.weight; });
  features = take_best(features, matrix, parameters);
  for (SelectedFeature& feature : features) {
    const bool is_intensity = feature.row < matrix.rows();
    const int row = is_intensity ? feature.row : feature.row - matrix.rows();
    feature.spread = deviation_over_turn(reader, row, is_intensity, images.columns());
  }
  return features;
}

}  // namespace panvo::vision
