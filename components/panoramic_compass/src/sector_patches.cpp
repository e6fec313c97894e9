// SPDX-License-Identifier: Apache-2.0
#include "sector_patches.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace panvo::panoramic_compass {
namespace {

constexpr double kParallax_deg = 10.0;  // of near objects beside the vehicle, between consecutive panoramas

}  // namespace

SectorPatches::SectorPatches(cv::Size band, const PatchParameters& parameters, std::uint64_t seed) : band_(band) {
  constexpr int kSectors = SectorShifts::kSectors;
  const double columns_per_degree = band.width / 360.0;
  const int width = band.width / kSectors;
  FeaturePatchParameters patch;
  patch.drawn =
      std::max(1, 4 * parameters.drawn / kSectors);  // per sector: all sectors together have as many as four patches
  patch.bounds = {{width / 8, band.height / 8}, {width / 3, band.height / 3}};
  patch.selection.kept = std::max(2, 2 * parameters.kept / kSectors);
  patch.selection.samples = 8;
  patch.selection.alpha_px = parameters.alpha_deg * columns_per_degree;
  patch.selection.beta_px = parameters.beta_deg * columns_per_degree;
  patch.selection.gamma_px = parameters.gamma_deg * columns_per_degree;
  patch.selection.upright = 0.2;
  for (int i = 0; i < kSectors; ++i) {
    patches_.emplace_back(band, cv::Rect(i * width, 0, width, band.height), patch,
                          seed + static_cast<std::uint64_t>(i));
    widest_ = std::max(widest_, patches_.back().widest());
  }
}

void SectorPatches::describe(const FeatureBand& band) {
  for (FeaturePatch& patch : patches_) patch.describe(band);
}

SectorShifts SectorPatches::track(const FeatureBand& band, double expected_px, int range_px,
                                  double max_distance) const {
  const int parallax = static_cast<int>(std::lround(kParallax_deg * band_.width / 360.0));
  const int reach = range_px + parallax;
  const int first = static_cast<int>(std::lround(expected_px)) - reach;
  std::vector<DistanceCurve> curves;
  DistanceCurve all{first + parallax, std::vector<float>(static_cast<std::size_t>(2 * range_px + 1), 0.0F)};
  int described = 0;
  for (const FeaturePatch& patch : patches_) {
    curves.push_back(patch.distances(band, first, 2 * reach + 1));
    if (!patch.is_described()) continue;
    ++described;
    for (std::size_t i = 0; i < all.distances.size(); ++i) {
      all.distances[i] += curves.back().distances[i + static_cast<std::size_t>(parallax)];
    }
  }
  SectorShifts shifts;
  std::ostringstream reason;
  reason.precision(2);
  const auto minimum = find_minimum(all);
  if (!minimum || described == 0) {
    shifts.reason = "no patch has texture to track";
    return shifts;
  }
  shifts.turn_px = minimum->displacement;
  shifts.beyond_range = minimum->at_border;
  if (minimum->at_border) {
    reason << "the turn is beyond the search range of " << range_px * 360.0 / band_.width << " deg";
  } else if (minimum->relative > max_distance) {
    reason << "no clear minimum of D: " << minimum->relative << " of its mean, at most " << max_distance << " needed";
  }
  shifts.reason = reason.str();
  for (std::size_t s = 0; s < patches_.size(); ++s) {
    const auto at = static_cast<std::ptrdiff_t>(std::lround(shifts.turn_px)) - parallax - first;
    DistanceCurve near{first + static_cast<int>(at), {}};
    near.distances.assign(curves[s].distances.begin() + at, curves[s].distances.begin() + at + 2 * parallax + 1);
    const auto own = find_minimum(near);
    const bool tells = patches_[s].is_described() && own && !own->at_border && own->relative < max_distance;
    shifts.sector_px[s] = tells ? own->displacement : shifts.turn_px;
  }
  return shifts;
}

}  // namespace panvo::panoramic_compass
