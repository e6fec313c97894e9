// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/map_listener.hpp"

#include <utility>

#include "panvo/interfaces/topics.hpp"
#include "panvo/landmarks/landmark_messages.hpp"

namespace panvo::landmarks {

MapListener::MapListener(runtime::Context& context, Handler on_moved) {
  context.input(topics::kLandmarkPoses, [this, &context, on_moved = std::move(on_moved)](const auto& message) {
    const auto poses = to_landmark_poses(*message);
    if (poses) return on_moved(map_.move(*poses));
    context.log().warn_throttled(poses.reason(), "{} {}; landmark poses are unchanged",
                                 context.resolved_name(topics::kLandmarkPoses), poses.reason());
  });
}

}  // namespace panvo::landmarks
