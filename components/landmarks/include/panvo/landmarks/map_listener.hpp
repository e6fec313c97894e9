// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "panvo/landmarks/map_replica.hpp"
#include "panvo/runtime/context.hpp"

namespace panvo::landmarks {

/// Subscribes a component to landmarks/poses and keeps a replica of the map with it; the component adds the landmarks that
/// it can use. Create it in the component's constructor; it calls on the component's message thread.
class MapListener {
 public:
  /// The poses that are new to the replica.
  using Handler = std::function<void(const std::vector<LandmarkPose>& moved)>;

  explicit MapListener(
      runtime::Context& context, Handler on_moved = [](const auto&) {});
  MapListener(const MapListener&) = delete;
  MapListener& operator=(const MapListener&) = delete;

  MapReplica& map() noexcept { return map_; }

 private:
  MapReplica map_;
};

}  // namespace panvo::landmarks
