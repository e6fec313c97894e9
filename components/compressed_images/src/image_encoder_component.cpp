// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include "panvo/compressed_images/encode.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/component.hpp"
#include "topic_names.hpp"

namespace panvo::compressed_images {
namespace {

using sensor_msgs::msg::CompressedImage;
using sensor_msgs::msg::Image;

struct EncoderTopics {
  std::vector<std::string> topics{std::string(topics::kStereoLeftImageRaw.name),
                                  std::string(topics::kStereoRightImageRaw.name), std::string(topics::kPanorama.name)};
  template <class Field>
  static void describe(Field&& field) {
    field(&EncoderTopics::topics, "topics", "", "topics to compress: TOPIC is published as TOPIC/compressed");
  }
};

struct EncoderParameters {
  std::string format = "jpeg";
  int jpeg_quality = Encoding().jpeg_quality;
  int png_level = Encoding().png_level;
  template <class Field>
  static void describe(Field&& field) {
    using P = EncoderParameters;
    field(&P::format, "format", "", "format of the compressed images: jpeg is smaller, png is lossless",
          {"jpeg", "png"});
    field(&P::jpeg_quality, "jpeg_quality", "", "quality of jpeg; full colour resolution from 90", 1, 100);
    field(&P::png_level, "png_level", "", "compression level of png: higher is smaller and slower", 0, 9);
  }
  Encoding encoding() const {
    return {format == "jpeg" ? Encoding::Kind::kJpeg : Encoding::Kind::kPng, jpeg_quality, png_level};
  }
};

/// TOPIC -> TOPIC/compressed, as published by ROS 2's image_transport, for bags and slow networks.
class ImageEncoderComponent final : public runtime::Component {
 public:
  explicit ImageEncoderComponent(runtime::Context& context)
      : context_(context), parameters_(context.parameters<EncoderParameters>()) {
    context.on_parameters<EncoderParameters>([this](const EncoderParameters& wanted) { parameters_ = wanted; });
    for (const std::string& topic : separate_names(context.parameters<EncoderTopics>().topics)) {
      const std::string compressed = topic + "/compressed";
      context.input(
          interfaces::Topic<Image>{topic, interfaces::qos::kSensorData},
          [this, topic,
           files = context.output(interfaces::Topic<CompressedImage>{compressed, interfaces::qos::kSensorData})](
              const std::shared_ptr<const Image>& image) mutable {
            const auto file = timed_encode(*image);
            if (file) {
              files.publish(*file);
            } else if (context_.rejections().add(topic, file.reason())) {
              context_.log().warn("{} {}; image discarded", topic, file.reason());
            }
          });
    }
  }

 private:
  conversions::Result<std::shared_ptr<const CompressedImage>> timed_encode(const Image& image) {
    const runtime::StageTimer timer(context_.times(), "encode");
    return encode(image, parameters_.encoding());
  }

  runtime::Context& context_;
  EncoderParameters parameters_;
};

}  // namespace
}  // namespace panvo::compressed_images

namespace {
using panvo::compressed_images::ImageEncoderComponent;
}
PANVO_REGISTER_COMPONENT(ImageEncoderComponent)
