// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <regex>
#include <string>
#include <vector>

namespace panvo::recorder {

/// Which topics to record, play or compare. A pattern is a topic's name ("/tf", or "tf" for it) or an ECMAScript
/// regular expression that matches the whole name ("/stereo/.*"); one text may hold several, with blanks between
/// them, as a launch argument does. Excluding wins.
class TopicFilter {
 public:
  /// Accepts everything.
  TopicFilter() = default;

  /// Accepts what one of `topics` matches (everything where there is none) and none of `exclude`. Throws BagError
  /// naming a pattern that is no regular expression.
  explicit TopicFilter(const std::vector<std::string>& topics, const std::vector<std::string>& exclude = {});

  bool accepts(const std::string& topic) const;

  /// The patterns of `topics` that match none of `names`: most likely misspelt.
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
