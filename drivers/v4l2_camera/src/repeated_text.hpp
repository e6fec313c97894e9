// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace panvo::v4l2_camera {

/// What is to be said when it begins, and again only after a while without it. Times are of any clock that does not go back, ns.
class RepeatedText {
 public:
  bool is_new(const std::string& text, std::int64_t now_ns) {
    last_ns_ = now_ns;
    if (text == last_) return false;
    last_ = text;
    return true;
  }

  /// All is well now.
  void quiet(std::int64_t now_ns) {
    constexpr std::int64_t kWhile_ns = 10'000'000'000;
    if (now_ns - last_ns_ > kWhile_ns) last_.clear();
  }

  const std::string& last() const noexcept { return last_; }

 private:
  std::string last_;
  std::int64_t last_ns_ = 0;
};

}  // namespace panvo::v4l2_camera
