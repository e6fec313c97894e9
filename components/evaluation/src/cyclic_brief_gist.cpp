// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/cyclic_brief_gist.hpp"

#include <algorithm>
#include <numbers>

#include "brief_pattern.hpp"
#include "panvo/vision/equirectangular.hpp"

namespace panvo::evaluation {
namespace {

constexpr std::size_t kRoundTiles = 36;
constexpr int kStep_px = 12;  // the band at a height of 60 px has 432 columns
constexpr double kTurn_rad = 2.0 * std::numbers::pi;

struct Ring final : PlaceDescriptor {
  std::array<BriefPattern::Bits, kRoundTiles> bits;
};

/// Minimum of the parabola through three values one step apart, in steps from the middle one.
double lowest_of_parabola(int before, int at, int after) {
  const int curvature = before - 2 * at + after;
  return curvature > 0 ? 0.5 * (before - after) / curvature : 0.0;
}

class CyclicBriefGist final : public PlaceMethod {
 public:
  explicit CyclicBriefGist(std::uint64_t seed) : pattern_(seed) {}

  std::string name() const override { return "BRIEF-Gist, cyclic"; }

  std::unique_ptr<PlaceDescriptor> describe_landmark(const cv::Mat& panorama) const override {
    const cv::Mat smoothed = smoothed_band(panorama, static_cast<int>(kRoundTiles) * kStep_px);
    auto ring = std::make_unique<Ring>();
    for (std::size_t i = 0; i < kRoundTiles; ++i) {
      ring->bits[i] = pattern_.describe(smoothed, static_cast<int>(i) * kStep_px);
    }
    return ring;
  }

  PlaceDistance distance(const PlaceDescriptor& query, const PlaceDescriptor& landmark) const override {
    const auto& seen = static_cast<const Ring&>(query).bits;
    const auto& known = static_cast<const Ring&>(landmark).bits;
    std::array<int, kRoundTiles> different{};
    for (std::size_t shift = 0; shift < kRoundTiles; ++shift) {
      // A left turn of the vehicle moves the scene right: tile i becomes tile i + shift.
      for (std::size_t i = 0; i < kRoundTiles; ++i) {
        different[shift] += hamming_distance(seen[(i + shift) % kRoundTiles], known[i]);
      }
    }
    const auto best =
        static_cast<std::size_t>(std::min_element(different.begin(), different.end()) - different.begin());
    const double shift =
        static_cast<double>(best) + lowest_of_parabola(different[(best + kRoundTiles - 1) % kRoundTiles],
                                                       different[best], different[(best + 1) % kRoundTiles]);
    return {static_cast<double>(different[best]) / (kRoundTiles * BriefPattern::kBits),
            vision::wrap(shift * kTurn_rad / kRoundTiles, kTurn_rad)};
  }

 private:
  BriefPattern pattern_;
};

}  // namespace

std::unique_ptr<PlaceMethod> cyclic_brief_gist(std::uint64_t seed) { return std::make_unique<CyclicBriefGist>(seed); }

}  // namespace panvo::evaluation
