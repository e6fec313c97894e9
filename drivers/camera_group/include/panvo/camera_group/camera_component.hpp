// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "panvo/camera_group/camera_group.hpp"
#include "panvo/camera_group/mounting.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/component.hpp"

namespace panvo::camera_group {

/// The cameras selected by a driver's parameters. `Device`: the settings from which its grabber is made.
template <class Device>
struct CameraSet {
  std::vector<Device> devices;
  std::vector<GroupImage> images;  ///< as in CameraGroup::Description
  std::int64_t tolerance_ns = 0;
};

/// Camera driver component. Publishes image_raw and camera_info of each camera with one stamp, /tf_static and
/// diagnostics. The driver supplies:
///
///     struct Driver {
///       static constexpr auto kName = "v4l2_camera";              // for messages
///       using Parameters = ...;                                   // of the component; has `mount`
///       using Grabber = ...;                                      // constructor: device, logger, Grabber::OnFrame
///       static constexpr auto kSettable = &Parameters::controls;  // the parameter that can change while streaming
///       static constexpr auto kSettableName = "controls";
///       static CameraSet<Device> cameras_of(const Parameters&);   // throws runtime::ConfigError
///       static const std::vector<DeviceSetting>& settings_of(const Device&);
///     };
template <class Driver>
class CameraComponent : public runtime::Component {
 public:
  using Parameters = typename Driver::Parameters;

  explicit CameraComponent(runtime::Context& context)
      : context_(context),
        begin_(context.stage<Begin>("begin", 1, [this](const Begin& begin) { on_begin(begin); })),
        static_transforms_(context.output(topics::kTfStatic)) {
    const auto parameters = context.parameters<Parameters>();
    auto cameras = Driver::cameras_of(parameters);
    try {
      mounting_ = mounting(parameters.mount, cameras.images, system_ns());
    } catch (const std::invalid_argument& error) {
      throw runtime::ConfigError(error.what());
    }
    CameraGroup::Description group{{}, std::move(cameras.images), cameras.tolerance_ns};
    for (auto& device : cameras.devices) {
      group.devices.push_back([&context, device = std::move(device)](Grabber::OnFrame on_frame) {
        return std::make_unique<typename Driver::Grabber>(device, context.log(), std::move(on_frame));
      });
    }
    group_.emplace(context, std::move(group));
    context.on_parameters<Parameters>(
        [this, parameters](const Parameters& wanted) { on_parameters(parameters, wanted); });
    // Opens the cameras when the container starts, not while components are being listed or loaded.
    begin_.push({std::this_thread::get_id()});
  }

 private:
  struct Begin {
    std::thread::id made_by;
  };

  void on_begin(const Begin& begin) {
    // A replay runs all stages on one thread and in recorded time: cameras cannot take part.
    if (begin.made_by == std::this_thread::get_id()) {
      context_.log().error("cameras cannot be replayed; run without --replay");
      return;
    }
    if (!mounting_.transforms().empty()) static_transforms_.publish(mounting_);
    group_->start();
  }

  void on_parameters(Parameters made_with, const Parameters& wanted) {
    made_with.*Driver::kSettable = wanted.*Driver::kSettable;
    if (wanted != made_with) {
      throw runtime::ConfigError(std::string("in ") + Driver::kName + " only " + Driver::kSettableName +
                                 " can change while it runs; reload the component to change other parameters");
    }
    std::vector<std::vector<DeviceSetting>> settings;
    for (const auto& device : Driver::cameras_of(wanted).devices) settings.push_back(Driver::settings_of(device));
    group_->set(std::move(settings));
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

}  // namespace panvo::camera_group
