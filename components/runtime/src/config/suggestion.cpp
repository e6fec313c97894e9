// SPDX-License-Identifier: Apache-2.0
#include "suggestion.hpp"

#include <algorithm>
#include <span>

namespace panvo::runtime {
namespace {

std::string_view last_part(std::string_view name) { return name.substr(name.rfind('.') + 1); }

/// Names that differ in more than a third of their characters are not suggested.
std::size_t tolerated_edits(std::string_view name) { return std::max<std::size_t>(1, name.size() / 3); }

constexpr std::size_t kMaxListed = 20;  // a component may have a hundred parameters

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_previous, previous(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) {
    previous[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        current[j] = std::min(current[j], before_previous[j - 2] + 1);
      }
    }
    before_previous = previous;
    std::swap(previous, current);
  }
  return previous[b.size()];
}

std::string suggestion(std::string_view wrong, const std::vector<std::string>& known) {
  const std::string* nearest = nullptr;
  std::size_t least = 0;
  const auto consider = [&](const std::string& name, std::size_t distance, std::size_t tolerated) {
    if (distance <= tolerated && (nearest == nullptr || distance < least)) {
      nearest = &name;
      least = distance;
    }
  };
  for (const auto& name : known) {
    consider(name, edit_distance(wrong, name), tolerated_edits(wrong));
    if (wrong.find('.') == std::string_view::npos) {  // "max_feature" for "tracker.max_features"
      consider(name, edit_distance(wrong, last_part(name)) + 1, tolerated_edits(wrong));
    }
  }
  if (nearest != nullptr) {
    return "; did you mean \"" + *nearest + "\"?";
  }
  std::string list;
  for (const auto& name : std::span(known).first(std::min(known.size(), kMaxListed))) {
    list += (list.empty() ? "" : ", ") + name;
  }
  if (known.size() > kMaxListed) list += ", and " + std::to_string(known.size() - kMaxListed) + " more";
  return list.empty() ? "; there are none" : "; known names: " + list;
}

}  // namespace panvo::runtime
