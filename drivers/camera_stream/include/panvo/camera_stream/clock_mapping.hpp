// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace panvo::camera_stream {

/// The clock of a device told in host time, frame by frame.
///
/// A frame arrives later than it was stamped by a delay that is never negative and often near its least value: in a plot of arrival over device
/// time the true clock lies along the lower edge of the points. Of each part of a sliding window the earliest arrival is kept, and the line below
/// all of these that is nearest to them in sum is the mapping (the edge of their lower convex hull above their mean; Moon, Skelly, Towsley:
/// Estimation and removal of clock skew from network delay measurements, INFOCOM 1999). What is left is the least delay itself: read-out and transport.
class ClockMapping {
 public:
  struct Settings {
    std::int64_t window_ns = 16'000'000'000;    ///< how far back frames count
    int parts = 32;                             ///< of the window, each with one point: bounds the memory
    std::int64_t rate_from_ns = 3'000'000'000;  ///< what the points must span before the clocks' rates are told apart
    double largest_drift = 500e-6;              ///< between two clocks in order; more is taken for a clock that was set
    /// A frame cannot arrive before it was taken. By more than this: the device's clock was set or began anew. Less is taken as it is: some drivers
    /// stamp a little ahead.
    std::int64_t jump_ns = 100'000'000;
  };

  ClockMapping() : ClockMapping(Settings{}) {}
  explicit ClockMapping(const Settings& settings) : settings_(settings) {}

  /// Host time of `device_ns`, never later than `arrival_ns` unless the mapping's own order requires it: results strictly increase.
  std::int64_t to_host_ns(std::int64_t device_ns, std::int64_t arrival_ns);

  /// How often the device's clock was found to have been set or to have begun anew.
  std::uint64_t resets() const noexcept { return resets_; }
  /// How much faster the host's clock runs than the device's, 1; 0 until it is known.
  double drift() const noexcept { return drift_; }
  /// The device was opened anew: its clock may be another one. What is known of its rate stays.
  void restart();

 private:
  /// Relative to the first frame since the clock began, so that doubles hold nanoseconds exactly.
  struct Point {
    double device_ns;
    double lag_ns;  // arrival less device time
  };

  bool was_set(std::int64_t device_ns, std::int64_t arrival_ns) const;
  void add(const Point& point);
  void fit();

  Settings settings_;
  std::optional<std::int64_t> last_device_ns_, last_host_ns_;
  std::int64_t first_device_ns_ = 0, first_lag_ns_ = 0;
  std::deque<Point> points_;  // in order of time, one of each part of the window
  double drift_ = 0.0, lag_ns_ = 0.0;
  std::uint64_t resets_ = 0;
};

}  // namespace panvo::camera_stream
