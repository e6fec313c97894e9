// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/topic/TopicDataType.hpp>

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>

#include "panvo/runtime/sample.hpp"

namespace panvo::runtime::dds {

/// What a writer gives to Fast DDS: a serialised message, encapsulation included, or one that is serialised straight into the memory that is sent.
class Outgoing {
 public:
  explicit Outgoing(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  explicit Outgoing(const Sample& sample) : sample_(&sample) {}

  std::size_t size() const { return sample_ ? sample_->serialized_size() : bytes_.size(); }
  void write_to(std::span<std::uint8_t> out) const;

 private:
  const Sample* sample_ = nullptr;
  std::span<const std::uint8_t> bytes_;
};

/// What a reader gets from Fast DDS: bytes, or at once the message. What lies in memory that its writer goes on writing to may be nonsense; if so
/// Fast DDS sees it afterwards, and reads the next sample into the same.
struct Incoming {
  const interfaces::MessageType* wanted = nullptr;  ///< set by the reader: a message of that type, if the bytes are one
  std::shared_ptr<const void> message{};            ///< nullptr: see `bytes`
  interfaces::Bytes bytes{};                        ///< as received, encapsulation included
  bool readable = false;                            ///< led by an XCDR1 encapsulation; false: of no use to anybody
  bool too_large = false;                           ///< and therefore neither read nor copied
  unsigned reads = 0;  ///< how many samples were read into it, each in place of the one before
};

/// The one data type that carries every topic: Fast DDS moves bytes and never sees a message class, so no
/// code of a plugin is ever registered with it and plugins may be unloaded. Without keys. `max_received`: what is larger is not read.
class SampleDataType final : public eprosima::fastdds::dds::TopicDataType {
 public:
  explicit SampleDataType(const std::string& wire_type_name,
                          std::size_t max_received = std::numeric_limits<std::size_t>::max());

  /// How large the messages of endpoints that are made from now on are at most, for those that reserve memory; 0: each gets what it needs.
  void bound(std::uint32_t max_size);

  bool serialize(void* outgoing, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override;
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* incoming) override;
  std::function<std::uint32_t()> getSerializedSizeProvider(void* outgoing) override;
  void* createData() override { return new Incoming; }
  void deleteData(void* incoming) override { delete static_cast<Incoming*>(incoming); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
  bool is_bounded() const override { return is_bounded_; }

 private:
  bool is_bounded_ = false;
  const std::size_t max_received_;
};

}  // namespace panvo::runtime::dds
