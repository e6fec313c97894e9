// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

#include "fault.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/component.hpp"

namespace panvo::test {

using interfaces::Topic;
using sensor_msgs::msg::Image;
using ImagePtr = std::shared_ptr<const Image>;

struct InjectorParameters {
  std::string kind = "none";
  int seed = 1;
  double span_s = 0.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = InjectorParameters;
    field(&P::kind, "kind", "", "kind of fault");
    field(&P::seed, "seed", "1", "random seed of time and details of the fault", 0, 1'000'000'000);
    field(&P::span_s, "span_s", "s", "duration of the recording", 0.0, 1e6);
  }
};

/// Runs between a recording and the system, and between components: forwards each stream from clean/... to its usual
/// name, disturbed by the fault of this kind and seed.
class FaultInjectorComponent final : public runtime::Component {
 public:
  explicit FaultInjectorComponent(runtime::Context& context)
      : context_(context),
        left_(context.output(topics::kStereoLeftImageRaw)),
        right_(context.output(topics::kStereoRightImageRaw)),
        panoramas_(context.output(topics::kPanorama)) {
    const auto parameters = context.parameters<InjectorParameters>();
    const auto seed = static_cast<std::uint64_t>(parameters.seed);
    try {
      const FaultKind& kind = fault_kind(parameters.kind);
      window_ = fault_window(kind, seed, parameters.span_s);
      fault_ = make_fault(kind, seed, parameters.span_s);
    } catch (const std::invalid_argument& error) {
      throw runtime::ConfigError(error.what());
    }
    pass_sensors();
    pass_results();
  }

 private:
  template <class Message>
  static Topic<Message> clean(const char* name, const Topic<Message>& topic) {
    return {name, topic.qos};
  }

  void pass_sensors() {
    context_.input_pair(clean("clean/left", topics::kStereoLeftImageRaw),
                        clean("clean/right", topics::kStereoRightImageRaw),
                        [this](const ImagePtr& left, const ImagePtr& right) { on_pair(left, right); });
    context_.input(clean("clean/panorama", topics::kPanorama), [this](const ImagePtr& image) { on_panorama(image); });
    pass("clean/left_info", topics::kStereoLeftCameraInfo, fault_.left_infos, true);
    pass("clean/right_info", topics::kStereoRightCameraInfo, fault_.right_infos, true);
    pass("clean/truth", topics::kGroundTruth, fault_.truth, true);
    pass("clean/tf_static", topics::kTfStatic, fault_.static_transforms, false);
  }

  void pass_results() {
    pass("clean/odometry", topics::kOdometryBinocular, fault_.odometry, false);
    pass("clean/quality", topics::kOdometryQuality, fault_.qualities, false);
    pass("clean/azimuth", topics::kAzimuthChange, fault_.azimuths, false);
    pass("clean/places", topics::kLandmarks, fault_.landmarks, false);
    pass("clean/sightings", topics::kCorrection, fault_.corrections, false);
  }

  /// Messages from the recording (`tells_time`) advance the injector's clock. Messages from the system pass at that
  /// time, whatever their stamps.
  template <class Message>
  void pass(const char* name, const Topic<Message>& topic, const Passage<Message>& passage, bool tells_time) {
    const auto output = std::make_shared<runtime::Output<Message>>(context_.output(topic));
    context_.input(clean(name, topic),
                   [this, output, &passage, tells_time](const std::shared_ptr<const Message>& message) {
                     if constexpr (requires { message->header(); }) {
                       if (tells_time) see_time(conversions::stamp_ns(*message));
                     }
                     if (!passage) return output->publish(message);
                     for (auto& passed : passage(*message, moment())) output->publish(std::move(passed));
                   });
  }

  void on_pair(const ImagePtr& left, const ImagePtr& right) {
    see_time(conversions::stamp_ns(*left));
    if (!fault_.pairs) {
      left_.publish(left);
      right_.publish(right);
      return;
    }
    const auto left_pixels = conversions::view(*left), right_pixels = conversions::view(*right);
    if (!left_pixels || !right_pixels) return;
    const StereoPair pair{conversions::stamp_ns(*left), conversions::stamp_ns(*right), *left_pixels, *right_pixels};
    for (const auto& passed : fault_.pairs(keep(pair), moment())) {
      publish(left_, passed.left, passed.left_ns, *left);
      publish(right_, passed.right, passed.right_ns, *right);
    }
  }

  void on_panorama(const ImagePtr& image) {
    see_time(conversions::stamp_ns(*image));
    if (!fault_.panoramas) return panoramas_.publish(image);
    const auto pixels = conversions::view(*image);
    if (!pixels) return;
    const Panorama panorama{conversions::stamp_ns(*image), pixels->clone()};
    for (const auto& passed : fault_.panoramas(panorama, moment())) {
      publish(panoramas_, passed.pixels, passed.stamp_ns, *image);
    }
  }

  /// Copies the images, because a fault may keep them longer than the message lives.
  static StereoPair keep(const StereoPair& pair) {
    return {pair.left_ns, pair.right_ns, pair.left.clone(), pair.right.clone()};
  }

  /// Publishes with frame and encoding of `like`; nothing if the image is empty, that is lost.
  static void publish(runtime::Output<Image>& output, const cv::Mat& pixels, std::int64_t stamp_ns, const Image& like) {
    if (pixels.empty()) return;
    const auto image =
        conversions::make_image(stamp_ns, like.header().frame_id(), like.encoding(), pixels.cols, pixels.rows);
    pixels.copyTo(conversions::pixels(*image));
    output.publish(image);
  }

  void see_time(std::int64_t stamp_ns) {
    if (begin_ns_ < 0) begin_ns_ = stamp_ns;
    now_ns_ = std::max(now_ns_, stamp_ns);
  }

  Moment moment() const {
    const double t_s = static_cast<double>(std::max<std::int64_t>(0, now_ns_ - begin_ns_)) * 1e-9;
    return {t_s, window_.contains(t_s)};
  }

  runtime::Context& context_;
  runtime::Output<Image> left_, right_, panoramas_;
  FaultWindow window_;
  Fault fault_;
  std::int64_t begin_ns_ = -1, now_ns_ = -1;
};

PANVO_REGISTER_COMPONENT(FaultInjectorComponent)

}  // namespace panvo::test
