// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <stdexcept>
#include <utility>

#include "dds/fast_dds_transports.hpp"
#include "nav_msgs/msg/Odometry.h"
#include "panvo/interfaces/message_type.hpp"
#include "sensor_msgs/msg/Image.h"
#include "transport.hpp"
#include "transport_image.hpp"

namespace panvo::bench {
namespace {

namespace fdds = runtime::dds::fdds;
namespace rtps = runtime::dds::rtps;

/// As Fast DDS's own generator has it for each type, with panvo's encoding.
template <class Type>
class GeneratedType final : public runtime::dds::KeylessType {
 public:
  GeneratedType() : KeylessType(std::string(interfaces::message_type<Type>().dds_name)) { set_max_size(256); }

 private:
  bool write(const void* data, rtps::SerializedPayload_t& payload) override {
    payload.length = size_of(data);
    type_.serialize(data, {payload.data, payload.length});
    payload.encapsulation = payload.data[1];
    return true;
  }
  bool read(rtps::SerializedPayload_t& payload, void* data) override {
    *static_cast<Type*>(data) =
        std::move(*std::static_pointer_cast<Type>(type_.deserialize({payload.data, payload.length})));
    return true;
  }
  std::uint32_t size_of(const void* data) override { return static_cast<std::uint32_t>(type_.serialized_size(data)); }
  void* make() override { return new Type; }
  void drop(void* data) override { delete static_cast<Type*>(data); }

  const interfaces::MessageType& type_ = interfaces::message_type<Type>();
};

template <class Type>
class FastddsTransport final : public Transport, fdds::DataReaderListener {
 public:
  FastddsTransport(const char* topic, int domain, Type message, int depth, bool is_image)
      : message_(std::move(message)), depth_(depth), is_image_(is_image) {
    participant_ = fdds::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<fdds::DomainId_t>(domain), participant_qos());
    if (!participant_) throw std::runtime_error("no participant");
    fdds::TypeSupport type(new GeneratedType<Type>());
    type.register_type(participant_);
    topic_ = participant_->create_topic(topic, type.get_type_name(), fdds::TOPIC_QOS_DEFAULT);
  }

  void open_reader(Arrived arrived) override {
    arrived_ = std::move(arrived);
    fdds::DataReaderQos qos;
    qos.reliability().kind = is_image_ ? fdds::BEST_EFFORT_RELIABILITY_QOS : fdds::RELIABLE_RELIABILITY_QOS;
    qos.history().depth = depth_;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    reader_ = participant_->create_subscriber(fdds::SUBSCRIBER_QOS_DEFAULT)->create_datareader(topic_, qos, this);
  }

  void open_writer() override {
    fdds::DataWriterQos qos;
    qos.reliability().kind = fdds::RELIABLE_RELIABILITY_QOS;
    qos.history().depth = depth_;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    if (is_image_) qos.publish_mode().kind = fdds::ASYNCHRONOUS_PUBLISH_MODE;
    writer_ = participant_->create_publisher(fdds::PUBLISHER_QOS_DEFAULT)->create_datawriter(topic_, qos);
  }

  bool is_matched() const override {
    fdds::PublicationMatchedStatus status;
    writer_->get_publication_matched_status(status);
    return status.current_count > 0;
  }

  void write(std::int64_t sent_ns) override {
    message_.header().stamp().sec(static_cast<std::int32_t>(sent_ns / 1'000'000'000));
    message_.header().stamp().nanosec(static_cast<std::uint32_t>(sent_ns % 1'000'000'000));
    writer_->write(&message_);
  }

  ~FastddsTransport() override {
    participant_->delete_contained_entities();
    fdds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

 private:
  static fdds::DomainParticipantQos participant_qos() {
    fdds::DomainParticipantQos qos;
    qos.transport().use_builtin_transports = false;
    const auto shared_memory = std::make_shared<rtps::SharedMemTransportDescriptor>();
    shared_memory->segment_size(32 * 1024 * 1024);
    qos.transport().user_transports.push_back(shared_memory);
    const auto udp = std::make_shared<rtps::UDPv4TransportDescriptor>();
    udp->sendBufferSize = udp->receiveBufferSize = 4 * 1024 * 1024;
    qos.transport().user_transports.push_back(udp);
    return qos;
  }

  void on_data_available(fdds::DataReader* reader) override {
    fdds::SampleInfo info;
    while (reader->take_next_sample(&received_, &info) == runtime::dds::kOk) {
      const auto& stamp = received_.header().stamp();
      if (info.valid_data) arrived_(std::int64_t{stamp.sec()} * 1'000'000'000 + stamp.nanosec());
    }
  }

  Type message_, received_;
  const int depth_;
  const bool is_image_;
  Arrived arrived_;
  fdds::DomainParticipant* participant_ = nullptr;
  fdds::Topic* topic_ = nullptr;
  fdds::DataReader* reader_ = nullptr;
  fdds::DataWriter* writer_ = nullptr;
};

}  // namespace

std::unique_ptr<Transport> make_fastdds_transport(Message message, int domain) {
  if (message == Message::kOdometry) {
    return std::make_unique<FastddsTransport<nav_msgs::msg::Odometry>>(
        kOdometryTopic, domain, nav_msgs::msg::Odometry(), kOdometryDepth, false);
  }
  return std::make_unique<FastddsTransport<sensor_msgs::msg::Image>>(
      kImageTopic, domain, make_image(image_format(message)), kImageDepth, true);
}

}  // namespace panvo::bench
