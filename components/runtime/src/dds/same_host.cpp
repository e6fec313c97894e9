// SPDX-License-Identifier: Apache-2.0
#include "same_host.hpp"

#include <ifaddrs.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <set>
#include <span>

namespace panvo::runtime::dds {
namespace {

/// As in a locator: an IPv4 address is in the last four bytes.
using Address = std::array<rtps::octet, 16>;

/// Addresses of all network interfaces of this host.
std::set<Address> own_addresses() {
  std::set<Address> own;
  ifaddrs* interfaces = nullptr;
  if (getifaddrs(&interfaces) != 0) return own;
  for (const ifaddrs* one = interfaces; one; one = one->ifa_next) {
    if (!one->ifa_addr) continue;
    Address address{};
    if (one->ifa_addr->sa_family == AF_INET) {
      std::memcpy(&address[12], &reinterpret_cast<const sockaddr_in*>(one->ifa_addr)->sin_addr, 4);
    } else if (one->ifa_addr->sa_family == AF_INET6) {
      std::memcpy(address.data(), &reinterpret_cast<const sockaddr_in6*>(one->ifa_addr)->sin6_addr, 16);
    } else {
      continue;
    }
    own.insert(address);
  }
  freeifaddrs(interfaces);
  return own;
}

}  // namespace

bool tells_host(const rtps::GUID_t& own) {
  constexpr rtps::octet kEprosima[2]{0x01, 0x0f};
  return std::ranges::equal(kEprosima, std::span(own.guidPrefix.value).first<2>());
}

bool is_on_same_host(const rtps::GUID_t& own, const rtps::GUID_t& other) {
  return tells_host(own) && own.is_on_same_host_as(other);
}

bool are_on_this_host(const std::vector<rtps::Locator_t>& addresses) {
  const auto own = own_addresses();
  return !addresses.empty() && std::ranges::all_of(addresses, [&](const rtps::Locator_t& address) {
    return own.contains(std::to_array(address.address));
  });
}

}  // namespace panvo::runtime::dds
