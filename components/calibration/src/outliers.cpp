// SPDX-License-Identifier: Apache-2.0
#include "outliers.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace panvo::calibration {
namespace {

constexpr double kMedianOfRayleigh = 1.1774;  // median norm of a vector of two normal errors with deviation 1
constexpr double kStraySigmas = 5.0;          // one good corner in 270 000
constexpr double kStrayAlways_px = 0.5;       // smaller errors are never outliers
constexpr double kBadViewTimes = 4.0;         // ratio of a view's median to its camera's median
constexpr double kBadViewAlways_px = 0.5;
constexpr double kMaxStrays = 0.3;  // fraction of outliers above which the whole sighting is rejected

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Error norms by view and camera, in the order of the corners.
std::vector<std::vector<std::vector<double>>> distances_px(const Observations& observations, const Rig& rig) {
  std::vector<std::vector<std::vector<double>>> all(observations.views.size(),
                                                    std::vector<std::vector<double>>(observations.cameras.size()));
  for (const auto& residual : residuals(observations, rig))
    all[residual.view][residual.camera].push_back(residual.error_px.norm());
  return all;
}

std::vector<double> medians_px(const std::vector<std::vector<std::vector<double>>>& distances, std::size_t cameras) {
  std::vector<double> medians;
  for (std::size_t camera = 0; camera < cameras; ++camera) {
    std::vector<double> all;
    for (const auto& view : distances) all.insert(all.end(), view[camera].begin(), view[camera].end());
    medians.push_back(median(all));
  }
  return medians;
}

double stray_limit_px(double usual_px) {
  return std::max(kStrayAlways_px, kStraySigmas * usual_px / kMedianOfRayleigh);
}

}  // namespace

bool reject_sightings(Observations& observations, Rig& rig, std::vector<Rejection>& rejections) {
  const auto distances = distances_px(observations, rig);
  const auto usual_px = medians_px(distances, observations.cameras.size());
  bool is_changed = false;
  for (std::size_t view = 0; view < observations.views.size(); ++view) {
    auto& seen = observations.views[view].seen;
    for (std::size_t camera = 0; camera < seen.size(); ++camera) {
      const auto& off = distances[view][camera];
      const double of_view_px = median(off);
      const double limit_px = std::max(kBadViewAlways_px, kBadViewTimes * usual_px[camera]);
      const auto strays = std::count_if(off.begin(), off.end(),
                                        [&](double distance) { return distance > stray_limit_px(usual_px[camera]); });
      if (of_view_px <= limit_px && static_cast<double>(strays) <= kMaxStrays * static_cast<double>(off.size()))
        continue;
      rejections.push_back(
          {camera, view,
           fmt::format("its corners are {:.2f} px off (median; {:.2f} px over all views): blurred, or the "
                       "board moved between the exposures",
                       of_view_px, usual_px[camera])});
      seen[camera].clear();
      is_changed = true;
    }
    if (std::all_of(seen.begin(), seen.end(), [](const auto& corners) { return corners.empty(); }))
      rig.reference_from_board[view].reset();
  }
  return is_changed;
}

bool reject_corners(Observations& observations, const Rig& rig, std::vector<std::size_t>& stray_corners) {
  const auto distances = distances_px(observations, rig);
  const auto usual_px = medians_px(distances, observations.cameras.size());
  std::size_t strays = 0;
  for (std::size_t view = 0; view < observations.views.size(); ++view) {
    for (std::size_t camera = 0; camera < observations.cameras.size(); ++camera) {
      const auto& off = distances[view][camera];
      if (off.empty()) continue;
      std::size_t i = 0;
      const auto gone = std::erase_if(observations.views[view].seen[camera],
                                      [&](const Corner&) { return off[i++] > stray_limit_px(usual_px[camera]); });
      stray_corners[camera] += gone;
      strays += gone;
    }
  }
  return strays > 0;
}

}  // namespace panvo::calibration
