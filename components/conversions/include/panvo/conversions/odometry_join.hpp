// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>

#include "nav_msgs/msg/Odometry.h"
#include "panvo_msgs/msg/OdometryQuality.h"

namespace panvo::conversions {

/// Joins each odometry message with the quality message of the same stamp, whatever the order of arrival. Odometry is
/// returned in its order of arrival and waits a bounded time for its quality.
class OdometryJoin {
 public:
  struct Quality {
    bool is_reliable = true;
    double outlier_share = 1.0;         ///< fraction of outliers; 1 if unknown
    double lean_sigma_rad_per_m = 0.0;  ///< 0 if unknown
  };
  struct Joined {
    std::shared_ptr<const nav_msgs::msg::Odometry> odometry;
    Quality quality;
    bool lacks_quality = false;  ///< quality is published, but not for this message
  };

  void add(const panvo_msgs::msg::OdometryQuality& quality);
  void add(std::shared_ptr<const nav_msgs::msg::Odometry> odometry, std::int64_t now_ns);

  /// The next odometry message that need not wait any longer. `is_quality_published`: it has a publisher.
  std::optional<Joined> next(std::int64_t now_ns, bool is_quality_published);

  /// Whether any quality has been received.
  bool has_quality() const noexcept { return has_quality_; }

 private:
  struct Waiting {
    std::shared_ptr<const nav_msgs::msg::Odometry> odometry;
    std::int64_t since_ns;
  };

  std::map<std::int64_t, Quality> qualities_;  // by stamp; waiting for their odometry
  std::deque<Waiting> waiting_;
  bool has_quality_ = false;
  int lacking_ = 0;  // consecutive odometry messages whose quality never came
};

}  // namespace panvo::conversions
