// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "html_sections.hpp"
#include "html_text.hpp"
#include "journey_text.hpp"
#include "svg_chart.hpp"

namespace panvo::evaluation {
namespace {

std::string bar(const char* style, double time_ms, double max_ms) {
  return fmt::format("<div class=\"bar {}\" style=\"width:{:.2f}%\"></div>", style, 100.0 * time_ms / max_ms);
}

}  // namespace

std::string times_section(const JourneyReport& report) {
  double max_ms = 1.0;
  for (const auto& row : report.run.stages) {
    max_ms = std::max(max_ms, row.paper_ms.value_or(0.0));
    if (row.ours) max_ms = std::max(max_ms, row.ours->wall.median_ms);
  }
  std::string body =
      "<figure>" + legend({{"enhanced", "here, median"}, {"truth", "the paper's Table 3, on an Intel i5 at 2.8 GHz"}}) +
      "<div class=\"bars\">\n";
  std::string group;
  for (const auto& row : report.run.stages) {
    if (row.group != group) body += "<h3>" + html(row.group) + "</h3>\n";
    group = row.group;
    const std::string stage = row.ours ? row.ours->component + " / " + row.ours->stage : "not in this run";
    body += "<div>" + html(row.item) + "<small>" + html(stage) + "</small></div><div class=\"b\">";
    if (row.ours) body += bar("ours", row.ours->wall.median_ms, max_ms);
    if (row.paper_ms) body += bar("theirs", *row.paper_ms, max_ms);
    body += "</div><div class=\"n\">";
    body += row.ours ? fmt::format("{:.2f} ms<small>95 % {:.1f}, 99 % {:.1f}{}</small>", row.ours->wall.median_ms,
                                   row.ours->wall.p95_ms, row.ours->wall.p99_ms,
                                   row.paper_ms ? fmt::format("; paper {:g}", *row.paper_ms) : std::string())
                     : fmt::format("-<small>paper {}</small>", metres(row.paper_ms, 0));
    body += "</div>\n";
  }
  return html_section("Time of each stage",
                      "Wall time of each call, measured in the run; both odometry threads have their own line.",
                      body + "</div></figure>\n");
}

}  // namespace panvo::evaluation
