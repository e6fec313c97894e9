// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/rtps/common/InstanceHandle.h>
#include <fastdds/rtps/common/SerializedPayload.h>
#include <fastdds/dds/topic/TopicDataType.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace panvo::runtime::test {

/// A data type of arbitrary bytes with any type name.
class RawType final : public eprosima::fastdds::dds::TopicDataType {
 public:
  using Payload = std::vector<std::uint8_t>;

  explicit RawType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 64;
  }
  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* target) override {
    const auto& payload = *static_cast<Payload*>(data);
    std::copy(payload.begin(), payload.end(), target->data);
    target->length = static_cast<std::uint32_t>(payload.size());
    return true;
  }
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* source, void* data) override {
    static_cast<Payload*>(data)->assign(source->data, source->data + source->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [size = static_cast<std::uint32_t>(static_cast<Payload*>(data)->size())] { return std::max(size, 1U); };
  }
  void* createData() override { return new Payload; }
  void deleteData(void* data) override { delete static_cast<Payload*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

}  // namespace panvo::runtime::test
