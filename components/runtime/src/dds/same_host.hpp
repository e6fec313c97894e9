// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/rtps/common/Guid.h>

namespace panvo::runtime::dds {

/// Whether `other` says that it is on the host of `own`. Fast DDS writes its vendor's number and a number of the host, of its addresses, at the
/// beginning of a GUID; another vendor's is never on this host. DDS Security puts a hash there, so that nobody is. A stranger can write any: it
/// is a guard against mistakes, not against an attack.
inline bool is_on_same_host(const eprosima::fastrtps::rtps::GUID_t& own,
                            const eprosima::fastrtps::rtps::GUID_t& other) {
  constexpr eprosima::fastrtps::rtps::octet kEprosima[2]{0x01, 0x0f};
  const auto* prefix = own.guidPrefix.value;
  return prefix[0] == kEprosima[0] && prefix[1] == kEprosima[1] && own.is_on_same_host_as(other);
}

}  // namespace panvo::runtime::dds
