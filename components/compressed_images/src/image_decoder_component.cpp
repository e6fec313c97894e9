// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include "decode.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/component.hpp"
#include "topic_names.hpp"

namespace panvo::compressed_images {
namespace {

using sensor_msgs::msg::CompressedImage;
using sensor_msgs::msg::Image;

struct DecoderParameters {
  std::vector<std::string> topics{std::string(topics::kStereoLeftImageRaw.name),
                                  std::string(topics::kStereoRightImageRaw.name), std::string(topics::kPanorama.name)};
  std::string output = "same";
  template <class Field>
  static void describe(Field&& field) {
    using P = DecoderParameters;
    field(&P::topics, "topics", "", "images TOPIC that come as TOPIC/compressed; what is decoded is TOPIC/decoded");
    field(&P::output, "output", "", "encoding of the decoded images: as many channels as the file has, or grey",
          {"same", "mono8"});
  }
};

/// TOPIC/compressed, as ROS 2's image_transport publishes it -> TOPIC/decoded. TOPIC itself stays free: drivers offer it
/// beside the compressed one, and who reads it would get every image twice.
class ImageDecoderComponent final : public runtime::Component {
 public:
  explicit ImageDecoderComponent(runtime::Context& context)
      : context_(context), parameters_(context.parameters<DecoderParameters>()) {
    const Output output = parameters_.output == "mono8" ? Output::kMono8 : Output::kSame;
    for (const std::string& topic : separate_names(parameters_.topics)) {
      const std::string compressed = topic + "/compressed", decoded = topic + "/decoded";
      context.input(interfaces::Topic<CompressedImage>{compressed, interfaces::qos::kSensorData},
                    [this, compressed, output,
                     images = context.output(interfaces::Topic<Image>{decoded, interfaces::qos::kSensorData})](
                        const std::shared_ptr<const CompressedImage>& message) mutable {
                      const auto image = timed_decode(*message, output);
                      if (image) {
                        context_.rejections().accepted(compressed);
                        images.publish(*image);
                      } else if (context_.rejections().add(compressed, image.reason())) {
                        context_.log().warn("{} {}; it is left out", compressed, image.reason());
                      }
                    });
    }
  }

 private:
  conversions::Result<std::shared_ptr<const Image>> timed_decode(const CompressedImage& message, Output output) {
    const runtime::StageTimer timer(context_.times(), "decode");
    return decode(message, output);
  }

  runtime::Context& context_;
  const DecoderParameters parameters_;
};

}  // namespace
}  // namespace panvo::compressed_images

namespace {
using panvo::compressed_images::ImageDecoderComponent;
}
PANVO_REGISTER_COMPONENT(ImageDecoderComponent)
