// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fast_dds.hpp"

namespace panvo::runtime::dds {

/// The DDS participants of this process, identified by GUID prefix. A prefix normally starts with host and process
/// numbers, which Fast DDS uses for this; DDS Security replaces them by a hash of the keys. Thread-safe.
///
/// A participant stays registered after its destruction, as its events arrive later.
void add_own_participant(const rtps::GUID_t& participant);
bool is_of_this_process(const rtps::GUID_t& endpoint);

}  // namespace panvo::runtime::dds
