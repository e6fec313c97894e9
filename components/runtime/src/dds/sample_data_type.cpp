// SPDX-License-Identifier: Apache-2.0
#include "sample_data_type.hpp"

#include <fastdds/rtps/common/SerializedPayload.h>

#include <algorithm>
#include <new>

namespace panvo::runtime::dds {
namespace {

constexpr std::size_t kEncapsulationSize = eprosima::fastrtps::rtps::SerializedPayload_t::representation_header_size;

// Payloads grow to what is written into them; this is only where they start.
constexpr std::uint32_t kInitialPayloadSize = 256;

bool has_xcdr1_encapsulation(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= kEncapsulationSize && bytes[0] == 0 && (bytes[1] == CDR_BE || bytes[1] == CDR_LE);
}

}  // namespace

SampleDataType::SampleDataType(const std::string& wire_type_name) {
  setName(wire_type_name.c_str());
  m_typeSize = kInitialPayloadSize;
  m_isGetKeyDefined = false;
  // We match by name, as ROS 2 does; there is nothing to say about the type's structure.
  auto_fill_type_object(false);
  auto_fill_type_information(false);
}

bool SampleDataType::serialize(void* outgoing, eprosima::fastrtps::rtps::SerializedPayload_t* payload) {
  const auto bytes = static_cast<const Outgoing*>(outgoing)->bytes;
  if (bytes.size() < kEncapsulationSize || bytes.size() > payload->max_size) return false;
  std::copy(bytes.begin(), bytes.end(), payload->data);
  payload->length = static_cast<std::uint32_t>(bytes.size());
  payload->encapsulation = bytes[1];
  return true;
}

bool SampleDataType::deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* incoming) {
  auto& target = *static_cast<Incoming*>(incoming);
  const std::span<const std::uint8_t> bytes(payload->data, payload->length);
  target.readable = has_xcdr1_encapsulation(bytes);
  if (!target.readable) return true;  // the reader counts it
  try {
    target.bytes.assign(bytes.begin(), bytes.end());
  } catch (const std::bad_alloc&) {
    return false;  // Fast DDS must not see an exception; it drops the sample
  }
  return true;
}

std::function<std::uint32_t()> SampleDataType::getSerializedSizeProvider(void* outgoing) {
  const auto size = static_cast<std::uint32_t>(static_cast<const Outgoing*>(outgoing)->bytes.size());
  return [size] { return size; };
}

}  // namespace panvo::runtime::dds
