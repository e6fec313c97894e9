// SPDX-License-Identifier: Apache-2.0
#pragma once

// Fast DDS 2 (Debian 12; from 2.9) and 3 (Debian 13; from 3.1) by the same names. What differs otherwise is in the
// functions below, or behind PANVO_FAST_DDS_3.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#if __has_include(<fastdds/config.hpp>)
#define PANVO_FAST_DDS_3
#include <fastdds/config.hpp>
#include <fastdds/dds/core/ReturnCode.hpp>
#include <fastdds/dds/core/Time_t.hpp>
#include <fastdds/rtps/common/Guid.hpp>
#include <fastdds/rtps/common/InstanceHandle.hpp>
#include <fastdds/rtps/common/Locator.hpp>
#include <fastdds/rtps/common/SampleIdentity.hpp>
#include <fastdds/rtps/common/SerializedPayload.hpp>
#include <fastdds/rtps/common/WriteParams.hpp>
#else
#include <fastdds/rtps/common/Guid.h>
#include <fastdds/rtps/common/InstanceHandle.h>
#include <fastdds/rtps/common/Locator.h>
#include <fastdds/rtps/common/SampleIdentity.h>
#include <fastdds/rtps/common/SerializedPayload.h>
#include <fastdds/rtps/common/Time_t.h>
#include <fastdds/rtps/common/WriteParams.h>
#include <fastrtps/config.h>
#include <fastrtps/types/TypesBase.h>
#endif
#include <fastdds/dds/core/status/SampleRejectedStatus.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>

namespace panvo::runtime::dds {

namespace fdds = eprosima::fastdds::dds;

#ifdef PANVO_FAST_DDS_3
inline constexpr bool kIsFastDds3 = true;
namespace rtps = eprosima::fastdds::rtps;
using Duration = fdds::Duration_t;
using ReturnCode = fdds::ReturnCode_t;
using DiscoveryProtocol = rtps::DiscoveryProtocol;
using ParticipantFilteringFlags = rtps::ParticipantFilteringFlags;
inline constexpr const char* kFastDdsVersion = FASTDDS_VERSION_STR;
inline constexpr ReturnCode kOk = fdds::RETCODE_OK;
inline const Duration kInfinite = fdds::c_TimeInfinite;
#else
inline constexpr bool kIsFastDds3 = false;
namespace rtps {
using namespace eprosima::fastdds::rtps;
using namespace eprosima::fastrtps::rtps;
}  // namespace rtps
using Duration = eprosima::fastrtps::Duration_t;
using ReturnCode = eprosima::fastrtps::types::ReturnCode_t;
using DiscoveryProtocol = rtps::DiscoveryProtocol_t;
using ParticipantFilteringFlags = rtps::ParticipantFilteringFlags_t;
inline constexpr const char* kFastDdsVersion = FASTRTPS_VERSION_STR;
inline const ReturnCode kOk = ReturnCode::RETCODE_OK;
inline const Duration kInfinite = eprosima::fastrtps::c_TimeInfinite;
#endif

/// Whether participants may have flow controllers. With one, Fast DDS 3.0 and 3.1 queue the participant's announcements,
/// and abort if the same one is queued twice and they were built with assertions, as in Debian 13.
#if defined(PANVO_FAST_DDS_3) && FASTDDS_VERSION_MAJOR == 3 && FASTDDS_VERSION_MINOR < 2
inline constexpr bool kHasFlowControl = false;
#else
inline constexpr bool kHasFlowControl = true;
#endif

/// Writes `data`, which the type of the topic reads. `params` get the sequence number.
inline bool write(fdds::DataWriter& writer, void* data, rtps::WriteParams& params) {
#ifdef PANVO_FAST_DDS_3
  return writer.write(data, params) == kOk;
#else
  return writer.write(data, params);
#endif
}

inline bool write(fdds::DataWriter& writer, void* data) {
#ifdef PANVO_FAST_DDS_3
  return writer.write(data) == kOk;
#else
  return writer.write(data);
#endif
}

inline void set_heartbeat(Duration period, fdds::DataWriterQos& qos) {
#ifdef PANVO_FAST_DDS_3
  qos.reliable_writer_qos().times.heartbeat_period = period;
#else
  qos.reliable_writer_qos().times.heartbeatPeriod = period;
#endif
}

/// How long a reader waits before it tells a new writer what it lacks, and before it answers a heartbeat.
inline void set_acknowledgement_delays(Duration delay, fdds::DataReaderQos& qos) {
  auto& times = qos.reliable_reader_qos().times;
#ifdef PANVO_FAST_DDS_3
  times.initial_acknack_delay = delay;
  times.heartbeat_response_delay = delay;
#else
  times.initialAcknackDelay = delay;
  times.heartbeatResponseDelay = delay;
#endif
}

/// Readers take messages in XCDR1 only.
inline void set_representation(fdds::DataReaderQos& qos) {
#ifdef PANVO_FAST_DDS_3
  qos.representation().m_value = {fdds::XCDR_DATA_REPRESENTATION};
#else
  qos.type_consistency().representation.m_value = {fdds::XCDR_DATA_REPRESENTATION};
#endif
}

/// A data type without keys and type objects.
class KeylessType : public fdds::TopicDataType {
 public:
  explicit KeylessType(const std::string& name) {
#ifdef PANVO_FAST_DDS_3
    set_name(name);
#else
    setName(name.c_str());
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
#endif
  }

 protected:
  /// Serialised size of any sample, or a first estimate of one without bound.
  void set_max_size(std::uint32_t size) {
#ifdef PANVO_FAST_DDS_3
    max_serialized_type_size = size;
#else
    m_typeSize = size;
#endif
  }

 private:
  virtual bool write(const void* data, rtps::SerializedPayload_t& payload) = 0;
  virtual bool read(rtps::SerializedPayload_t& payload, void* data) = 0;
  virtual std::uint32_t size_of(const void* data) = 0;
  virtual void* make() = 0;
  virtual void drop(void* data) = 0;

#ifdef PANVO_FAST_DDS_3
  bool serialize(const void* data, rtps::SerializedPayload_t& payload, fdds::DataRepresentationId_t) final {
    return write(data, payload);
  }
  bool deserialize(rtps::SerializedPayload_t& payload, void* data) final { return read(payload, data); }
  std::uint32_t calculate_serialized_size(const void* data, fdds::DataRepresentationId_t) final {
    return size_of(data);
  }
  void* create_data() final { return make(); }
  void delete_data(void* data) final { drop(data); }
  bool compute_key(rtps::SerializedPayload_t&, rtps::InstanceHandle_t&, bool) final { return false; }
  bool compute_key(const void*, rtps::InstanceHandle_t&, bool) final { return false; }
#else
  bool serialize(void* data, rtps::SerializedPayload_t* payload) final { return write(data, *payload); }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) final { return read(*payload, data); }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) final {
    return [this, data] { return size_of(data); };
  }
  void* createData() final { return make(); }
  void deleteData(void* data) final { drop(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) final { return false; }
#endif
};

}  // namespace panvo::runtime::dds
