// SPDX-License-Identifier: Apache-2.0
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/component.hpp"
#include "std_msgs/msg/Int16.h"

namespace {

using panvo::runtime::Component;
using panvo::runtime::Context;

/// For each image on image_raw, publishes a new image with its stamp on image_rect and keeps the last one; publishes
/// one at construction.
class RelayComponent final : public Component {
 public:
  struct Parameters {
    std::int64_t copies = 1;
    template <class Field>
    static void describe(Field&& field) {
      field(&Parameters::copies, "copies", "1", "images published for each that comes", 1, 100);
    }
  };

  explicit RelayComponent(Context& context)
      : parameters_(context.parameters<Parameters>()), output_(context.output(panvo::topics::kStereoLeftImageRect)) {
    context.input(panvo::topics::kStereoLeftImageRaw, [this](std::shared_ptr<const sensor_msgs::msg::Image> image) {
      last_ = image;
      for (std::int64_t i = 0; i < parameters_.copies; ++i) {
        output_.publish(sensor_msgs::msg::Image(*image));
      }
    });
  }

 private:
  Parameters parameters_;
  panvo::runtime::Output<sensor_msgs::msg::Image> output_;
  std::shared_ptr<const sensor_msgs::msg::Image> last_;
};

PANVO_REGISTER_COMPONENT(RelayComponent)

/// A second component in the same plugin, whose constructor fails.
class BrokenComponent final : public Component {
 public:
  explicit BrokenComponent(Context&) { throw std::runtime_error("no camera found"); }
};

PANVO_REGISTER_COMPONENT(BrokenComponent)

/// One without parameters.
class BareComponent final : public Component {
 public:
  explicit BareComponent(Context&) {}
};

PANVO_REGISTER_COMPONENT(BareComponent)

/// One that reads messages whose library the test program does not link.
class CountComponent final : public Component {
 public:
  explicit CountComponent(Context& context) {
    context.input(panvo::interfaces::Topic<std_msgs::msg::Int16>{"count"}, [](const auto&) {});
  }
};

PANVO_REGISTER_COMPONENT(CountComponent)

}  // namespace
