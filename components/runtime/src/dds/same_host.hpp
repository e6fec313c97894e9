// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/rtps/common/Guid.h>

namespace panvo::runtime::dds {

/// Whether `other` claims to be on the host of `own`. A Fast DDS GUID starts with the vendor's number and a number
/// derived from the host's addresses; GUIDs of other vendors never match. DDS Security puts a hash there, so nothing
/// matches. GUIDs can be forged: this prevents mistakes, not attacks.
inline bool is_on_same_host(const eprosima::fastrtps::rtps::GUID_t& own,
                            const eprosima::fastrtps::rtps::GUID_t& other) {
  constexpr eprosima::fastrtps::rtps::octet kEprosima[2]{0x01, 0x0f};
  const auto* prefix = own.guidPrefix.value;
  return prefix[0] == kEprosima[0] && prefix[1] == kEprosima[1] && own.is_on_same_host_as(other);
}

}  // namespace panvo::runtime::dds
