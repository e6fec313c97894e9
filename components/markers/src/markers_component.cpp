// SPDX-License-Identifier: Apache-2.0
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/component.hpp"
#include "place_scene.hpp"

namespace panvo::markers {

/// landmarks, landmarks/poses, correction/outcome -> places/markers, on change and if anybody reads them.
class MarkersComponent final : public runtime::Component {
 public:
  explicit MarkersComponent(runtime::Context& context)
      : scene_(context.parameters<SceneParameters>()), markers_(context.output(kPlaceMarkers)) {
    context.input(topics::kLandmarks, [this](const auto& message) { scene_.add(*message); });
    context.input(topics::kLandmarkPoses, [this](const auto& message) { scene_.add(*message); });
    context.input(topics::kCorrectionOutcome, [this](const auto& message) { scene_.add(*message); });
    context.every(std::chrono::seconds(1), [this, &context] {
      if (scene_.has_changed() && context.has_reader(kPlaceMarkers)) markers_.publish(scene_.markers());
    });
  }

 private:
  PlaceScene scene_;
  runtime::Output<visualization_msgs::msg::MarkerArray> markers_;
};

PANVO_REGISTER_COMPONENT(MarkersComponent)

}  // namespace panvo::markers
