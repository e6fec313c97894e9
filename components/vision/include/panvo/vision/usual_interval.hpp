// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <vector>

namespace panvo::vision {

/// Usual interval between the messages of a topic: the median of the last ones. A mean would follow a gap of an hour,
/// and take the next minutes of silence for usual.
class UsualInterval {
 public:
  /// One that is not positive, of a clock that was set back, does not count.
  void add(double interval_s) {
    if (!(interval_s > 0.0)) return;
    intervals_s_.push_back(interval_s);
    if (intervals_s_.size() > kIntervals) intervals_s_.pop_front();
  }

  /// The lower one of an even count; 0 before the first.
  double median_s() const {
    if (intervals_s_.empty()) return 0.0;
    std::vector<double> sorted_s(intervals_s_.begin(), intervals_s_.end());
    const auto median = sorted_s.begin() + static_cast<std::ptrdiff_t>((sorted_s.size() - 1) / 2);
    std::nth_element(sorted_s.begin(), median, sorted_s.end());
    return *median;
  }

 private:
  static constexpr std::size_t kIntervals = 21;  // less than half of them may be gaps

  std::deque<double> intervals_s_;
};

}  // namespace panvo::vision
