// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/topic/TopicDataType.hpp>

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>

#include "fast_dds.hpp"
#include "panvo/runtime/sample.hpp"

namespace panvo::runtime::dds {

/// Data passed from a writer to Fast DDS: a serialised message with encapsulation, or a message serialised directly
/// into the send buffer.
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

/// Data passed from Fast DDS to a reader: bytes or a decoded message. Data in shared memory may be overwritten while
/// being read; Fast DDS detects this afterwards and reads the next sample into the same object.
struct Incoming {
  const interfaces::MessageType* wanted = nullptr;  ///< set by the reader: decode to this type if possible
  std::shared_ptr<const void> message{};            ///< nullptr: see `bytes`
  interfaces::Bytes bytes{};                        ///< as received, with encapsulation
  bool readable = false;                            ///< has an XCDR1 encapsulation; false: unusable
  bool too_large = false;                           ///< neither read nor copied
  unsigned reads = 0;                               ///< number of samples read into it, each replacing the last
};

/// The only data type, used for all topics: Fast DDS handles bytes and never a message class, so no plugin code is
/// registered with it and plugins can be unloaded. Keyless. Messages larger than `max_received` are not read.
class SampleDataType final : public KeylessType {
 public:
  explicit SampleDataType(const std::string& wire_type_name,
                          std::size_t max_received = std::numeric_limits<std::size_t>::max());

  /// Sets the largest message of endpoints created from now on that reserve memory; 0: memory as needed.
  void bound(std::uint32_t max_size);

  bool is_bounded() const override { return is_bounded_; }

 private:
  bool write(const void* outgoing, rtps::SerializedPayload_t& payload) override;
  bool read(rtps::SerializedPayload_t& payload, void* incoming) override;
  std::uint32_t size_of(const void* outgoing) override;
  void* make() override { return new Incoming; }
  void drop(void* incoming) override { delete static_cast<Incoming*>(incoming); }

  bool is_bounded_ = false;
  const std::size_t max_received_;
};

}  // namespace panvo::runtime::dds
