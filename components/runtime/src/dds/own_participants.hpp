// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/rtps/common/Guid.h>

namespace panvo::runtime::dds {

/// The DDS participants that this process has made, by the prefix that all their endpoints have. A prefix begins with the numbers of host and
/// process, by which Fast DDS tells its own, but DDS Security puts in their place what the keys say. Safe to use from several threads.
///
/// A participant stays known when it is gone: what its end brings about comes later.
void add_own_participant(const eprosima::fastrtps::rtps::GUID_t& participant);
bool is_of_this_process(const eprosima::fastrtps::rtps::GUID_t& endpoint);

}  // namespace panvo::runtime::dds
