// SPDX-License-Identifier: Apache-2.0
#include "answer_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "panvo/vision/angle.hpp"

namespace panvo::places {
namespace {

double degrees(double rad) { return rad / vision::kDegree; }

/// Azimuth, left positive as headings are, from straight ahead of the place's panorama.
double bearing_deg(const Eigen::Vector3d& direction) { return -degrees(azimuth_of(direction)); }

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

std::string state_of(const ImageAnswer& answer) {
  if (answer.fault) return "skipped";
  return answer.answer.place ? "found" : "unknown";
}

std::string reason_of(const ImageAnswer& answer, const std::vector<KnownPlace>& places) {
  if (answer.fault) return *answer.fault;
  const auto& shared = answer.answer.shared;
  if (shared.view) return fmt::format("{} of {} matches agree", shared.agreeing, shared.matches);
  if (places.empty()) return shared.reason;
  if (shared.agreeing == 0) return "matches with no place agree more than by chance";
  return fmt::format("best {}: {}", places[answer.answer.nearest].name, shared.reason);
}

}  // namespace

std::string line_of(const ImageAnswer& answer, const std::vector<KnownPlace>& places) {
  if (answer.fault) return fmt::format("{}: skipped: {}", answer.image, *answer.fault);
  const auto& shared = answer.answer.shared;
  if (!shared.view) return fmt::format("{}: unknown ({})", answer.image, reason_of(answer, places));
  const auto& view = *shared.view;
  std::string text =
      fmt::format("{}: {}, heading {:+.1f} +- {:.1f} deg", answer.image, places[*answer.answer.place].name,
                  degrees(view.heading_rad), degrees(view.heading_sigma_rad));
  if (view.direction) {
    text += fmt::format(", to {:+.0f} +- {:.0f} deg, {:.2f} of the range", bearing_deg(*view.direction),
                        degrees(view.direction_sigma_rad), view.baseline_per_range);
  } else {
    text += ", direction not observable";
  }
  if (const auto& at = answer.answer.position) {
    const auto& position = at->map_from_base.translation();
    text += fmt::format(", at {:.2f} {:.2f} +- {:.2f} m", position.x(), position.y(), at->sigma_m);
  }
  return text + fmt::format(" ({}; chance 1e{:.0f})", reason_of(answer, places), shared.log10_expected);
}

std::string csv_header() {
  return "image,state,place,heading_deg,heading_sigma_deg,direction_deg,direction_sigma_deg,baseline_per_range,matches,"
         "agreeing,"
         "log10_by_chance,place_x_m,place_y_m,x_m,y_m,sigma_m,reason\n";
}

std::string csv_line(const ImageAnswer& answer, const std::vector<KnownPlace>& places) {
  std::string line = quoted(answer.image) + "," + state_of(answer) + ",";
  const auto& shared = answer.answer.shared;
  if (!answer.fault && shared.view) {
    const auto& view = *shared.view;
    line += fmt::format("{},{:.2f},{:.2f},", quoted(places[*answer.answer.place].name), degrees(view.heading_rad),
                        degrees(view.heading_sigma_rad));
    line += view.direction ? fmt::format("{:.1f},{:.1f},{:.3f},", bearing_deg(*view.direction),
                                         degrees(view.direction_sigma_rad), view.baseline_per_range)
                           : ",,,";
  } else {
    line += ",,,,,,";
  }
  line += answer.fault ? ",,," : fmt::format("{},{},{:.1f},", shared.matches, shared.agreeing, shared.log10_expected);
  const bool has_pose = answer.answer.place && places[*answer.answer.place].map_from_base;
  if (has_pose) {
    const auto& position = places[*answer.answer.place].map_from_base->translation();
    line += fmt::format("{:.3f},{:.3f},", position.x(), position.y());
  } else {
    line += ",,";
  }
  if (const auto& at = answer.answer.position) {
    const auto& position = at->map_from_base.translation();
    line += fmt::format("{:.3f},{:.3f},{:.3f},", position.x(), position.y(), at->sigma_m);
  } else {
    line += ",,,";
  }
  return line + quoted(reason_of(answer, places)) + "\n";
}

nlohmann::json json_of(const ImageAnswer& answer, const std::vector<KnownPlace>& places) {
  nlohmann::json json{{"image", answer.image}, {"state", state_of(answer)}, {"reason", reason_of(answer, places)}};
  if (answer.fault) return json;
  const auto& shared = answer.answer.shared;
  json["matches"] = shared.matches;
  json["agreeing"] = shared.agreeing;
  json["log10_by_chance"] = shared.log10_expected;
  json["verified_places"] = answer.answer.verified;
  if (!shared.view) return json;
  const auto& view = *shared.view;
  const auto& place = places[*answer.answer.place];
  json["place"] = place.name;
  json["heading_deg"] = degrees(view.heading_rad);
  json["heading_sigma_deg"] = degrees(view.heading_sigma_rad);
  json["agreeing_places"] = answer.answer.agreeing_places;
  if (view.direction) {
    json["direction_deg"] = bearing_deg(*view.direction);
    json["direction_sigma_deg"] = degrees(view.direction_sigma_rad);
    json["baseline_per_range"] = view.baseline_per_range;
  }
  if (place.map_from_base) {
    const auto& position = place.map_from_base->translation();
    json["place_position_m"] = {position.x(), position.y(), position.z()};
  }
  if (const auto& at = answer.answer.position) {
    const auto& position = at->map_from_base.translation();
    json["position_m"] = {position.x(), position.y(), position.z()};
    json["position_sigma_m"] = at->sigma_m;
  }
  return json;
}

}  // namespace panvo::places
