// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <optional>
#include <thread>

#include "camera_group.hpp"
#include "mounting.hpp"
#include "panvo/runtime/component.hpp"
#include "parameters.hpp"

namespace panvo::v4l2_camera {

/// USB cameras and whatever else V4L2 has -> image_raw, camera_info of each, under one stamp; /tf_static; diagnostics.
class V4l2CameraComponent final : public runtime::Component {
 public:
  explicit V4l2CameraComponent(runtime::Context& context)
      : context_(context),
        begin_(context.stage<Begin>("begin", 1, [this](const Begin& begin) { on_begin(begin); })),
        static_transforms_(context.output(topics::kTfStatic)) {
    const auto parameters = context.parameters<Parameters>();
    auto group = group_of(parameters);
    mounting_ = mounting(parameters.mount, group.images, system_ns());
    group_.emplace(context, std::move(group));
    context.on_parameters<Parameters>(
        [this, parameters](const Parameters& wanted) { on_parameters(parameters, wanted); });
    // Cameras are opened when the container starts, not while components are looked at or still to be loaded.
    begin_.push({std::this_thread::get_id()});
  }

 private:
  struct Begin {
    std::thread::id made_by;
  };

  void on_begin(const Begin& begin) {
    // A replay has one thread for all and time of its own: cameras have no place in it.
    if (begin.made_by == std::this_thread::get_id()) {
      context_.log().error("cameras cannot be replayed; run without --replay");
      return;
    }
    if (!mounting_.transforms().empty()) static_transforms_.publish(mounting_);
    group_->start();
  }

  void on_parameters(Parameters made_with, const Parameters& wanted) {
    made_with.controls = wanted.controls;
    if (wanted != made_with)
      throw runtime::ConfigError("of v4l2_camera only controls can be set while it runs; load it anew for the rest");
    std::vector<std::vector<ControlSetting>> controls;
    for (const auto& device : group_of(wanted).devices) controls.push_back(device.controls);
    group_->set_controls(std::move(controls));
  }

  static std::int64_t system_ns() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
        .count();
  }

  runtime::Context& context_;
  runtime::Stage<Begin> begin_;
  runtime::Output<tf2_msgs::msg::TFMessage> static_transforms_;
  tf2_msgs::msg::TFMessage mounting_;
  std::optional<CameraGroup> group_;
};

PANVO_REGISTER_COMPONENT(V4l2CameraComponent)

}  // namespace panvo::v4l2_camera
