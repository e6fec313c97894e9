// SPDX-License-Identifier: Apache-2.0
#include "panvo/recorder/topic_filter.hpp"

#include <algorithm>
#include <sstream>

#include "panvo/recorder/bag_error.hpp"

namespace panvo::recorder {

TopicFilter::TopicFilter(const std::vector<std::string>& topics, const std::vector<std::string>& exclude)
    : include_(compile(topics)), exclude_(compile(exclude)) {}

bool TopicFilter::accepts(const std::string& topic) const {
  const auto matches = [&](const Pattern& pattern) { return pattern.matches(topic); };
  return (include_.empty() || std::any_of(include_.begin(), include_.end(), matches)) &&
         std::none_of(exclude_.begin(), exclude_.end(), matches);
}

std::vector<std::string> TopicFilter::unmatched(const std::vector<std::string>& names) const {
  std::vector<std::string> unmatched;
  for (const auto& pattern : include_) {
    if (std::none_of(names.begin(), names.end(), [&](const auto& name) { return pattern.matches(name); })) {
      unmatched.push_back(pattern.text);
    }
  }
  return unmatched;
}

bool TopicFilter::Pattern::matches(const std::string& topic) const {
  constexpr std::size_t kLongest = 1000;  // ROS has 255; std::regex needs stack for each letter
  return text == topic || "/" + text == topic || (topic.size() <= kLongest && std::regex_match(topic, regex));
}

std::vector<TopicFilter::Pattern> TopicFilter::compile(const std::vector<std::string>& patterns) {
  std::vector<Pattern> compiled;
  for (const auto& item : patterns) {
    std::istringstream words(item);
    for (std::string text; words >> text;) {
      try {
        compiled.push_back({text, std::regex(text, std::regex::ECMAScript | std::regex::optimize)});
      } catch (const std::regex_error& error) {
        throw BagError("topic pattern '" + text + "' is neither a topic name nor a valid regular expression (" +
                       error.what() + "); e.g. /stereo/.* selects all topics that begin with /stereo/");
      }
    }
  }
  return compiled;
}

}  // namespace panvo::recorder
