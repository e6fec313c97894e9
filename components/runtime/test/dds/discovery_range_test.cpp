// SPDX-License-Identifier: Apache-2.0
// ROS_AUTOMATIC_DISCOVERY_RANGE and ROS_STATIC_PEERS between two processes.
#include <gtest/gtest.h>

#include <cstdlib>

#include "inbox.hpp"
#include "peer_process.hpp"
#include "test_messages.hpp"

namespace panvo::runtime::test {
namespace {

constexpr const char* kStringType = "std_msgs/msg/String";

/// Environment of the peer, which reads it when it starts.
class PeerEnvironment {
 public:
  PeerEnvironment(const char* range, const char* peers) {
    setenv(kRange, range, 1);
    setenv(kPeers, peers, 1);
  }
  ~PeerEnvironment() {
    unsetenv(kRange);
    unsetenv(kPeers);
  }
  PeerEnvironment(const PeerEnvironment&) = delete;
  PeerEnvironment& operator=(const PeerEnvironment&) = delete;

 private:
  static constexpr const char* kRange = "ROS_AUTOMATIC_DISCOVERY_RANGE";
  static constexpr const char* kPeers = "ROS_STATIC_PEERS";
};

std::unique_ptr<Bridge> bridge_with(int domain, DiscoveryRange range, std::vector<std::string> peers = {}) {
  DdsSettings settings{.domain = domain, .profiles = "", .name = "panvo_test"};
  settings.range = range;
  settings.peers = std::move(peers);
  return make_dds_bridge(settings);
}

struct Ranges {
  const char* there;
  const char* peers_there;
  DiscoveryRange here;
  std::vector<std::string> peers_here;
};

class DiscoveryRanges : public testing::TestWithParam<Ranges> {};

TEST_P(DiscoveryRanges, ConnectTwoProcessesOfThisMachine) {
  const int domain = test_domain();
  const PeerEnvironment environment(GetParam().there, GetParam().peers_there);
  PeerProcess peer(domain);
  const auto name = unique_topic("text");
  peer.ask("open_reader " + name + " " + kStringType + " reliable volatile 10");
  const auto bridge = bridge_with(domain, GetParam().here, GetParam().peers_here);
  const auto writer = bridge->open_writer(topic(name, kStringType));
  EXPECT_TRUE(eventually([&] { return writer->matched_readers() == 1; }));
}

INSTANTIATE_TEST_SUITE_P(, DiscoveryRanges,
                         testing::Values(Ranges{"LOCALHOST", "", DiscoveryRange::kLocalhost, {}},
                                         Ranges{"SUBNET", "", DiscoveryRange::kLocalhost, {}},
                                         Ranges{"SUBNET", "127.0.0.1", DiscoveryRange::kSubnet, {"localhost"}},
                                         Ranges{"SYSTEM_DEFAULT", "", DiscoveryRange::kSystemDefault, {}}));

// ROS 2 announces the address of the network card in the range LOCALHOST too.
TEST(DiscoveryRange, LocalhostHearsAParticipantOfRos2) {
  const int domain = test_domain();
  PeerProcess peer(domain);
  Inbox<SamplePtr> inbox;
  const auto name = unique_topic("text");
  const auto bridge = bridge_with(domain, DiscoveryRange::kLocalhost);
  const auto reader = bridge->open_reader(topic(name, kStringType), inbox.callback());
  peer.ask("open_raw_writer " + name + " " + kStringType + " reliable volatile localhost");
  ASSERT_TRUE(peer.matches(name, 1));
  ASSERT_TRUE(eventually([&] { return reader->matched_writers() == 1; }));
  ASSERT_EQ(peer.ask("write_bytes " + name + " 0 1 0 0 4 0 0 0 111 110 101 0"), "written");
  EXPECT_EQ(inbox.wait_for_count(1).size(), 1U);
}

TEST(DiscoveryRange, OffConnectsNobody) {
  const int domain = test_domain();
  PeerProcess peer(domain);
  const auto name = unique_topic("text");
  peer.ask("open_reader " + name + " " + kStringType + " reliable volatile 10");
  const auto off = bridge_with(domain, DiscoveryRange::kOff), on = bridge_with(domain, DiscoveryRange::kSubnet);
  const auto silent = off->open_writer(topic(name, kStringType)), writer = on->open_writer(topic(name, kStringType));
  EXPECT_TRUE(eventually([&] { return writer->matched_readers() == 1; }));
  EXPECT_EQ(silent->matched_readers(), 0U);
  EXPECT_TRUE(peer.matches(name, 1));
}

}  // namespace
}  // namespace panvo::runtime::test
