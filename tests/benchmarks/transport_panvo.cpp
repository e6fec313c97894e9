// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <map>
#include <string>
#include <utility>

#include "nav_msgs/msg/Odometry.h"
#include "panvo/interfaces/topic.hpp"
#include "panvo/runtime/container.hpp"
#include "sensor_msgs/msg/Image.h"
#include "transport.hpp"
#include "transport_image.hpp"

namespace panvo::bench {
namespace {

using namespace panvo::runtime;

constexpr interfaces::Topic<nav_msgs::msg::Odometry> kOdometry{"/bench/odometry",
                                                               {.depth = static_cast<std::size_t>(kOdometryDepth)}};
constexpr interfaces::Topic<sensor_msgs::msg::Image> kImage{"/bench/image", interfaces::qos::kSensorData};

std::int64_t to_ns(const builtin_interfaces::msg::Time& time) {
  return std::int64_t{time.sec()} * 1'000'000'000 + time.nanosec();
}

template <class Type>
class PanvoTransport final : public Transport {
 public:
  PanvoTransport(const interfaces::Topic<Type>& topic, const DdsSettings& dds, Type message)
      : topic_(topic),
        container_({.dds = dds, .name = "bench_" + std::to_string(getpid())}),
        message_(std::make_shared<Type>(std::move(message))) {
    container_.start();
  }

  void open_reader(Arrived arrived) override {
    add("reader", [&](Context& context) {
      context.input(topic_, [arrived = std::move(arrived)](const std::shared_ptr<const Type>& message) {
        arrived(to_ns(message->header().stamp()));
      });
    });
    has_reader_ = true;
  }

  void open_writer() override {
    add("writer", [this](Context& context) {
      const auto& type = interfaces::message_type<Type>();
      output_ = context.open_output({std::string(topic_.name), std::string(type.name), topic_.qos, &type});
    });
  }

  bool is_matched() const override {
    return has_reader_ ||
           const_cast<Container&>(container_)
               .wait_for_peers({{std::string(topic_.name), {.readers = 1}}}, std::chrono::milliseconds(0));
  }

  void write(std::int64_t sent_ns) override {
    message_->header().stamp().sec(static_cast<std::int32_t>(sent_ns / 1'000'000'000));
    message_->header().stamp().nanosec(static_cast<std::uint32_t>(sent_ns % 1'000'000'000));
    output_->publish(std::shared_ptr<const void>(message_));
  }

  ~PanvoTransport() override { output_.reset(); }

 private:
  void add(const std::string& name, const std::function<void(Context&)>& set_up) {
    ComponentDescription description;
    description.name = name;
    description.name_space.assign(1, '/');
    container_.add(description, [&](Context& context) {
      set_up(context);
      return std::make_unique<Component>();
    });
  }

  const interfaces::Topic<Type> topic_;
  Container container_;
  std::shared_ptr<Type> message_;  // messages are far enough apart that the previous one has been processed
  std::shared_ptr<UntypedOutput> output_;
  bool has_reader_ = false;
};

}  // namespace

std::unique_ptr<Transport> make_panvo_transport(Message message, int domain, std::uint32_t shared_image_bytes) {
  const DdsSettings dds{.domain = domain, .profiles = "", .name = "bench", .shared_image_bytes = shared_image_bytes};
  if (message == Message::kOdometry)
    return std::make_unique<PanvoTransport<nav_msgs::msg::Odometry>>(kOdometry, dds, nav_msgs::msg::Odometry());
  return std::make_unique<PanvoTransport<sensor_msgs::msg::Image>>(kImage, dds, make_image(image_format(message)));
}

}  // namespace panvo::bench
