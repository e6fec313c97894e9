// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include "panvo/compressed_images/decode.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/component.hpp"
#include "topic_names.hpp"

namespace panvo::compressed_images {
namespace {

using sensor_msgs::msg::CompressedImage;
using sensor_msgs::msg::Image;

struct DecoderTopics {
  std::vector<std::string> topics{std::string(topics::kStereoLeftImageRaw.name),
                                  std::string(topics::kStereoRightImageRaw.name), std::string(topics::kPanorama.name)};
  template <class Field>
  static void describe(Field&& field) {
    field(&DecoderTopics::topics, "topics", "", "topics to decode: TOPIC/compressed is published as TOPIC/decoded");
  }
};

struct DecoderParameters {
  std::string output = "same";
  template <class Field>
  static void describe(Field&& field) {
    field(&DecoderParameters::output, "output", "", "encoding of the decoded images: channels as in the file, or grey",
          {"same", "mono8"});
  }
};

/// TOPIC/compressed, as published by ROS 2's image_transport, -> TOPIC/decoded. Does not publish on TOPIC itself, since
/// drivers often do and readers would receive each image twice.
class ImageDecoderComponent final : public runtime::Component {
 public:
  explicit ImageDecoderComponent(runtime::Context& context)
      : context_(context), parameters_(context.parameters<DecoderParameters>()) {
    context.on_parameters<DecoderParameters>([this](const DecoderParameters& wanted) { parameters_ = wanted; });
    for (const std::string& topic : separate_names(context.parameters<DecoderTopics>().topics)) {
      const std::string compressed = topic + "/compressed", decoded = topic + "/decoded";
      context.input(
          interfaces::Topic<CompressedImage>{compressed, interfaces::qos::kSensorData},
          [this, compressed, images = context.output(interfaces::Topic<Image>{decoded, interfaces::qos::kSensorData})](
              const std::shared_ptr<const CompressedImage>& message) mutable {
            const auto image = timed_decode(*message);
            if (image) {
              images.publish(*image);
            } else if (context_.rejections().add(compressed, image.reason())) {
              context_.log().warn("{} {}; image discarded", compressed, image.reason());
            }
          });
    }
  }

 private:
  conversions::Result<std::shared_ptr<const Image>> timed_decode(const CompressedImage& message) {
    const runtime::StageTimer timer(context_.times(), "decode");
    return decode(message, parameters_.output == "mono8" ? Output::kMono8 : Output::kSame);
  }

  runtime::Context& context_;
  DecoderParameters parameters_;
};

}  // namespace
}  // namespace panvo::compressed_images

namespace {
using panvo::compressed_images::ImageDecoderComponent;
}
PANVO_REGISTER_COMPONENT(ImageDecoderComponent)
