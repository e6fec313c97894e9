// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <utility>

#include "compass_method.hpp"
#include "panvo/panoramic_compass/point_field.hpp"
#include "panvo/panoramic_compass/turn_fit.hpp"
#include "panvo/vision/equirectangular.hpp"
#include "panvo/vision/pose.hpp"
#include "sector_patches.hpp"
#include "seen_motion.hpp"

namespace panvo::panoramic_compass {
namespace {

constexpr double kPerRadian =
    BandCutter::kColumns / (2.0 * std::numbers::pi);  // columns and rows of the full-size panorama
constexpr int kScale = 2;                             // sector patches are matched at half size
constexpr double kMinFoundShare = 0.15;               // of the reference points: fewer may agree by chance
constexpr std::size_t kMaxEarlier = 3;                // references before that are still followed
constexpr std::size_t kMinEarlier = 15;               // points of the reference before, to be of use
constexpr int kMaxFailures = 3;                       // consecutive failures before a new reference is taken
constexpr double kAhead = 0.05;        // sine: closer to the direction of travel, the magnification is undefined
constexpr double kMaxMagnified = 1.6;  // larger changes are clamped
constexpr int kPatch_px = 10;          // half the width of what a point is recognised by
constexpr double kZenithShare = 0.2;   // of the rows: overhead region
constexpr double kSkyQuantile = 0.2;   // of the overhead grey levels
constexpr double kSkyShare = 0.75;     // of that quantile: darker pixels are not sky

/// Magnification of a point from the sines of its angles to the direction of travel before and after: its distance from
/// the line of travel is constant.
double magnified(double sine_then, double sine_now) {
  if (sine_then < kAhead || sine_now < kAhead) return 1.0;
  return std::clamp(sine_now / sine_then, 1.0 / kMaxMagnified, kMaxMagnified);
}

/// Lower bound of the sky's grey level; 256 if the overhead region is brighter neither than the band nor than the
/// `ground`, its lowest rows: a band with clouds over open land is brighter than the blue sky above.
double darkest_sky(const cv::Mat& panorama, const cv::Mat& band, const cv::Mat& ground) {
  constexpr int kStep = 12;
  std::vector<int> overhead;
  for (int row = 0; row < kZenithShare * panorama.rows; row += kStep) {
    for (int column = 0; column < panorama.cols; column += kStep) {
      const uchar* pixel = panorama.ptr<uchar>(row) + column * panorama.channels();
      overhead.push_back(panorama.channels() == 1 ? pixel[0] : (pixel[0] + 2 * pixel[1] + pixel[2]) / 4);
    }
  }
  const auto low = overhead.begin() + static_cast<std::ptrdiff_t>(kSkyQuantile * static_cast<double>(overhead.size()));
  std::nth_element(overhead.begin(), low, overhead.end());
  const double least = std::min(cv::mean(band)[0], cv::mean(ground)[0]);
  return *low > least ? kSkyShare * *low : 256.0;
}

/// Interpolates grey levels of a full turn between the columns that are seen.
void fill_across(const cv::Mat& seen, cv::Mat row) {
  const int columns = row.cols;
  const auto is_seen = [&](int column) { return seen.at<uchar>((column % columns + columns) % columns) != 0; };
  const auto grey = [&](int column) -> uchar& { return row.at<uchar>((column % columns + columns) % columns); };
  for (int first = 0; first < columns; ++first) {
    if (is_seen(first) || !is_seen(first - 1)) continue;  // not the beginning of a covered part
    int end = first;
    while (!is_seen(end)) ++end;
    const double from = grey(first - 1), to = grey(end);
    for (int column = first; column < end; ++column) {
      grey(column) = cv::saturate_cast<uchar>(from + (to - from) * (column - first + 1) / (end - first + 1));
    }
  }
}

/// Tracks points on all sides relative to a reference panorama that is kept over several panoramas.
class AllRound final : public PanoramicCompass::Method {
 public:
  AllRound(const CompassParameters& parameters, std::uint64_t seed, const Eigen::Matrix3d& base_from_panorama,
           vision::StageObserver* observer)
      : parameters_(parameters),
        cutter_(BandCutter::between(parameters.points.top_deg, parameters.points.bottom_deg)),
        base_from_panorama_(base_from_panorama),
        sectors_({BandCutter::kColumns / kScale, cutter_.rows / kScale}, parameters.patches, seed),
        observer_(observer) {}

  std::optional<AzimuthChange> track(std::int64_t stamp_ns, const cv::Mat& panorama,
                                     double expected_turn_rad) override {
    expected_rad_ += expected_turn_rad;
    has_points_ = false;
    const auto fault = find_fault(panorama);
    if (fault) return has_reference_ ? std::optional(invalid(stamp_ns, "the panorama " + *fault)) : std::nullopt;
    const cv::Mat band = prepare(panorama);
    if (!has_reference_) {
      refer_to(stamp_ns);
      return std::nullopt;
    }
    AzimuthChange change = measure(stamp_ns);
    failures_ = change.valid ? 0 : failures_ + 1;
    if (failures_ >= kMaxFailures || needs_reference_) {
      keep_earlier();
      refer_to(stamp_ns);
    }
    return change;
  }

  void set_seen(const cv::Mat& seen) override {
    cv::Mat whole;
    cv::resize(seen, whole, {BandCutter::kColumns, BandCutter::kRows}, 0.0, 0.0, cv::INTER_NEAREST);
    seen_ = whole.rowRange(cutter_.first_row, cutter_.first_row + cutter_.rows);
    cv::erode(seen_, seen_, cv::getStructuringElement(cv::MORPH_RECT, {2 * kPatch_px + 1, 2 * kPatch_px + 1}));
    field_.keep_seen(seen_);
    for (Earlier& earlier : earlier_) earlier.field.keep_seen(seen_);
  }

  void keep_earlier_points() override { keeps_earlier_ = true; }

  const TrackedPoints* points() const override { return has_points_ ? &tracked_ : nullptr; }

 private:
  struct Earlier {  // a reference before the present one
    PointField field;
    std::int64_t stamp_ns;
    Eigen::Matrix3d reference_from_earlier;
  };

  cv::Mat prepare(const cv::Mat& panorama) {
    const vision::Stage stage(observer_, "prepare");
    cv::Mat band = cutter_.cut(panorama);
    const int horizon = std::clamp(BandCutter::kRows / 2 - cutter_.first_row, 0, band.rows - 1);
    now_ = RoundBand(band, darkest_sky(panorama, band, band.rowRange(horizon, band.rows)));
    const cv::Mat& half = now_.pyramid[1];
    const int margin = RoundBand::kMargin_px / kScale;
    features_.emplace(sectors_.prepare(uncovered(half.colRange(margin, margin + band.cols / kScale))));
    return band;
  }

  /// The half-size band with what is beside the vehicle in its place, so that its edges do not look like no turn.
  cv::Mat uncovered(const cv::Mat& half) const {
    if (seen_.empty()) return half;
    cv::Mat seen, filled = half.clone();
    cv::resize(seen_, seen, half.size(), 0.0, 0.0, cv::INTER_NEAREST);
    for (int row = 0; row < filled.rows; ++row) fill_across(seen.row(row), filled.row(row));
    return filled;
  }

  AzimuthChange measure(std::int64_t stamp_ns) {
    std::ostringstream reason;
    reason.precision(3);
    const SectorShifts shifts = find_turn();
    if (shifts.beyond_range) return invalid(stamp_ns, shifts.reason);
    const double turned_rad = kScale * shifts.turn_px / kPerRadian;
    now_from_reference_ = vision::so3_exp({0.0, 0.0, -turned_rad}) * now_from_reference_;
    find_points(shifts);
    const std::vector<BearingPair>& pairs = tracked_.tracks.front().pairs;
    describe_sectors(stamp_ns);
    const vision::Stage stage(observer_, "fit");
    const auto fit = fit_turn(pairs, now_from_reference_, drift_);
    const AgreementParameters& demand = parameters_.agreement;
    const int needed =
        std::max(demand.min_points, static_cast<int>(kMinFoundShare * static_cast<double>(field_.size())));
    if (!fit || fit->agreeing < needed) {
      reason << (fit ? fit->agreeing : 0) << " points agree on a turn, " << needed << " needed";
      if (!shifts.reason.empty()) reason << "; " << shifts.reason;
      return invalid(stamp_ns, reason.str());
    }
    const double share = fit->agreeing / static_cast<double>(pairs.size());
    const double systematic_rad = demand.systematic_deg * std::numbers::pi / 180.0;
    AzimuthChange change{.from_stamp_ns = reference_ns_, .stamp_ns = stamp_ns};
    change.change_rad = fit->yaw_rad;
    const double by_parallax_rad = demand.parallax_share * fit->typical_parallax;
    change.variance_rad2 = fit->yaw_variance_rad2 + systematic_rad * systematic_rad + by_parallax_rad * by_parallax_rad;
    change.side_parallax_rad = side_parallax(pairs, *fit);
    change.motion_azimuth_rad = std::atan2(-fit->drift.y(), -fit->drift.x());
    change.motion_azimuth_variance_rad2 = motion_azimuth_variance(*fit, change.variance_rad2);
    const double sigma_deg = std::sqrt(change.variance_rad2) * 180.0 / std::numbers::pi;
    if (share < demand.min_share) {
      reason << "the points contradict each other: " << fit->agreeing << " of " << pairs.size() << " agree";
    } else if (sigma_deg > demand.max_sigma_deg) {
      reason << "uncertain: standard deviation " << sigma_deg << " deg";
    }
    change.reason = reason.str();
    change.valid = change.reason.empty();
    if (change.valid) take(*fit, stamp_ns);
    return change;
  }

  void take(const TurnFit& fit, std::int64_t stamp_ns) {
    now_from_reference_ = fit.now_from_then;
    drift_ = fit.drift;
    needs_reference_ = ++age_ >= parameters_.agreement.max_reference_panoramas || has_left(fit);
    tracked_.stamp_ns = stamp_ns;
    tracked_.now_from_then = fit.now_from_then;
    has_points_ = true;
  }

  /// Whether the view differs too much from the reference panorama.
  bool has_left(const TurnFit& fit) const {
    const AgreementParameters& demand = parameters_.agreement;
    return fit.agreeing < demand.kept_share * static_cast<double>(points_at_first_) ||
           fit.typical_parallax > demand.max_parallax_deg * std::numbers::pi / 180.0;
  }

  SectorShifts find_turn() {
    const vision::Stage stage(observer_, "sectors");
    const double range_px = parameters_.max_turn_deg * BandCutter::kColumns / 360.0 / kScale;
    return sectors_.track(*features_, expected_rad_ * kPerRadian / kScale, static_cast<int>(std::ceil(range_px)),
                          parameters_.patches.max_distance);
  }

  void find_points(const SectorShifts& shifts) {
    const vision::Stage stage(observer_, "points");
    tracked_.tracks.resize(1);
    tracked_.tracks[0] = {reference_ns_, follow(field_, shifts, now_from_reference_)};
    std::erase_if(earlier_, [&](Earlier& earlier) {
      auto pairs = follow(earlier.field, shifts, now_from_reference_ * earlier.reference_from_earlier);
      if (pairs.size() < kMinEarlier) return true;
      tracked_.tracks.push_back({earlier.stamp_ns, std::move(pairs)});
      return false;
    });
  }

  std::vector<BearingPair> follow(PointField& field, const SectorShifts& shifts,
                                  const Eigen::Matrix3d& now_from_then) const {
    constexpr int kSectors = SectorShifts::kSectors;
    const auto shift_px = [&](double u) {
      const int sector = std::clamp(static_cast<int>(u * kSectors / BandCutter::kColumns), 0, kSectors - 1);
      return kScale * shifts.sector_px[static_cast<std::size_t>(sector)];
    };
    const auto magnification = [this, drift_then = Eigen::Vector3d(now_from_then.transpose() * drift_)](
                                   const Eigen::Vector2d& then, const Eigen::Vector2d& now) {
      return magnified(bearing(then).cross(drift_then).norm(), bearing(now).cross(drift_).norm());
    };
    std::vector<BearingPair> pairs;
    for (const FoundPoint& found : field.follow(now_, shift_px, magnification)) {
      if (!is_seen(seen_, found.now)) continue;
      const double cosine = std::cos((found.now.y() + cutter_.first_row - 0.5 * BandCutter::kRows) / kPerRadian);
      const Eigen::Vector2d per_pixel(cosine / kPerRadian, 1.0 / kPerRadian);
      pairs.push_back(
          {bearing(found.then), bearing(found.now), found.variance_px2.cwiseProduct(per_pixel.cwiseAbs2()), found.id});
    }
    return pairs;
  }

  Eigen::Vector3d bearing(const Eigen::Vector2d& in_band) const {
    const vision::Equirectangular panorama{BandCutter::kColumns, BandCutter::kRows};
    return base_from_panorama_ * panorama.unproject({in_band.x(), in_band.y() + cutter_.first_row});
  }

  void describe_sectors(std::int64_t stamp_ns) {
    const vision::Stage stage(observer_, "describe");
    expected_rad_ = 0.0;
    described_ns_ = stamp_ns;
    sectors_.describe(*features_);
  }

  /// Goes on following the points of the reference for some time after its end.
  void keep_earlier() {
    if (!keeps_earlier_ || !has_points_) return earlier_.clear();
    for (Earlier& earlier : earlier_)
      earlier.reference_from_earlier = now_from_reference_ * earlier.reference_from_earlier;
    earlier_.push_back({std::move(field_), reference_ns_, now_from_reference_});
    if (earlier_.size() > kMaxEarlier) earlier_.erase(earlier_.begin());
  }

  void refer_to(std::int64_t stamp_ns) {
    const vision::Stage stage(observer_, "reference");
    field_ = PointField(now_, parameters_.points, seen_);
    points_at_first_ = field_.size();
    reference_ns_ = stamp_ns;
    now_from_reference_ = Eigen::Matrix3d::Identity();
    has_reference_ = true;
    needs_reference_ = false;
    failures_ = age_ = 0;
    if (described_ns_ != stamp_ns) describe_sectors(stamp_ns);
  }

  AzimuthChange invalid(std::int64_t stamp_ns, std::string reason) const {
    AzimuthChange change{.from_stamp_ns = reference_ns_, .stamp_ns = stamp_ns};
    change.reason = std::move(reason);
    return change;
  }

  const CompassParameters parameters_;
  const BandCutter cutter_;
  const Eigen::Matrix3d base_from_panorama_;
  SectorPatches sectors_;
  vision::StageObserver* observer_;

  cv::Mat seen_;  // as large as the band; empty: all of it
  RoundBand now_;
  std::optional<FeatureBand> features_;
  PointField field_;
  std::size_t points_at_first_ = 0;
  std::vector<Earlier> earlier_;  // in order of stamps
  bool keeps_earlier_ = false;
  TrackedPoints tracked_;
  bool has_points_ = false;  // tracked_ belongs to the last panorama
  std::int64_t reference_ns_ = 0;
  std::optional<std::int64_t> described_ns_;  // stamp of the panorama in which the sectors were described
  bool has_reference_ = false, needs_reference_ = false;
  int age_ = 0, failures_ = 0;
  Eigen::Vector3d drift_ = -Eigen::Vector3d::UnitX();  // last estimate
  double expected_rad_ = 0.0;                          // since the panorama in which the sectors were described
  Eigen::Matrix3d now_from_reference_ =
      Eigen::Matrix3d::Identity();  // `now`: panorama in which the sectors were described
};

}  // namespace

std::unique_ptr<PanoramicCompass::Method> make_all_round(const CompassParameters& parameters, std::uint64_t seed,
                                                         const Eigen::Matrix3d& base_from_panorama,
                                                         vision::StageObserver* observer) {
  return std::make_unique<AllRound>(parameters, seed, base_from_panorama, observer);
}

}  // namespace panvo::panoramic_compass
