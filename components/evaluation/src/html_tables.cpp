// SPDX-License-Identifier: Apache-2.0
#include "html_sections.hpp"
#include "html_text.hpp"
#include "journey_text.hpp"
#include "panvo/evaluation/paper_figures.hpp"

namespace panvo::evaluation {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string chip(const Revisit& revisit) {
  const bool is_corrected =
      revisit.result == RevisitResult::kCorrected || revisit.result == RevisitResult::kHeadingOnly;
  const bool is_bad = revisit.is_wrong || revisit.result == RevisitResult::kMissed;
  return fmt::format("<span class=\"chip {}\">{}{}</span>",
                     is_bad         ? "bad"
                     : is_corrected ? "good"
                                    : "soft",
                     to_string(revisit.result), revisit.is_wrong ? ", wrong" : "");
}

std::string place_number(const Revisit& revisit) {
  if (!revisit.place) return "<span class=\"soft\">elsewhere</span>";
  return fmt::format("{} {}", *revisit.place, html(revisit.name));
}

std::string revisits_table(const RevisitScore& score, const std::string& caption) {
  Rows rows;
  for (const auto& revisit : score.revisits) {
    rows.push_back({std::to_string(revisit.number), place_number(revisit), chip(revisit),
                    revisit.landmark ? std::to_string(*revisit.landmark) : "-", degrees(revisit.entrance_rad, 0),
                    metres(revisit.binocular_m), metres(revisit.before_m), metres(revisit.after_m),
                    degrees(revisit.before_heading_rad), degrees(revisit.after_heading_rad), metres(revisit.landmark_m),
                    metres(revisit.beyond_m), metres(revisit.travelled_m, 0)});
  }
  return html_table(
      {"", "place", "correction", "landmark", "entrance<br>°", "binocular<br>m", "before<br>m", "after<br>m",
       "heading<br>before °", "heading<br>after °", "landmark's<br>own m", "beyond<br>it m", "travelled<br>m"},
      rows, 3, caption);
}

std::string compared_table(const JourneyReport& report) {
  Rows rows;
  for (const auto& [ours, papers] : side_by_side(report)) {
    rows.push_back({std::to_string(ours->number), place_number(*ours), chip(*ours), metres(ours->before_m),
                    metres(ours->after_m), chip(*papers), metres(papers->before_m), metres(papers->after_m)});
  }
  return html_table({"", "place", "ours", "before<br>m", "after<br>m", "the paper's", "before<br>m", "after<br>m"},
                    rows, 3, "panvo's correction and the paper's own, side by side");
}

std::string paper_table(bool is_second_journey) {
  Rows rows;
  for (const auto& row : is_second_journey ? paper::table_4() : paper::table_2()) {
    rows.push_back({std::to_string(row.number), std::to_string(row.landmark), std::string(row.correction),
                    metres(row.entrance_deg, 0), metres(row.binocular_m, 1), metres(row.enhanced_m, 1),
                    metres(row.travelled_m, 0)});
  }
  return html_table(
      {"", "landmark", "correction", "entrance<br>°", "binocular<br>m", "enhanced<br>m", "travelled<br>m"}, rows, 3,
      fmt::format("Table {} of the paper, on another campus, about 1.7 km", is_second_journey ? 4 : 2));
}

std::string paths_table(const JourneyReport& report) {
  const auto row = [](const std::string& name, const PathScore& path) {
    return std::vector<std::string>{name,
                                    metres(path.ate_m.rmse),
                                    path.ate_se3_m ? metres(path.ate_se3_m->rmse) : "-",
                                    metres(path.flat_m.rmse),
                                    metres(path.flat_m.median),
                                    metres(path.percent_of_way, 3),
                                    turn(path.heading_rad.rmse),
                                    metres(path.final_m),
                                    metres(path.worst_m)};
  };
  Rows rows{row("binocular odometry", report.run.paths.binocular), row("enhanced odometry", report.run.paths.enhanced)};
  if (report.paper_run) rows.push_back(row("with the paper's own correction", report.paper_run->paths.enhanced));
  return html_table({"whole path", "ATE<br>m", "ATE, SE3<br>aligned m", "2D rms<br>m", "2D median<br>m",
                     "2D rms<br>% of distance", "heading rms<br>°", "at the end<br>m", "largest<br>m"},
                    rows, 1);
}

}  // namespace

std::string elsewhere_words(const RevisitScore& score) {
  if (score.elsewhere == 0) return "";
  return fmt::format("; {} recognised at {} that the recording does not list", score.elsewhere,
                     score.elsewhere == 1 ? "a place" : "places");
}

std::string tables_section(const JourneyReport& report) {
  const int number = report.is_second_journey ? 4 : 2;
  const auto& revisits = report.run.revisits;
  auto body =
      paths_table(report) + revisits_table(revisits, fmt::format("Revisits, as in Table {} of the paper", number));
  if (report.paper_run) {
    body += compared_table(report);
    body +=
        revisits_table(report.paper_run->revisits, "The same journey with the paper's own correction (section 5.2)");
  }
  body += paper_table(report.is_second_journey);
  return html_section(
      "Results",
      fmt::format(
          "{} listed revisits: {} corrected, {} in heading only, {} given up because the pose was already more "
          "accurate, "
          "{} rejected, {} missed{}. {} corrections applied, {} wrong: their error exceeds both the previous error and "
          "the "
          "landmark's own error by more than 1 m. Errors are horizontal. The landmark's own error is that of its pose "
          "at creation; a revisit can hardly reduce the error below it.{}",
          revisits.listed, revisits.corrected, revisits.heading_only, revisits.given_up, revisits.rejected,
          revisits.missed, elsewhere_words(revisits), revisits.applied.size(), revisits.wrong,
          revisits.not_reached > 0
              ? fmt::format(" {} more were not reached: the run covers only part of the recording.",
                            revisits.not_reached)
              : std::string()),
      body);
}

}  // namespace panvo::evaluation
