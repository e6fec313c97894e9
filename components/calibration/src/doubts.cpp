// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "panvo/calibration/coverage.hpp"
#include "panvo/calibration/report.hpp"
#include "report_rows.hpp"

namespace panvo::calibration {
namespace {

constexpr std::size_t kManyViews = 15;
constexpr double kSharp_px = 0.8;      // reprojection rms above which the lens model or the images are poor
constexpr double kKnownFocal = 0.002;  // largest relative standard deviation of the focal length
constexpr double kRowsAgree_px = 0.3;  // row error that matching along rows tolerates without loss
constexpr double kMaxRejected = 0.3;

void doubt_camera(const Report& report, std::size_t camera, std::vector<std::string>& found) {
  const auto& [rig, used, residuals, rejections, strays, sigmas] = report.calibration;
  const auto& name = used.cameras[camera];
  const auto& lens = rig.cameras[camera].lens;
  const std::size_t views = used_views(used, camera);
  const std::size_t seen = used_views(report.seen, camera);
  const bool is_held = sigmas && (*sigmas)[camera].lens.isZero();
  if (const double rms = rms_px(residuals_of(report, camera)); rms > kSharp_px)
    found.push_back(fmt::format(
        "{}: corners are {:.2f} px off (rms): check that the board is flat, its dimensions are correct and the images "
        "are sharp, or try another --model than {}",
        name, rms, vision::ros_name(lens.model)));
  if (static_cast<double>(seen - views) > kMaxRejected * static_cast<double>(seen))
    found.push_back(fmt::format(
        "{}: {} of {} images are inconsistent: keep board and cameras still, and trigger the cameras together", name,
        seen - views, seen));
  if (is_held) return;
  if (views < kManyViews)
    found.push_back(fmt::format("{}: only {} images are used: take 20 or more, near and far, tilted in all directions",
                                name, views));
  if (const double share = coverage(used, camera).share; share < Coverage::kGood)
    found.push_back(
        fmt::format("{}: corners cover only {:.0f} % of the image: hold the board closer to the borders, or use a "
                    "ChArUco board, which may extend beyond them",
                    name, 100.0 * share));
  const bool is_focal_correlated =
      vision::visit_lens(lens.model, [](const auto& formula) { return formula.kIsFocalCorrelated; });
  if (sigmas && (*sigmas)[camera].lens[0] > kKnownFocal * lens.pinhole.fx && !is_focal_correlated)
    found.push_back(
        fmt::format("{}: the focal length has a standard deviation of {:.2f} %: tilt the board by 30 to 45 degrees and "
                    "move it closer",
                    name, 100.0 * (*sigmas)[camera].lens[0] / lens.pinhole.fx));
}

}  // namespace

std::vector<std::string> doubts(const Report& report) {
  std::vector<std::string> found;
  for (std::size_t camera = 0; camera < report.calibration.used.cameras.size(); ++camera)
    doubt_camera(report, camera, found);
  if (!report.calibration.sigmas)
    found.emplace_back(
        "the images do not determine all parameters: take more, with the board tilted and in all parts of the image, "
        "or "
        "choose a model with fewer coefficients");
  if (report.pair) {
    const auto summary = summarise(report.epipolar);
    if (summary.corners == 0) {
      found.emplace_back("no corner is in both rectified images, so their row alignment is not checked");
    } else if (summary.rms_px > kRowsAgree_px) {
      found.push_back(fmt::format(
          "rows of the rectified images are {:.2f} px off (rms): check that both cameras expose at the same moment",
          summary.rms_px));
    }
  }
  return found;
}

}  // namespace panvo::calibration
