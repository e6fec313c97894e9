// SPDX-License-Identifier: Apache-2.0
#include "panvo/aravis_camera/camera_grabber.hpp"
#include "panvo/aravis_camera/device_list.hpp"
#include "panvo/camera_group/camera_component.hpp"
#include "parameters.hpp"

namespace panvo::aravis_camera {

struct AravisDriver {
  using Parameters = aravis_camera::Parameters;
  using Grabber = CameraGrabber;
  static constexpr auto kName = "aravis_camera";
  static constexpr auto kSettable = &Parameters::features;
  static constexpr auto kSettableName = "features";
  static auto cameras_of(const Parameters& parameters) {
    if (parameters.simulated) enable_simulated_camera();
    return aravis_camera::cameras_of(parameters);
  }
  static const auto& settings_of(const GrabberSettings& settings) { return settings.camera.features; }
};

/// GigE Vision and USB3 Vision cameras.
class AravisCameraComponent final : public camera_group::CameraComponent<AravisDriver> {
 public:
  using CameraComponent::CameraComponent;
};

PANVO_REGISTER_COMPONENT(AravisCameraComponent)

}  // namespace panvo::aravis_camera
