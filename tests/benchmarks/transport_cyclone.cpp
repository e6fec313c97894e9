// SPDX-License-Identifier: Apache-2.0
#include <dds/dds.h>

#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include "nav_msgs/msg/Odometry.h"
#include "sensor_msgs/msg/Image.h"
#include "transport.hpp"

namespace panvo::bench {
namespace {

dds_entity_t checked(dds_entity_t entity, const char* what) {
  if (entity < 0) throw std::runtime_error(std::string(what) + ": " + dds_strretcode(-entity));
  return entity;
}

/// As large as in panvo: with the default of 1 MB no panorama arrives.
constexpr const char* kSocketBuffers =
    "<CycloneDDS><Domain><Internal><SocketReceiveBufferSize min=\"4MB\"/><SocketSendBufferSize min=\"4MB\"/></Internal>"
    "</Domain></CycloneDDS>";

template <class Type>
class CycloneTransport final : public Transport {
 public:
  CycloneTransport(dds_topic_descriptor_t descriptor, std::string wire_type, const char* topic, int domain, int depth,
                   bool is_image)
      : descriptor_(descriptor), wire_type_(std::move(wire_type)), is_image_(is_image) {
    descriptor_.m_typename = wire_type_.c_str();
    const auto id = static_cast<dds_domainid_t>(domain);
    domain_ = checked(dds_create_domain(id, kSocketBuffers), "domain");
    participant_ =
        checked(dds_create_participant(static_cast<dds_domainid_t>(domain), nullptr, nullptr), "participant");
    topic_ = checked(dds_create_topic(participant_, &descriptor_, topic, nullptr, nullptr), "topic");
    dds_qset_history(qos_, DDS_HISTORY_KEEP_LAST, depth);
    message_ = static_cast<Type*>(dds_alloc(sizeof(Type)));
    std::memset(message_, 0, sizeof(Type));
  }

  Type& message() { return *message_; }

  void open_reader(Arrived arrived) override {
    arrived_ = std::move(arrived);
    dds_qset_reliability(qos_, is_image_ ? DDS_RELIABILITY_BEST_EFFORT : DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
    dds_listener_t* listener = dds_create_listener(this);
    dds_lset_data_available(
        listener, [](dds_entity_t reader, void* self) { static_cast<CycloneTransport*>(self)->take(reader); });
    checked(dds_create_reader(participant_, topic_, qos_, listener), "reader");
    dds_delete_listener(listener);
  }

  void open_writer() override {
    dds_qset_reliability(qos_, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
    writer_ = checked(dds_create_writer(participant_, topic_, qos_, nullptr), "writer");
  }

  bool is_matched() const override {
    dds_publication_matched_status_t status;
    dds_get_publication_matched_status(writer_, &status);
    return status.current_count > 0;
  }

  void write(std::int64_t sent_ns) override {
    message_->header.stamp.sec = static_cast<std::int32_t>(sent_ns / 1'000'000'000);
    message_->header.stamp.nanosec = static_cast<std::uint32_t>(sent_ns % 1'000'000'000);
    dds_write(writer_, message_);
  }

  ~CycloneTransport() override {
    dds_delete(domain_);
    dds_delete_qos(qos_);
    dds_sample_free(message_, &descriptor_, DDS_FREE_ALL);
  }

 private:
  void take(dds_entity_t reader) {
    void* messages[1] = {nullptr};
    dds_sample_info_t info[1];
    while (dds_take(reader, messages, info, 1, 1) > 0) {
      const auto& stamp = static_cast<const Type*>(messages[0])->header.stamp;
      const std::int64_t sent_ns = std::int64_t{stamp.sec} * 1'000'000'000 + stamp.nanosec;
      const bool is_valid = info[0].valid_data;
      if (is_valid) arrived_(sent_ns);
      dds_return_loan(reader, messages, 1);
    }
  }

  dds_topic_descriptor_t descriptor_;
  const std::string wire_type_;
  const bool is_image_;
  dds_qos_t* const qos_ = dds_create_qos();
  Arrived arrived_;
  Type* message_ = nullptr;
  dds_entity_t domain_ = 0, participant_ = 0, topic_ = 0, writer_ = 0;
};

}  // namespace

std::unique_ptr<Transport> make_cyclone_transport(Message message, int domain) {
  if (message == Message::kOdometry) {
    auto odometry = std::make_unique<CycloneTransport<nav_msgs_msg_Odometry>>(
        nav_msgs_msg_Odometry_desc, "nav_msgs::msg::dds_::Odometry_", kOdometryTopic, domain, kOdometryDepth, false);
    odometry->message().header.frame_id = dds_string_dup("");
    odometry->message().child_frame_id = dds_string_dup("");
    return odometry;
  }
  auto transport = std::make_unique<CycloneTransport<sensor_msgs_msg_Image>>(
      sensor_msgs_msg_Image_desc, "sensor_msgs::msg::dds_::Image_", kImageTopic, domain, kImageDepth, true);
  const ImageFormat format = image_format(message);
  auto& image = transport->message();
  image.header.frame_id = dds_string_dup("");
  image.encoding = dds_string_dup(format.encoding);
  image.width = format.width;
  image.height = format.height;
  image.step = format.step();
  image.data._buffer = static_cast<std::uint8_t*>(dds_alloc(format.bytes()));
  std::memset(image.data._buffer, 0, format.bytes());
  image.data._length = image.data._maximum = format.bytes();
  image.data._release = true;
  return transport;
}

}  // namespace panvo::bench
