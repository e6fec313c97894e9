// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "fast_dds.hpp"

namespace panvo::runtime::dds {

// What follows believes what others say of themselves: it prevents mistakes, not attacks.

/// Whether GUIDs tell the host: a Fast DDS GUID starts with the vendor's number and a number derived from the host's
/// addresses. DDS Security puts a hash there.
bool tells_host(const rtps::GUID_t& own);

/// Whether `other` claims to be on the host of `own`. GUIDs of other vendors never match.
bool is_on_same_host(const rtps::GUID_t& own, const rtps::GUID_t& other);

/// Whether a participant that listens at these addresses is on this host: all of them belong to it. False for none.
bool are_on_this_host(const std::vector<rtps::Locator_t>& addresses);

}  // namespace panvo::runtime::dds
