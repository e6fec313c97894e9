// SPDX-License-Identifier: Apache-2.0
#include "dds/udp_transport.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "peer_process.hpp"

namespace panvo::runtime::test {

namespace fdds = dds::fdds;
namespace rtps = dds::rtps;

namespace {

struct Receiver final : rtps::TransportReceiverInterface {
  void OnDataReceived(const rtps::octet*, std::uint32_t, const rtps::Locator_t&, const rtps::Locator_t&) override {
    ++(is_started ? after_start : before_start);
  }
  std::atomic<bool> is_started = false;
  std::atomic<int> before_start = 0, after_start = 0;
};

class Socket {
 public:
  ~Socket() { close(file_); }
  /// A port that is free now.
  std::uint16_t bind_any() const {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    bind(file_, reinterpret_cast<sockaddr*>(&address), sizeof(address));
    socklen_t size = sizeof(address);
    getsockname(file_, reinterpret_cast<sockaddr*>(&address), &size);
    return ntohs(address.sin_port);
  }
  bool send_to(std::uint16_t port) const {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return sendto(file_, "RTPS", 4, 0, reinterpret_cast<sockaddr*>(&address), sizeof(address)) == 4;
  }

 private:
  const int file_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
};

/// Whether the socket of a port exists and everything that it received has been read.
bool is_read(std::uint16_t port) {
  char wanted[8];
  std::snprintf(wanted, sizeof(wanted), ":%04X", port);
  std::ifstream table("/proc/net/udp");
  for (std::string line; std::getline(table, line);) {
    std::istringstream words(line);
    std::string number, local, remote, state, queues;
    words >> number >> local >> remote >> state >> queues;
    if (local.ends_with(wanted)) return queues.ends_with(":00000000");
  }
  return false;
}

TEST(MendedUdp, HoldsMessagesUntilReceptionStarts) {
  const auto port = Socket().bind_any();
  fdds::DomainParticipantQos qos;
  qos.transport().user_transports = {dds::mended_udp(std::make_shared<rtps::UDPv4TransportDescriptor>())};
  const std::unique_ptr<rtps::TransportInterface> transport(qos.transport().user_transports[0]->create_transport());
  ASSERT_TRUE(transport->init());
  rtps::Locator_t address;
  rtps::IPLocator::setIPv4(address, "127.0.0.1");
  address.port = port;
  Receiver receiver;
  ASSERT_TRUE(transport->OpenInputChannel(address, &receiver, 65500));

  ASSERT_TRUE(Socket().send_to(port));
  ASSERT_TRUE(eventually([&] { return is_read(port); }));
  receiver.is_started = true;
  dds::start_reception(qos);
  EXPECT_TRUE(eventually([&] { return receiver.after_start == 1; }));
  EXPECT_EQ(receiver.before_start, 0);
  ASSERT_TRUE(Socket().send_to(port));
  EXPECT_TRUE(eventually([&] { return receiver.after_start == 2; }));
  transport->CloseInputChannel(address);
}

rtps::Locator_t address_of(const char* address, std::uint32_t port) {
  rtps::Locator_t locator;
  rtps::IPLocator::setIPv4(locator, address);
  locator.port = port;
  return locator;
}

TEST(MendedUdp, SendsToEachReaderThoughAllShareAMulticastAddress) {
  const auto descriptor = dds::mended_udp(std::make_shared<rtps::UDPv4TransportDescriptor>());
  const std::unique_ptr<rtps::TransportInterface> transport(descriptor->create_transport());
  ASSERT_TRUE(transport->init());
  rtps::LocatorSelector selector({});
  std::vector<rtps::LocatorSelectorEntry> readers(3, {4, 1});
  const std::vector<std::uint32_t> ports{7411, 7413, 7411};  // the third is of the process of the first
  for (std::size_t i = 0; i < readers.size(); ++i) {
    readers[i].remote_guid.guidPrefix.value[0] = static_cast<rtps::octet>(i + 1);
    readers[i].remote_guid.entityId = 4;
    readers[i].unicast.push_back(address_of("127.0.0.1", ports[i]));
    readers[i].multicast.push_back(address_of("239.255.0.1", 7401));
    selector.add_entry(&readers[i]);
  }
  selector.reset(true);
  selector.selection_start();
  transport->select_locators(selector);
  EXPECT_TRUE(selector.is_selected(address_of("127.0.0.1", 7411)));
  EXPECT_TRUE(selector.is_selected(address_of("127.0.0.1", 7413)));
  EXPECT_FALSE(selector.is_selected(address_of("239.255.0.1", 7401)));
  EXPECT_EQ(selector.selected_size(), 2U) << "each address once";
}

}  // namespace
}  // namespace panvo::runtime::test
