// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_group/camera_component.hpp"
#include "panvo/v4l2_camera/camera_grabber.hpp"
#include "parameters.hpp"

namespace panvo::v4l2_camera {

struct V4l2Driver {
  using Parameters = v4l2_camera::Parameters;
  using Grabber = CameraGrabber;
  static constexpr auto kName = "v4l2_camera";
  static constexpr auto kSettable = &Parameters::controls;
  static constexpr auto kSettableName = "controls";
  static auto cameras_of(const Parameters& parameters) { return v4l2_camera::cameras_of(parameters); }
  static const auto& settings_of(const CameraSettings& settings) { return settings.controls; }
};

/// USB and other V4L2 cameras.
class V4l2CameraComponent final : public camera_group::CameraComponent<V4l2Driver> {
 public:
  using CameraComponent::CameraComponent;
};

PANVO_REGISTER_COMPONENT(V4l2CameraComponent)

}  // namespace panvo::v4l2_camera
