// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_stream/clock_mapping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace panvo::camera_stream {

std::int64_t ClockMapping::to_host_ns(std::int64_t device_ns, std::int64_t arrival_ns) {
  if (last_device_ns_ && was_set(device_ns, arrival_ns)) {
    ++resets_;
    restart();
  }
  if (!last_device_ns_) {
    first_device_ns_ = device_ns;
    first_lag_ns_ = arrival_ns - device_ns;
  }
  last_device_ns_ = device_ns;
  const auto since_first_ns = static_cast<double>(device_ns - first_device_ns_);
  add({since_first_ns, static_cast<double>(arrival_ns - device_ns - first_lag_ns_)});
  fit();
  std::int64_t host_ns = device_ns + first_lag_ns_ + std::llround(lag_ns_ + drift_ * since_first_ns);
  if (last_host_ns_) host_ns = std::max(host_ns, *last_host_ns_ + 1);
  last_host_ns_ = host_ns;
  return host_ns;
}

void ClockMapping::restart() {
  last_device_ns_.reset();
  points_.clear();
}

bool ClockMapping::was_set(std::int64_t device_ns, std::int64_t arrival_ns) const {
  if (device_ns < *last_device_ns_) return true;
  const auto since_first_ns = static_cast<double>(device_ns - first_device_ns_);
  const double early_ns =
      lag_ns_ + drift_ * since_first_ns - static_cast<double>(arrival_ns - device_ns - first_lag_ns_);
  const double drifted_ns = settings_.max_drift * static_cast<double>(device_ns - *last_device_ns_);
  return early_ns > static_cast<double>(settings_.jump_ns) + drifted_ns;
}

void ClockMapping::add(const Point& point) {
  const double part_ns = static_cast<double>(settings_.window_ns) / settings_.parts;
  const auto part_of = [&](const Point& of) { return std::floor(of.device_ns / part_ns); };
  while (!points_.empty() && point.device_ns - points_.front().device_ns > static_cast<double>(settings_.window_ns))
    points_.pop_front();
  if (points_.empty() || part_of(points_.back()) != part_of(point)) {
    points_.push_back(point);
    return;
  }
  const auto above_line = [&](const Point& of) { return of.lag_ns - drift_ * of.device_ns; };
  if (above_line(point) < above_line(points_.back())) points_.back() = point;
}

void ClockMapping::fit() {
  const double span_ns = points_.back().device_ns - points_.front().device_ns;
  if (span_ns >= static_cast<double>(settings_.rate_from_ns)) {
    std::vector<Point> hull;
    double mean_ns = 0.0;
    for (const auto& point : points_) {
      mean_ns += point.device_ns / static_cast<double>(points_.size());
      const auto is_above = [&](const Point& a, const Point& middle) {
        return (middle.lag_ns - a.lag_ns) * (point.device_ns - a.device_ns) >=
               (point.lag_ns - a.lag_ns) * (middle.device_ns - a.device_ns);
      };
      while (hull.size() >= 2 && is_above(hull[hull.size() - 2], hull.back())) hull.pop_back();
      hull.push_back(point);
    }
    const auto right =
        std::find_if(hull.begin() + 1, hull.end() - 1, [&](const Point& point) { return point.device_ns >= mean_ns; });
    const double slope = (right->lag_ns - (right - 1)->lag_ns) / (right->device_ns - (right - 1)->device_ns);
    drift_ = std::clamp(slope, -settings_.max_drift, settings_.max_drift);
  }
  lag_ns_ = std::numeric_limits<double>::infinity();
  for (const auto& point : points_) lag_ns_ = std::min(lag_ns_, point.lag_ns - drift_ * point.device_ns);
}

}  // namespace panvo::camera_stream
