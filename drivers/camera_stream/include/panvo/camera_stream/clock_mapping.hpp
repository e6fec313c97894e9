// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace panvo::camera_stream {

/// Maps device stamps to host time, frame by frame.
///
/// The delay from a frame's stamp to its arrival is never negative and often close to its minimum: in a plot of arrival
/// over device time, the true clock follows the lower edge of the points. The earliest arrival of each part of a
/// sliding window is kept. The mapping is the line below all these points with the smallest sum of distances to them:
/// the edge of their lower convex hull at their mean (Moon, Skelly, Towsley: Estimation and removal of clock skew from
/// network delay measurements, INFOCOM 1999). The minimum delay itself (read-out and transport) remains in the result.
class ClockMapping {
 public:
  struct Settings {
    std::int64_t window_ns = 16'000'000'000;    ///< age of the oldest frame used
    int parts = 32;                             ///< parts of the window, one point each; bounds the memory
    std::int64_t rate_from_ns = 3'000'000'000;  ///< smallest time span of the points for a drift estimate
    double max_drift = 500e-6;                  ///< between two intact clocks; the estimate is limited to it
    /// A stamp further than this ahead of the arrival means that the device clock was set or restarted. Smaller
    /// differences are accepted, because some drivers stamp slightly ahead.
    std::int64_t jump_ns = 100'000'000;
  };

  ClockMapping() : ClockMapping(Settings{}) {}
  explicit ClockMapping(const Settings& settings) : settings_(settings) {}

  /// Host time of `device_ns`. Results strictly increase, and do not exceed `arrival_ns` unless this order requires it.
  std::int64_t to_host_ns(std::int64_t device_ns, std::int64_t arrival_ns);

  /// Number of detected steps and restarts of the device clock.
  std::uint64_t resets() const noexcept { return resets_; }
  /// Relative rate of the host clock against the device clock minus 1, dimensionless; 0 until it is known.
  double drift() const noexcept { return drift_; }
  /// Call after the device was reopened: forgets the clock offset, keeps the drift.
  void restart();

 private:
  /// Relative to the first frame since the last restart, so that doubles hold nanoseconds exactly.
  struct Point {
    double device_ns;
    double lag_ns;  // arrival minus device time
  };

  bool was_set(std::int64_t device_ns, std::int64_t arrival_ns) const;
  void add(const Point& point);
  void fit();

  Settings settings_;
  std::optional<std::int64_t> last_device_ns_, last_host_ns_;
  std::int64_t first_device_ns_ = 0, first_lag_ns_ = 0;
  std::deque<Point> points_;  // in order of time, one per part of the window
  double drift_ = 0.0, lag_ns_ = 0.0;
  std::uint64_t resets_ = 0;
};

}  // namespace panvo::camera_stream
