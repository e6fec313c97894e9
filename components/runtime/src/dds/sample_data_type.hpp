// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/topic/TopicDataType.hpp>

#include <functional>
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

/// What a reader gets from Fast DDS.
struct Incoming {
  interfaces::Bytes bytes;  ///< as received, encapsulation included
  bool readable = false;    ///< led by an XCDR1 encapsulation; false: of no use to anybody
};

/// The one data type that carries every topic: Fast DDS moves bytes and never sees a message class, so no
/// code of a plugin is ever registered with it and plugins may be unloaded. Without keys.
class SampleDataType final : public eprosima::fastdds::dds::TopicDataType {
 public:
  explicit SampleDataType(const std::string& wire_type_name);

  bool serialize(void* outgoing, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override;
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* incoming) override;
  std::function<std::uint32_t()> getSerializedSizeProvider(void* outgoing) override;
  void* createData() override { return new Incoming; }
  void deleteData(void* incoming) override { delete static_cast<Incoming*>(incoming); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

}  // namespace panvo::runtime::dds
