// SPDX-License-Identifier: Apache-2.0
#include "panvo/panoramic_compass/panoramic_compass.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "compass_method.hpp"
#include "panvo/vision/equirectangular.hpp"
#include "panvo/vision/grey.hpp"
#include "panvo/vision/image_check.hpp"
#include "panvo/vision/panorama_cover.hpp"
#include "panvo/vision/panorama_tilt.hpp"

namespace panvo::panoramic_compass {
namespace {

constexpr int kMinColumns = 256;                       // px: below, the smallest rectangles have only a few pixels
constexpr double kViewTop = 0.25, kViewBottom = 0.55;  // checked rows: 45 degrees above to 9 below the horizon
// Front, rear, left and right must be visible: else sideways motion is mistaken for a turn.
constexpr double kMaxCovered = 1.0 / 3.0;

/// Half a turn about the direction of view: of the axes, and of the picture's rows and columns.
Eigen::Matrix3d half_a_roll() { return Eigen::Vector3d(-1.0, -1.0, 1.0).asDiagonal(); }

/// Azimuth and elevation of a pixel change their signs, so row 0, the zenith, has no counterpart [Lu2015 Eq. 10].
cv::Mat turned_over(const cv::Mat& panorama) {
  if (panorama.rows < 2 || panorama.cols < 2) return panorama;
  cv::Mat flipped, turned(panorama.size(), panorama.type());
  cv::flip(panorama, flipped, -1);
  const int rows = panorama.rows, columns = panorama.cols;
  cv::Mat below = turned.rowRange(1, rows);
  flipped(cv::Rect(columns - 1, 0, 1, rows - 1)).copyTo(below.colRange(0, 1));
  flipped(cv::Rect(0, 0, columns - 1, rows - 1)).copyTo(below.colRange(1, columns));
  below.rowRange(0, 1).copyTo(turned.rowRange(0, 1));
  return turned;
}

void check(const CompassParameters& parameters) {
  const auto demand = [](bool met, const char* what) {
    if (!met) throw std::invalid_argument(std::string("panoramic compass: ") + what);
  };
  const PatchParameters& patches = parameters.patches;
  demand(parameters.method == "all_round" || parameters.method == "two_patches",
         "method must be all_round or two_patches");
  demand(patches.kept <= 2 * patches.drawn, "patches.kept must not be more than twice patches.drawn");
  demand(patches.alpha_deg < patches.beta_deg && patches.beta_deg < patches.gamma_deg,
         "patches: alpha_deg < beta_deg < gamma_deg required");
  demand(patches.elevation_deg + 0.5 * patches.height_deg <= 85.0 &&
             patches.elevation_deg - 0.5 * patches.height_deg >= -45.0,
         "patches must lie between 85 degrees above and 45 below the horizon");
  demand(parameters.points.top_deg + parameters.points.bottom_deg >= 24.0,
         "points: top_deg + bottom_deg must be at least 24");
}

}  // namespace

Eigen::Matrix3d upright_base_from_panorama() { return (Eigen::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished(); }

std::optional<std::string> find_fault(const cv::Mat& panorama) {
  if (auto fault = vision::find_layout_fault(panorama, kMinColumns)) return fault;
  // one channel suffices to check darkness and contrast
  cv::Mat view =
      panorama.rowRange(static_cast<int>(kViewTop * panorama.rows), static_cast<int>(kViewBottom * panorama.rows));
  if (view.channels() == 3) {
    cv::Mat green;
    cv::extractChannel(view, green, 1);
    view = green;
  }
  if (auto fault = vision::find_fault(view)) return fault;
  const double covered = vision::covered_share(panorama, kViewTop, kViewBottom);
  if (covered <= kMaxCovered) return std::nullopt;
  std::ostringstream text;
  text.precision(3);
  text << "is covered: " << 100.0 * covered << " % of the full turn without content, " << 100.0 * kMaxCovered
       << " % allowed";
  return text.str();
}

BandCutter BandCutter::between(double top_deg, double bottom_deg) {
  const int first = std::clamp(static_cast<int>(std::lround((90.0 - top_deg) * kRowsPerDegree)), 0, kRows - 2);
  const int last = std::clamp(static_cast<int>(std::lround((90.0 + bottom_deg) * kRowsPerDegree)), first + 2, kRows);
  return {first, (last - first) / 2 * 2};
}

cv::Mat BandCutter::cut(const cv::Mat& panorama) const {
  if (panorama.cols == kColumns) return vision::to_grey(panorama.rowRange(first_row, first_row + rows));
  cv::Mat resized;
  cv::resize(vision::to_grey(panorama), resized, cv::Size(kColumns, kRows), 0.0, 0.0, cv::INTER_AREA);
  return resized.rowRange(first_row, first_row + rows);
}

PanoramicCompass::PanoramicCompass(const CompassParameters& parameters, std::uint64_t seed,
                                   const Eigen::Matrix3d& base_from_panorama, vision::StageObserver* observer)
    : hangs_(vision::tilt_of_panorama(base_from_panorama) == vision::PanoramaTilt::kHanging) {
  check(parameters);
  const Eigen::Matrix3d mounting = hangs_ ? Eigen::Matrix3d(base_from_panorama * half_a_roll()) : base_from_panorama;
  method_ = parameters.method == "two_patches" ? make_two_patches(parameters, seed, mounting, observer)
                                               : make_all_round(parameters, seed, mounting, observer);
}

PanoramicCompass::~PanoramicCompass() = default;
PanoramicCompass::PanoramicCompass(PanoramicCompass&&) noexcept = default;

std::optional<AzimuthChange> PanoramicCompass::track(std::int64_t stamp_ns, const cv::Mat& panorama,
                                                     std::optional<double> expected_turn_rad) {
  return method_->track(stamp_ns, hangs_ ? turned_over(panorama) : panorama, expected_turn_rad.value_or(0.0));
}

void PanoramicCompass::set_seen(const cv::Mat& seen) {
  if (!hangs_) return method_->set_seen(seen);
  cv::Mat upright;
  cv::flip(seen, upright, -1);  // of a mask's large cells, none is a direction
  method_->set_seen(upright);
}

void PanoramicCompass::keep_earlier_points() { method_->keep_earlier_points(); }

const TrackedPoints* PanoramicCompass::points() const { return method_->points(); }

}  // namespace panvo::panoramic_compass
