// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "html_sections.hpp"
#include "html_text.hpp"
#include "journey_text.hpp"
#include "svg_chart.hpp"

namespace panvo::evaluation {
namespace {

std::string style_of(const std::string& state) {
  static constexpr std::array<std::string_view, 7> kKnown{"starting", "unlocated",   "tracking", "compass_only",
                                                          "lost",     "relocalised", "stale"};
  const bool is_known = std::find(kKnown.begin(), kKnown.end(), state) != kKnown.end();
  return "state-" + (is_known ? state : std::string("other"));
}

}  // namespace

std::string states_section(const JourneyReport& report) {
  // In state "starting", stamps are wall-clock times.
  auto states = report.run.frames.run.states;
  states.erase(states.begin(),
               std::find_if(states.begin(), states.end(), [](const auto& state) { return state.state != "starting"; }));
  if (states.empty()) return "";
  const auto first_ns = states.front().stamp_ns;
  const auto seconds = [&](std::int64_t stamp_ns) { return static_cast<double>(stamp_ns - first_ns) * 1e-9; };
  const double end_s = std::max(seconds(states.back().stamp_ns), 1.0);
  SvgChart chart(1060.0, 96.0, {12.0, 8.0, 1048.0, 52.0}, {0.0, end_s}, {0.0, 1.0}, "State of the localizer over time");
  const double step_s = round_number_below(end_s / 5.0);
  for (double at_s = 0.0; at_s <= end_s; at_s += step_s) {
    chart.label({at_s, 0.0}, 0.0, 18.0, at_s == 0.0 ? "start" : "middle", fmt::format("{:g} s", at_s), "tick");
  }
  std::map<std::string, double> lasting_s;
  for (std::size_t i = 0; i < states.size();) {
    std::size_t next = i + 1;
    while (next < states.size() && states[next].state == states[i].state) ++next;
    const double to_s = next < states.size() ? seconds(states[next].stamp_ns) : end_s;
    const double from_s = seconds(states[i].stamp_ns);
    lasting_s[states[i].state] += to_s - from_s;
    chart.band(from_s, to_s, style_of(states[i].state),
               fmt::format("{}, {:.1f} to {:.1f} s{}{}", states[i].state, from_s, to_s,
                           states[i].reason.empty() ? "" : ": ", states[i].reason));
    i = next;
  }
  std::vector<std::pair<std::string, std::string>> keys;
  for (const auto& [state, time_s] : lasting_s) {
    keys.emplace_back("dot " + style_of(state),
                      fmt::format("{} {:.0f} s ({:.1f} %)", state, time_s, 100.0 * time_s / end_s));
  }
  return html_section("Localization state over time", "State reported by the localizer.",
                      "<figure>" + legend(keys) + chart.text() + "</figure>\n");
}

}  // namespace panvo::evaluation
