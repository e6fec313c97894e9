// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "html_sections.hpp"
#include "html_text.hpp"
#include "journey_text.hpp"
#include "panorama_pair.hpp"

namespace panvo::evaluation {
namespace {

constexpr int kGap_px = 8;

std::string image(const std::string& jpeg, int top_px, int columns, int rows, const std::string& words) {
  return fmt::format(
      "<image y=\"{}\" width=\"{}\" height=\"{}\" href=\"data:image/jpeg;base64,{}\"><title>{}</title></image>\n",
      top_px, columns, rows, base64(jpeg), words);
}

/// Landmark above, revisit below, connected by SIFT matches.
std::string picture(const PanoramaPair& pair) {
  const int lower_px = pair.rows + kGap_px;
  auto text = fmt::format(
      "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"Panoramas of the landmark and of the "
      "revisit, one above the other\">\n",
      pair.columns, lower_px + pair.rows);
  text += image(pair.landmark_jpeg, 0, pair.columns, pair.rows, "at the creation of the landmark");
  text += image(pair.revisit_jpeg, lower_px, pair.columns, pair.rows, "now, rotated to the heading of the landmark");
  for (const auto& match : pair.inliers) {
    if (std::abs(match.landmark_px.x() - match.revisit_px.x()) > pair.columns / 2) continue;  // across the seam
    const double y = lower_px + match.revisit_px.y();
    if (match.landmark_px.y() < 0 || match.landmark_px.y() > pair.rows || y < lower_px) continue;
    if (match.revisit_px.y() > pair.rows) continue;
    text += fmt::format("<path class=\"match\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>", match.landmark_px.x(),
                        match.landmark_px.y(), match.revisit_px.x(), y);
  }
  return text + "</svg>\n";
}

std::string error_words(const Revisit& revisit) {
  if (revisit.after_m) {
    auto text = fmt::format("<b>{} m &rarr; {} m</b>, heading {}° &rarr; {}°; binocular odometry alone {} m",
                            metres(revisit.before_m), metres(revisit.after_m), degrees(revisit.before_heading_rad),
                            degrees(revisit.after_heading_rad), metres(revisit.binocular_m));
    if (revisit.landmark_m) {
      text += fmt::format("; error of the landmark at its creation {} m", metres(revisit.landmark_m));
    }
    return text;
  }
  return fmt::format("Error of the pose <b>{} m</b>, binocular odometry alone {} m", metres(revisit.before_m),
                     metres(revisit.binocular_m));
}

std::string card(const JourneyFrames& frames, const Revisit& revisit) {
  const bool is_corrected = revisit.after_m.has_value();
  const bool is_bad = revisit.is_wrong || revisit.result == RevisitResult::kMissed;
  auto text = fmt::format(
      "<article class=\"card\" id=\"revisit-{}\">\n<h3>{} &middot; {} <span class=\"chip {}\">{}{}</span></h3>\n",
      revisit.number, revisit.number,
      revisit.place ? html(revisit.name.empty() ? "place " + std::to_string(*revisit.place) : revisit.name)
                    : std::string("unlisted place"),
      is_bad         ? "bad"
      : is_corrected ? "good"
                     : "soft",
      to_string(revisit.result), revisit.is_wrong ? ", wrong" : "");
  text += fmt::format("<p>After {:.0f} m", revisit.travelled_m);
  if (revisit.landmark) text += fmt::format(", landmark {}", *revisit.landmark);
  text +=
      fmt::format(", entrance heading <b>{}°</b> relative to the first visit, viewpoints <b>{} m</b> apart. {}.</p>\n",
                  degrees(revisit.entrance_rad, 0), metres(revisit.distance_m, 1), error_words(revisit));
  if (!revisit.reason.empty()) {
    text += fmt::format("<p>Reason: {}.</p>\n", html(revisit.reason));
  }
  const auto& past = revisit.landmark_was_earlier && frames.earlier != nullptr ? *frames.earlier : frames.recording;
  const auto* then = revisit.landmark_stamp_ns ? panorama_near(past, *revisit.landmark_stamp_ns) : nullptr;
  const auto* now = panorama_near(frames.recording, revisit.stamp_ns);
  if (then == nullptr || now == nullptr) {
    return text + "<p>No panoramas of both visits in the recording.</p>\n</article>\n";
  }
  const auto pair = panorama_pair(then->file, now->file, revisit.heading_rad.value_or(revisit.true_heading_rad));
  text += picture(pair);
  text +=
      fmt::format("<p>Above: {}. Below: now, rotated by {}°{} so that distant objects line up. {}</p>\n",
                  revisit.landmark ? "at the creation of the landmark" : "at the first visit",
                  degrees(revisit.heading_rad.value_or(revisit.true_heading_rad)),
                  revisit.heading_rad ? fmt::format(", as estimated (true: {}°),", degrees(revisit.true_heading_rad))
                                      : " (true value)",
                  pair.inliers.empty() ? fmt::format("{} SIFT matches, not consistent with one motion.", pair.matches)
                                       : fmt::format("Lines: {} of {} SIFT matches, consistent with one motion.",
                                                     pair.inliers.size(), pair.matches));
  return text + "</article>\n";
}

}  // namespace

std::string revisits_section(const JourneyReport& report) {
  const auto& revisits = report.run.revisits.revisits;
  if (revisits.empty()) {
    return html_section("Revisits", "No revisits known.", "");
  }
  std::string cards;
  for (const auto& revisit : revisits) cards += card(report.run.frames, revisit);
  return html_section("Revisits, one by one",
                      "Above: panorama of the landmark. Below: panorama of the revisit. Lines: SIFT matches, "
                      "recomputed for this report from the two images only.",
                      cards);
}

}  // namespace panvo::evaluation
