// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "panvo/calibration/report.hpp"
#include "report_rows.hpp"

namespace panvo::calibration {
namespace {

constexpr const char* kStyle = R"(
body { margin: 0; background: #fbfaf7; color: #1d2125; font: 16px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif;
  font-variant-numeric: tabular-nums; }
main { max-width: 1120px; margin: 0 auto; padding: 2rem 1.25rem 4rem; }
h1 { font-size: 1.9rem; margin: 0 0 .3rem; } h2 { font-size: 1.25rem; margin: 2.4rem 0 .4rem; }
p.lead { color: #646b73; margin: 0 0 1rem; max-width: 80ch; }
figure { margin: 0 0 1rem; padding: .6rem; background: #fff; border: 1px solid #dedbd4; border-radius: 10px; }
svg { max-width: 100%; height: auto; display: block; }
table { border-collapse: collapse; font-size: .9rem; margin: 0 0 1rem; }
th { color: #646b73; font-weight: 500; } th, td { text-align: right; padding: .3rem .7rem; border-bottom: 1px solid #dedbd4; }
th:first-child, td:first-child { text-align: left; padding-left: 0; } table.words th, table.words td { text-align: left; }
.doubts { border-left: 4px solid #d55e00; padding: .2rem 1rem; background: #fff; } .good { border-color: #00805d; }
@media print { main { padding: 0; } figure, tr { break-inside: avoid; } }
)";

std::string html(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else {
      result += c;
    }
  }
  return result;
}

std::string html_table(const Rows& rows, const char* kind = "") {
  std::string text = fmt::format("<table class=\"{}\">\n", kind);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    text += "<tr>";
    for (const auto& cell : rows[i]) text += fmt::format("<{0}>{1}</{0}>", i == 0 ? "th" : "td", html(cell));
    text += "</tr>\n";
  }
  return text + "</table>\n";
}

std::string doubts_section(const Report& report) {
  const auto found = doubts(report);
  if (found.empty()) return "<div class=\"doubts good\"><p>No problems found.</p></div>\n";
  std::string text = "<div class=\"doubts\"><p>Problems and remedies:</p>\n<ul>\n";
  for (const auto& doubt : found) text += "<li>" + html(doubt) + "</li>\n";
  return text + "</ul></div>\n";
}

std::string camera_section(const Report& report, std::size_t camera) {
  const auto& lens = report.calibration.rig.cameras[camera].lens;
  return fmt::format("<h2>{}</h2>\n<p class=\"lead\">{}, {} x {} px</p>\n<figure>{}</figure>\n<figure>{}</figure>\n{}",
                     html(report.calibration.used.cameras[camera]), vision::ros_name(lens.model), lens.pinhole.width,
                     lens.pinhole.height, coverage_svg(report, camera), residual_svg(report, camera),
                     html_table(parameter_rows(report, camera)));
}

}  // namespace

std::string to_page(const Report& report) {
  std::string page = fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta "
      "charset=\"utf-8\">\n<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<main>\n"
      "<h1>{0}</h1>\n<p class=\"lead\">Board {2}</p>\n",
      html(report.title), kStyle, html(to_string(report.board)));
  page += doubts_section(report);
  page += "<h2>Cameras</h2>\n" + html_table(camera_rows(report));
  page += fmt::format("<h2>Poses</h2>\n<p class=\"lead\">In the frame of {}: x right, y down, z forward.</p>\n{}",
                      html(report.calibration.used.cameras[report.reference]), html_table(pose_rows(report)));
  if (report.pair)
    page += fmt::format("<h2>Rectified pair</h2>\n<p>Focal length {:.2f} px, baseline {:.5f} m; {}.</p>\n",
                        report.pair->camera.fx, report.pair->baseline_m, epipolar_sentence(report));
  for (std::size_t camera = 0; camera < report.calibration.used.cameras.size(); ++camera)
    page += camera_section(report, camera);
  if (const auto rejected = rejection_rows(report, true); rejected.size() > 1)
    page += "<h2>Images not used</h2>\n" + html_table(rejected, "words");
  return page + "</main>\n</body>\n</html>\n";
}

}  // namespace panvo::calibration
