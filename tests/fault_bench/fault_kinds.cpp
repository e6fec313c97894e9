// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <stdexcept>
#include <string>

#include "kinds.hpp"

namespace panvo::test {
namespace {

Fault nothing(Draw&, const FaultWindow&) { return {}; }

std::vector<FaultKind> all_kinds() {
  std::vector<FaultKind> kinds{{"none", "undisturbed recording", Lasting::kWhole, nothing}};
  for (const auto& part : {image_kinds(), optics_kinds(), timing_kinds(), panorama_kinds(), calibration_kinds(),
                           message_kinds(), mixed_kinds()}) {
    kinds.insert(kinds.end(), part.begin(), part.end());
  }
  return kinds;
}

FaultWindow draw_window(Lasting lasting, Draw& draw, double span_s) {
  constexpr double kMin_s = 2.0, kMax_s = 5.0, kMaxShare = 0.25;
  if (lasting == Lasting::kWhole) return {0.0, span_s};
  const double from_s = draw.uniform(0.25, 0.45) * span_s;
  const double length_s = std::min(draw.uniform(kMin_s, kMax_s), kMaxShare * span_s);
  return {from_s, lasting == Lasting::kOnward ? span_s : from_s + length_s};
}

}  // namespace

const std::vector<FaultKind>& fault_kinds() {
  static const std::vector<FaultKind> kinds = all_kinds();
  return kinds;
}

const FaultKind& fault_kind(std::string_view name) {
  const auto& kinds = fault_kinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const auto& kind) { return kind.name == name; });
  if (found != kinds.end()) return *found;
  std::string there;
  for (const auto& kind : kinds) there += (there.empty() ? "" : ", ") + std::string(kind.name);
  throw std::invalid_argument("unknown fault '" + std::string(name) + "'; available: " + there);
}

FaultWindow fault_window(const FaultKind& kind, std::uint64_t seed, double span_s) {
  Draw draw(seed, kind.name);
  return draw_window(kind.lasting, draw, span_s);
}

Fault make_fault(const FaultKind& kind, std::uint64_t seed, double span_s) {
  Draw draw(seed, kind.name);
  const FaultWindow window = draw_window(kind.lasting, draw, span_s);
  return kind.make(draw, window);
}

}  // namespace panvo::test
