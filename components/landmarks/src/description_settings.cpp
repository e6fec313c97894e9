// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/description_settings.hpp"

#include <set>

namespace panvo::landmarks {

std::vector<std::string> differences(const DescriptionSettings& there, const DescriptionSettings& here) {
  std::set<std::string> keys;
  for (const auto& [key, value] : there) keys.insert(key);
  for (const auto& [key, value] : here) keys.insert(key);
  const auto value_in = [](const DescriptionSettings& settings, const std::string& key) {
    const auto found = settings.find(key);
    return found == settings.end() ? std::string("not set") : found->second;
  };
  std::vector<std::string> sentences;
  for (const auto& key : keys) {
    const auto value_there = value_in(there, key);
    const auto value_here = value_in(here, key);
    if (value_there != value_here) {
      sentences.push_back(key + " is " + value_there + " there, " + value_here + " here");
    }
  }
  return sentences;
}

std::string to_text(const DescriptionSettings& settings) {
  std::string text;
  for (const auto& [key, value] : settings) text += key + "=" + value + "\n";
  return text;
}

DescriptionSettings settings_from_text(std::string_view text) {
  DescriptionSettings settings;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    const auto line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty()) continue;
    const auto sign = std::min(line.find('='), line.size());
    settings.insert_or_assign(std::string(line.substr(0, sign)),
                              std::string(line.substr(std::min(sign + 1, line.size()))));
  }
  return settings;
}

}  // namespace panvo::landmarks
