// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "dds/fast_dds.hpp"

namespace panvo::runtime::test {

namespace fdds = dds::fdds;
namespace rtps = dds::rtps;
using dds::kOk;

/// A data type of arbitrary bytes with any type name.
class RawType final : public dds::KeylessType {
 public:
  using Payload = std::vector<std::uint8_t>;

  explicit RawType(const std::string& name) : KeylessType(name) { set_max_size(64); }

 private:
  bool write(const void* data, rtps::SerializedPayload_t& target) override {
    const auto& payload = *static_cast<const Payload*>(data);
    std::copy(payload.begin(), payload.end(), target.data);
    target.length = static_cast<std::uint32_t>(payload.size());
    return true;
  }
  bool read(rtps::SerializedPayload_t& source, void* data) override {
    static_cast<Payload*>(data)->assign(source.data, source.data + source.length);
    return true;
  }
  std::uint32_t size_of(const void* data) override {
    return static_cast<std::uint32_t>(std::max<std::size_t>(static_cast<const Payload*>(data)->size(), 1));
  }
  void* make() override { return new Payload; }
  void drop(void* data) override { delete static_cast<Payload*>(data); }
};

}  // namespace panvo::runtime::test
