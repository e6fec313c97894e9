// SPDX-License-Identifier: Apache-2.0
#include "sample_data_type.hpp"

#include <algorithm>
#include <exception>
#include <new>

#include "fast_dds.hpp"

namespace panvo::runtime::dds {
namespace {

constexpr std::size_t kEncapsulationSize = rtps::SerializedPayload_t::representation_header_size;

// Initial size only; payloads grow as needed.
constexpr std::uint32_t kInitialPayloadSize = 256;

bool has_xcdr1_encapsulation(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= kEncapsulationSize && bytes[0] == 0 && (bytes[1] == CDR_BE || bytes[1] == CDR_LE);
}

/// nullptr if no type is given or decoding fails; the error is reported when the message is accessed.
std::shared_ptr<const void> decode(const interfaces::MessageType* type, std::span<const std::uint8_t> bytes) {
  if (!type) return nullptr;
  try {
    return type->deserialize(bytes);
  } catch (const interfaces::DecodeError&) {
    return nullptr;
  }
}

}  // namespace

void Outgoing::write_to(std::span<std::uint8_t> out) const {
  if (sample_) {
    sample_->serialize_to(out);
  } else {
    std::ranges::copy(bytes_, out.begin());
  }
}

SampleDataType::SampleDataType(const std::string& wire_type_name, std::size_t max_received)
    : KeylessType(wire_type_name), max_received_(max_received) {
  bound(0);
}

void SampleDataType::bound(std::uint32_t max_size) {
  is_bounded_ = max_size > 0;
  set_max_size(is_bounded_ ? max_size : kInitialPayloadSize);
}

bool SampleDataType::write(const void* outgoing, rtps::SerializedPayload_t& payload) {
  const auto& message = *static_cast<const Outgoing*>(outgoing);
  const std::size_t size = message.size();
  if (size < kEncapsulationSize || size > payload.max_size) return false;
  try {
    message.write_to({payload.data, size});
  } catch (const std::exception&) {
    return false;  // exceptions must not reach Fast DDS; the message changed while being sent
  }
  payload.length = static_cast<std::uint32_t>(size);
  payload.encapsulation = payload.data[1];
  return true;
}

bool SampleDataType::read(rtps::SerializedPayload_t& payload, void* incoming) {
  auto& target = *static_cast<Incoming*>(incoming);
  const std::span<const std::uint8_t> bytes(payload.data, payload.length);
  target.too_large = bytes.size() > max_received_;
  target.readable = !target.too_large && has_xcdr1_encapsulation(bytes);
  if (target.readable) {  // otherwise the reader counts it
    try {
      target.message = decode(target.wanted, bytes);
      if (!target.message) target.bytes.assign(bytes.begin(), bytes.end());
    } catch (const std::bad_alloc&) {
      return false;  // exceptions must not reach Fast DDS; it drops the sample
    }
  }
  ++target.reads;
  return true;
}

std::uint32_t SampleDataType::size_of(const void* outgoing) {
  return static_cast<std::uint32_t>(static_cast<const Outgoing*>(outgoing)->size());
}

}  // namespace panvo::runtime::dds
