// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <string>

#include "eye_rectifier.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/component.hpp"

namespace panvo::stereo_rectifier {

struct Parameters {
  std::string output = "mono8";  // "same" keeps colour, at about 2.4 times the cost
  template <class Field>
  static void describe(Field&& field) {
    using P = Parameters;
    field(&P::output, "output", "", "encoding of the rectified images: mono8, or same as the raw images",
          {"mono8", "same"});
  }
};

/// stereo/{left,right}/{image_raw,camera_info} -> stereo/{left,right}/image_rect, with the same stamp and frame. Each
/// camera is processed separately; subscribers pair the images by stamp.
class StereoRectifierComponent final : public runtime::Component {
 public:
  explicit StereoRectifierComponent(runtime::Context& context)
      : context_(context),
        output_(context.parameters<Parameters>().output == "same" ? Output::kSame : Output::kMono8),
        left_(context, output_, topics::kStereoLeftImageRaw, topics::kStereoLeftCameraInfo,
              topics::kStereoLeftImageRect),
        right_(context, output_, topics::kStereoRightImageRaw, topics::kStereoRightCameraInfo,
               topics::kStereoRightImageRect) {
    for (Eye* eye : {&left_, &right_}) {
      context.input(eye->info_topic, [this, eye](const std::shared_ptr<const sensor_msgs::msg::CameraInfo>& info) {
        on_info(*eye, *info);
      });
      context.input(eye->raw_topic,
                    [this, eye](const std::shared_ptr<const sensor_msgs::msg::Image>& raw) { on_image(*eye, raw); });
    }
  }

 private:
  struct Eye {
    Eye(runtime::Context& context, Output output, const interfaces::Topic<sensor_msgs::msg::Image>& raw,
        const interfaces::Topic<sensor_msgs::msg::CameraInfo>& info,
        const interfaces::Topic<sensor_msgs::msg::Image>& rect)
        : raw_topic(raw), info_topic(info), rectifier(output), rectified(context.output(rect)) {}

    interfaces::Topic<sensor_msgs::msg::Image> raw_topic;
    interfaces::Topic<sensor_msgs::msg::CameraInfo> info_topic;
    EyeRectifier rectifier;
    runtime::Output<sensor_msgs::msg::Image> rectified;
    int images_without_info = 0;
  };

  void on_info(Eye& eye, const sensor_msgs::msg::CameraInfo& info) {
    const auto use = eye.rectifier.add_info(info);
    if (use == EyeRectifier::Info::kTaken) check_pair();
    if (use != EyeRectifier::Info::kDisputed) return;
    context_.log().warn(
        "{} alternates between two calibrations: two publishers disagree. The one in use stays; stop one of "
        "them, or remap its topic",
        context_.resolved_name(eye.info_topic));
  }

  void check_pair() {
    pair_problem_.clear();
    const auto& left = left_.rectifier.camera();
    const auto& right = right_.rectifier.camera();
    if (left && *left && right && *right) {
      if (const auto stereo = conversions::to_stereo(**left, **right); !stereo) pair_problem_ = stereo.reason();
    }
  }

  void on_image(Eye& eye, const std::shared_ptr<const sensor_msgs::msg::Image>& raw) {
    if (eye.rectifier.add_image(*raw)) {
      context_.log().warn_throttled(
          eye.info_topic.name,
          "{} changed while running; the new calibration is used from now on. Restart if the camera was moved or "
          "replaced",
          context_.resolved_name(eye.info_topic));
      check_pair();
    }
    if (!eye.rectifier.camera()) {
      // Drivers may publish images before the first camera_info.
      constexpr int kPatience = 10;
      if (++eye.images_without_info == kPatience) {
        context_.log().warn(
            "{} images on {}, but nothing on {}: cannot rectify; configure the driver to publish its calibration, or "
            "remap the topic",
            kPatience, context_.resolved_name(eye.raw_topic), context_.resolved_name(eye.info_topic));
      }
      return;
    }
    if (!pair_problem_.empty()) {
      return context_.log().warn_throttled("no stereo pair", "{} and {} do not form a stereo pair: {}",
                                           context_.resolved_name(left_.info_topic),
                                           context_.resolved_name(right_.info_topic), pair_problem_);
    }
    const auto rectified = [&] {
      const runtime::StageTimer timer(context_.times(), "rectify");
      return eye.rectifier.rectify(raw);
    }();
    if (!rectified) {
      return context_.log().warn_throttled(eye.raw_topic.name, "{} {}; image skipped",
                                           context_.resolved_name(eye.raw_topic), rectified.reason());
    }
    eye.rectified.publish(*rectified);
  }

  runtime::Context& context_;
  Output output_;
  Eye left_, right_;
  std::string pair_problem_;
};

PANVO_REGISTER_COMPONENT(StereoRectifierComponent)

}  // namespace panvo::stereo_rectifier
