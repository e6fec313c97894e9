// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "panvo/odometry_fusion/sensor_data.hpp"
#include "panvo/vision/stamp_sequence.hpp"

namespace panvo::odometry_fusion {

/// The last samples of a sensor by stamp, in whatever order they arrive.
template <class Sample>
class SampleWindow {
 public:
  static constexpr std::size_t kMaxSamples = 4000;  ///< four seconds at 1 kHz

  /// `max_gap_s`: longest time between two samples across which the sensor counts as measuring.
  explicit SampleWindow(double max_gap_s) : max_gap_s_(max_gap_s) {}

  /// False for a second sample of a stamp, and for one that forget_before() has passed. Drops the later ones if the
  /// sensor's clock was ahead and was set back.
  bool add(const Sample& sample) {
    if (stamps_.add(sample.stamp_ns) == vision::StampOrder::kSetBack) drop_after(sample.stamp_ns);
    if (sample.stamp_ns < begin_ns_) return false;
    const auto place = std::lower_bound(samples_.begin(), samples_.end(), sample.stamp_ns, is_earlier);
    if (place != samples_.end() && place->stamp_ns == sample.stamp_ns) return false;
    samples_.insert(place, sample);
    if (samples_.size() > kMaxSamples) samples_.pop_front();
    return true;
  }

  std::optional<std::int64_t> latest_ns() const {
    return samples_.empty() ? std::nullopt : std::optional(samples_.back().stamp_ns);
  }

  /// The samples of a time span, with interpolated ones at both ends; empty if the sensor did not measure throughout.
  std::vector<Sample> span(std::int64_t from_ns, std::int64_t to_ns) const {
    auto after = std::upper_bound(samples_.begin(), samples_.end(), from_ns,
                                  [](std::int64_t stamp_ns, const Sample& one) { return stamp_ns < one.stamp_ns; });
    if (after == samples_.begin() || from_ns >= to_ns) return {};
    std::vector<Sample> found;
    for (auto before = after - 1; after != samples_.end(); before = after++) {
      if (seconds(before->stamp_ns, after->stamp_ns) > max_gap_s_) return {};
      if (found.empty()) found.push_back(at(*before, *after, from_ns));
      if (after->stamp_ns >= to_ns) {
        found.push_back(at(*before, *after, to_ns));
        return found;
      }
      found.push_back(*after);
    }
    return {};
  }

  /// Drops what is older than `stamp_ns`, except the sample just before it.
  void forget_before(std::int64_t stamp_ns) {
    while (samples_.size() > 1 && samples_[1].stamp_ns <= stamp_ns) samples_.pop_front();
    begin_ns_ = stamp_ns;
  }

  void clear() {
    samples_.clear();
    stamps_ = {};
    begin_ns_ = INT64_MIN;
  }

 private:
  void drop_after(std::int64_t stamp_ns) {
    while (!samples_.empty() && samples_.back().stamp_ns > stamp_ns) samples_.pop_back();
  }

  static bool is_earlier(const Sample& sample, std::int64_t stamp_ns) { return sample.stamp_ns < stamp_ns; }

  static Sample at(const Sample& before, const Sample& after, std::int64_t stamp_ns) {
    return between(before, after, seconds(before.stamp_ns, stamp_ns) / seconds(before.stamp_ns, after.stamp_ns));
  }

  double max_gap_s_;
  std::int64_t begin_ns_ = INT64_MIN;
  std::deque<Sample> samples_;
  vision::StampSequence stamps_;  // in order of arrival
};

}  // namespace panvo::odometry_fusion
