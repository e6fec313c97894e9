// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "panvo/calibration/report.hpp"
#include "report_rows.hpp"

namespace panvo::calibration {
namespace {

constexpr std::size_t kMaxListed = 40;  // images not used; the page lists all

/// Formats a table: first column left-aligned, others right-aligned; all left-aligned if `is_last_text`.
std::string table(const Rows& rows, bool is_last_text = false) {
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const bool is_left = i == 0 || (is_last_text && i > 0);
      line += is_left ? fmt::format("  {:<{}}", row[i], widths[i]) : fmt::format("  {:>{}}", row[i], widths[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace

std::string to_text(const Report& report) {
  const auto& calibration = report.calibration;
  std::string text =
      fmt::format("{}: board {}\n\n{}", report.title, to_string(report.board), table(camera_rows(report)));
  // in a rig most cameras do not see the board in most views
  auto rejected = rejection_rows(report, calibration.used.cameras.size() <= 2);
  if (rejected.size() > 1) {
    const std::size_t left_out = rejected.size() - std::min(rejected.size(), kMaxListed + 1);
    rejected.resize(rejected.size() - left_out);
    text += "\nnot used\n" + table(rejected, true);
    if (left_out > 0) text += fmt::format("  ... and {} more (report.html lists all)\n", left_out);
  }
  for (std::size_t camera = 0; camera < calibration.used.cameras.size(); ++camera) {
    const auto& lens = calibration.rig.cameras[camera].lens;
    text += fmt::format("\n{}: {}, {} x {} px\n{}", calibration.used.cameras[camera], vision::ros_name(lens.model),
                        lens.pinhole.width, lens.pinhole.height, table(parameter_rows(report, camera)));
  }
  text += fmt::format("\nposes in the frame of {} (x right, y down, z forward)\n{}",
                      calibration.used.cameras[report.reference], table(pose_rows(report)));
  if (report.pair)
    text += fmt::format("\nrectified: focal length {:.2f} px, baseline {:.5f} m\n{}\n", report.pair->camera.fx,
                        report.pair->baseline_m, epipolar_sentence(report));
  for (const auto& doubt : doubts(report)) text += "\nwarning: " + doubt;
  return text + "\n";
}

}  // namespace panvo::calibration
