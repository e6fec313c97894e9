// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/fourier_signature.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "brief_pattern.hpp"
#include "panvo/vision/equirectangular.hpp"

namespace panvo::evaluation {
namespace {

constexpr std::size_t kRows = 15, kHarmonics = 15;
constexpr int kDegrees = 360;  // one degree each
constexpr double kRound_rad = 2.0 * std::numbers::pi;

struct Signature final : PlaceDescriptor {
  std::array<std::array<std::complex<double>, kHarmonics>, kRows> harmonics{};  // [row][k - 1]
};

/// e^(-2 pi i n / columns).
std::array<std::complex<double>, kDegrees> unit_roots() {
  std::array<std::complex<double>, kDegrees> roots;
  for (int n = 0; n < kDegrees; ++n) roots[static_cast<std::size_t>(n)] = std::polar(1.0, -kRound_rad * n / kDegrees);
  return roots;
}

/// Phase agreement with the query rotated back by `heading_rad`: the correlation of the two bands.
double agreement(const std::array<std::complex<double>, kHarmonics>& products, double heading_rad) {
  double sum = 0.0;
  for (std::size_t k = 1; k <= kHarmonics; ++k) {
    sum += (products[k - 1] * std::polar(1.0, static_cast<double>(k) * heading_rad)).real();
  }
  return sum;
}

class FourierSignature final : public PlaceMethod {
 public:
  std::string name() const override { return "Fourier signature"; }

  std::unique_ptr<PlaceDescriptor> describe_landmark(const cv::Mat& panorama) const override {
    cv::Mat rows;
    cv::resize(described_band(panorama), rows, {kDegrees, static_cast<int>(kRows)}, 0.0, 0.0, cv::INTER_AREA);
    cv::Scalar mean, deviation;
    cv::meanStdDev(rows, mean, deviation);
    const double scale = 1.0 / std::max(deviation[0], 1.0);
    auto signature = std::make_unique<Signature>();
    for (std::size_t row = 0; row < kRows; ++row) {
      const auto* values = rows.ptr<std::uint8_t>(static_cast<int>(row));
      for (std::size_t k = 1; k <= kHarmonics; ++k) {
        std::complex<double> sum = 0.0;  // the mean does not contribute to a harmonic
        for (std::size_t x = 0; x < kDegrees; ++x) sum += static_cast<double>(values[x]) * roots_[k * x % kDegrees];
        signature->harmonics[row][k - 1] = scale / kDegrees * sum;
      }
    }
    return signature;
  }

  PlaceDistance distance(const PlaceDescriptor& query, const PlaceDescriptor& landmark) const override {
    const auto& seen = static_cast<const Signature&>(query).harmonics;
    const auto& known = static_cast<const Signature&>(landmark).harmonics;
    double difference = 0.0, sum = 1e-12;
    std::array<std::complex<double>, kHarmonics> products{};
    for (std::size_t row = 0; row < kRows; ++row) {
      for (std::size_t k = 0; k < kHarmonics; ++k) {
        const double a = std::abs(seen[row][k]), b = std::abs(known[row][k]);
        difference += std::abs(a - b);
        sum += a + b;
        products[k] += seen[row][k] * std::conj(known[row][k]);
      }
    }
    return {difference / sum, best_heading(products)};
  }

 private:
  static double best_heading(const std::array<std::complex<double>, kHarmonics>& products) {
    // A left turn by a moves the scene right by a, which multiplies harmonic k by e^(-i k a).
    constexpr double kStep_rad = kRound_rad / 360.0;
    double best = 0.0, most = agreement(products, 0.0);
    for (int i = 1; i < 360; ++i) {
      const double value = agreement(products, i * kStep_rad);
      if (value > most) {
        most = value;
        best = i * kStep_rad;
      }
    }
    const double before = agreement(products, best - kStep_rad), after = agreement(products, best + kStep_rad);
    const double curvature = before - 2.0 * most + after;
    const double refined = curvature < 0.0 ? best + 0.5 * kStep_rad * (before - after) / curvature : best;
    return vision::wrap(refined, kRound_rad);
  }

  std::array<std::complex<double>, kDegrees> roots_ = unit_roots();
};

}  // namespace

std::unique_ptr<PlaceMethod> fourier_signature() { return std::make_unique<FourierSignature>(); }

}  // namespace panvo::evaluation
