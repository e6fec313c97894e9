// SPDX-License-Identifier: Apache-2.0
#include "same_host.hpp"

#include <fastrtps/utils/IPFinder.h>
#include <fastrtps/utils/IPLocator.h>

#include <algorithm>
#include <span>

namespace panvo::runtime::dds {

using eprosima::fastrtps::rtps::GUID_t;
using eprosima::fastrtps::rtps::IPFinder;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::Locator_t;

bool tells_host(const GUID_t& own) {
  constexpr eprosima::fastrtps::rtps::octet kEprosima[2]{0x01, 0x0f};
  return std::ranges::equal(kEprosima, std::span(own.guidPrefix.value).first<2>());
}

bool is_on_same_host(const GUID_t& own, const GUID_t& other) {
  return tells_host(own) && own.is_on_same_host_as(other);
}

bool are_on_this_host(const std::vector<Locator_t>& addresses) {
  constexpr bool kWithLoopback = true;
  std::vector<IPFinder::info_IP> own;
  IPFinder::getIPs(&own, kWithLoopback);
  return !addresses.empty() && std::ranges::all_of(addresses, [&](const Locator_t& address) {
    return std::ranges::any_of(
        own, [&](const auto& ours) { return IPLocator::compareAddress(ours.locator, address, true); });
  });
}

}  // namespace panvo::runtime::dds
