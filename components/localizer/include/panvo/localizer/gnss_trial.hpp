// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <deque>
#include <optional>
#include <string>

#include "panvo/localizer/gnss_fix.hpp"
#include "panvo/localizer/odometry_buffer.hpp"

namespace panvo::localizer {

/// Compares the path by satellites with that of the odometry: fixes count only once both have the same shape.
class GnssTrial {
 public:
  struct Sample {
    GnssFix fix;
    OdometrySample at;
  };
  struct Result {
    bool agrees = false;
    Eigen::Isometry3d odom_from_enu = Eigen::Isometry3d::Identity();  ///< if it agrees
    std::string reason;                                               ///< why not
  };

  /// Fixes in order of the path. Keeps 64: the last, or, if those do not reach over what result() needs, evenly spaced.
  void add(const Sample& sample, double least_m);
  /// nullopt while the path is too short to tell: shorter than `least_m`, or not ten standard deviations of a fix wide.
  std::optional<Result> result(double least_m) const;
  /// Replaces the odometry of the samples by the corrected one, as far back as that is stored.
  void refresh(const OdometryBuffer& chain);
  const std::deque<Sample>& samples() const noexcept { return samples_; }
  void clear() { samples_.clear(); }

 private:
  double way_m(std::size_t from) const { return samples_.back().at.way_m - samples_[from].at.way_m; }

  static constexpr std::size_t kMaxSamples = 64;

  std::deque<Sample> samples_;
};

}  // namespace panvo::localizer
