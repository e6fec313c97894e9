// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>

#include "nav_msgs/msg/Odometry.h"
#include "panvo_msgs/msg/OdometryQuality.h"

namespace panvo::localizer {

/// Brings each odometry message together with its quality, the message of the same stamp, in whatever order the two topics arrive. Odometry comes
/// out in the order in which it came in, and waits for its quality a bounded time.
class OdometryJoin {
 public:
  struct Joined {
    std::shared_ptr<const nav_msgs::msg::Odometry> odometry;
    bool is_reliable = true;
    double outlier_share = 1.0;  ///< of its points; 1 where nobody says
    bool lacks_quality = false;  ///< there is somebody who tells it, but not of this message
  };

  void add(const panvo_msgs::msg::OdometryQuality& quality);
  void add(std::shared_ptr<const nav_msgs::msg::Odometry> odometry, std::int64_t now_ns);

  /// The next odometry that need not wait (any more). `is_told`: somebody publishes the quality.
  std::optional<Joined> next(std::int64_t now_ns, bool is_told);

  /// Whether a quality has come.
  bool has_quality() const noexcept { return has_quality_; }

 private:
  struct Quality {
    bool is_reliable;
    double outlier_share;
  };
  struct Waiting {
    std::shared_ptr<const nav_msgs::msg::Odometry> odometry;
    std::int64_t since_ns;
  };

  std::map<std::int64_t, Quality> qualities_;  // by stamp; those whose odometry has yet to come
  std::deque<Waiting> waiting_;
  bool has_quality_ = false;
  int lacking_ = 0;  // odometry in a row that waited for nothing
};

}  // namespace panvo::localizer
