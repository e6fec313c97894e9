// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <regex>
#include <string>
#include <vector>

namespace panvo::recorder {

/// Selects topics to record, play or compare. A pattern is a topic name ("/tf" or "tf") or an ECMAScript regular
/// expression for the whole name ("/stereo/.*"). A string may hold several patterns separated by spaces, as in a launch
/// argument. Exclusion takes precedence. A name longer than that of any topic matches no expression.
class TopicFilter {
 public:
  /// Accepts everything.
  TopicFilter() = default;

  /// Accepts topics that match a pattern of `topics` (all if empty) and none of `exclude`. Throws BagError that names
  /// an invalid pattern.
  explicit TopicFilter(const std::vector<std::string>& topics, const std::vector<std::string>& exclude = {});

  bool accepts(const std::string& topic) const;

  /// Patterns of `topics` that match none of `names`, probably misspelt.
  std::vector<std::string> unmatched(const std::vector<std::string>& names) const;

 private:
  struct Pattern {
    std::string text;
    std::regex regex;
    bool matches(const std::string& topic) const;
  };
  static std::vector<Pattern> compile(const std::vector<std::string>& patterns);

  std::vector<Pattern> include_;
  std::vector<Pattern> exclude_;
};

}  // namespace panvo::recorder
