// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <utility>

#include "panvo/runtime/logger.hpp"

namespace panvo::runtime {

/// Warns of what is wrong when it begins, not with every message.
class NewWarnings {
 public:
  /// `log` must outlive it.
  explicit NewWarnings(const Logger& log) : log_(log) {}

  /// Says it, unless it is the last warning again but for its numbers.
  void say(const std::string& warning) {
    std::string words = warning;
    std::erase_if(words, [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-'; });
    if (words == last_words_) return;
    last_words_ = std::move(words);
    log_.warn("{}", warning);
  }

 private:
  const Logger& log_;
  std::string last_words_;
};

}  // namespace panvo::runtime
