// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "compass_method.hpp"
#include "panvo/panoramic_compass/feature_patch.hpp"
#include "panvo/vision/equirectangular.hpp"

namespace panvo::panoramic_compass {
namespace {

constexpr int kRowReach_px = 3;  // vertical search range: one degree of pitch
constexpr int kColumnReach_px = 4;
constexpr double kPerColumn_rad = 2.0 * std::numbers::pi / BandCutter::kColumns;

/// Compass of the paper: a front and a rear patch well above the horizon are tracked by their smallest D; the one with
/// the smaller D gives the turn [Lu2015 6, Eqs. 11, 12]. Left and right patches give the rough translation.
class TwoPatches final : public PanoramicCompass::Method {
 public:
  TwoPatches(const CompassParameters& parameters, std::uint64_t seed, const Eigen::Matrix3d& base_from_panorama,
             vision::StageObserver* observer)
      : parameters_(parameters), cutter_(band_of(parameters.patches)), observer_(observer) {
    const Eigen::Vector3d ahead = base_from_panorama.transpose() * Eigen::Vector3d::UnitX();
    const vision::Equirectangular panorama{BandCutter::kColumns, BandCutter::kRows};
    const double front = panorama.column(std::atan2(ahead.x(), ahead.z()));
    for (int i = 0; i < 4; ++i) {  // front, right, rear, left
      patches_.push_back(make_patch(front + i * BandCutter::kColumns / 4.0, seed + static_cast<std::uint64_t>(i)));
      widest_ = std::max(widest_, patches_.back().widest());
    }
  }

  std::optional<AzimuthChange> track(std::int64_t stamp_ns, const cv::Mat& panorama,
                                     double expected_turn_rad) override {
    expected_rad_ += expected_turn_rad;
    const auto fault = find_fault(panorama);
    AzimuthChange change{.from_stamp_ns = last_ns_, .stamp_ns = stamp_ns};
    if (fault) {
      change.reason = "the panorama " + *fault;
      return has_last_ ? std::optional(change) : std::nullopt;
    }
    const FeatureBand band = prepare(panorama);
    const bool has_predecessor = has_last_;
    if (has_predecessor) measure(band, change);
    describe(band);
    last_ns_ = stamp_ns;
    return has_predecessor ? std::optional(change) : std::nullopt;
  }

 private:
  struct Found {
    CurveMinimum minimum;
    bool clear = false;
  };

  static BandCutter band_of(const PatchParameters& patches) {
    const double margin = kRowReach_px / BandCutter::kRowsPerDegree;
    return BandCutter::between(patches.elevation_deg + 0.5 * patches.height_deg + margin,
                               -(patches.elevation_deg - 0.5 * patches.height_deg) + margin);
  }

  FeaturePatch make_patch(double middle, std::uint64_t seed) const {
    const PatchParameters& p = parameters_.patches;
    const double per_degree = BandCutter::kColumns / 360.0;
    const cv::Size size(static_cast<int>(p.width_deg * per_degree), cutter_.rows - 2 * kRowReach_px);
    FeaturePatchParameters patch;
    patch.drawn = p.drawn;
    patch.bounds = {{std::max(1, size.width / 8), std::max(1, size.height / 8)},
                    {std::max(2, size.width / 3), std::max(2, size.height / 2)}};
    patch.selection.kept = p.kept;
    patch.selection.alpha_px = p.alpha_deg * per_degree;
    patch.selection.beta_px = p.beta_deg * per_degree;
    patch.selection.gamma_px = p.gamma_deg * per_degree;
    patch.selection.upright = 0.2;
    const cv::Rect place(cv::Point(static_cast<int>(std::lround(middle - 0.5 * size.width)), kRowReach_px), size);
    return {{BandCutter::kColumns, cutter_.rows}, place, patch, seed};
  }

  FeatureBand prepare(const cv::Mat& panorama) const {
    const vision::Stage stage(observer_, "prepare");
    return {cutter_.cut(panorama), widest_};
  }

  void describe(const FeatureBand& band) {
    const vision::Stage stage(observer_, "describe");
    for (FeaturePatch& patch : patches_) patch.describe(band);
    has_last_ = true;
    expected_rad_ = 0.0;
  }

  /// The smallest D of a patch over (du, dv).
  Found find(const FeaturePatch& patch, const FeatureBand& band) const {
    const int range = static_cast<int>(std::ceil(parameters_.max_turn_deg * BandCutter::kColumns / 360.0));
    const int first = static_cast<int>(std::lround(expected_rad_ / kPerColumn_rad)) - range;
    Found found;
    DistanceCurve curve = patch.distances(band, first, 2 * range + 1);
    const float mean = curve.mean();
    found.minimum = find_minimum(curve).value_or(CurveMinimum{});
    const int about = static_cast<int>(std::lround(found.minimum.displacement)) - kColumnReach_px;
    for (int dv = -kRowReach_px; dv <= kRowReach_px; ++dv) {  // vertical search around the horizontal minimum
      const auto minimum = find_minimum(patch.distances(band, about, 2 * kColumnReach_px + 1, dv));
      if (found.minimum.at_border || !minimum || minimum->at_border) continue;
      if (minimum->distance < found.minimum.distance) found.minimum = *minimum;
    }
    found.minimum.relative = mean > 0.0F ? found.minimum.distance / mean : 1.0;
    found.clear = patch.is_described() && !found.minimum.at_border && found.minimum.curvature > 0.0 &&
                  found.minimum.relative <= parameters_.patches.max_distance;
    return found;
  }

  void measure(const FeatureBand& band, AzimuthChange& change) const {
    const vision::Stage stage(observer_, "patches");
    std::array<Found, 4> found;
    for (std::size_t i = 0; i < found.size(); ++i) found[i] = find(patches_[i], band);
    const auto& [front, right, rear, left] = found;
    if (left.clear && right.clear) {
      change.side_parallax_rad = 0.5 * kPerColumn_rad * (right.minimum.displacement - left.minimum.displacement);
    }
    const bool front_is_better =
        front.clear != rear.clear ? front.clear : front.minimum.distance <= rear.minimum.distance;
    const Found& better = front_is_better ? front : rear;
    change.change_rad =
        vision::wrap(kPerColumn_rad * better.minimum.displacement, 2.0 * std::numbers::pi);  // [Lu2015 Eq. 12]
    const double sigma_px = sigma_of(better.minimum);
    change.variance_rad2 = std::pow(kPerColumn_rad * sigma_px, 2);
    std::ostringstream reason;
    reason.precision(2);
    if (!patches_[0].is_described() && !patches_[2].is_described()) {
      reason << "neither patch has texture to track";
    } else if (better.minimum.at_border) {
      reason << "the turn is beyond the search range of " << parameters_.max_turn_deg << " deg";
    } else if (!better.clear) {
      reason << "no clear minimum of D: " << better.minimum.relative << " of its mean, at most "
             << parameters_.patches.max_distance << " needed";
    }
    change.reason = reason.str();
    change.valid = change.reason.empty();
  }

  /// Standard deviation of the minimum, px: the error of D from its features, propagated through the curvature.
  double sigma_of(const CurveMinimum& minimum) const {
    constexpr double kRounding_px = 0.3;  // rectangles have integer columns
    const double features = parameters_.patches.kept;
    const double error = minimum.distance * std::sqrt(2.0 / features);
    return std::hypot(kRounding_px, error / std::max(minimum.curvature, 1e-4));
  }

  const CompassParameters parameters_;
  const BandCutter cutter_;
  vision::StageObserver* observer_;
  std::vector<FeaturePatch> patches_;
  int widest_ = 0;
  bool has_last_ = false;
  std::int64_t last_ns_ = 0;
  double expected_rad_ = 0.0;
};

}  // namespace

std::unique_ptr<PanoramicCompass::Method> make_two_patches(const CompassParameters& parameters, std::uint64_t seed,
                                                           const Eigen::Matrix3d& base_from_panorama,
                                                           vision::StageObserver* observer) {
  return std::make_unique<TwoPatches>(parameters, seed, base_from_panorama, observer);
}

}  // namespace panvo::panoramic_compass
