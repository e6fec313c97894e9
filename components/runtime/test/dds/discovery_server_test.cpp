// SPDX-License-Identifier: Apache-2.0
// ROS_DISCOVERY_SERVER instead of multicast.
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>

#include "bridge_fixture.hpp"
#include "graph_tool.hpp"
#include "panvo/runtime/graph.hpp"

extern char** environ;

namespace panvo::runtime::test {
namespace {

/// A port that was free a moment ago.
int free_port() {
  const int socket_number = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  const bool is_bound = bind(socket_number, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
                        getsockname(socket_number, reinterpret_cast<sockaddr*>(&address), &size) == 0;
  close(socket_number);
  return is_bound ? ntohs(address.sin_port) : 0;
}

/// Fast DDS's discovery server, running for the lifetime of this object.
class DiscoveryServer {
 public:
  DiscoveryServer() {
    const std::string port = std::to_string(free_port());
    std::array<std::string, 7> words{"fast-discovery-server", "-i", "0", "-l", "127.0.0.1", "-p", port};
    std::array<char*, 8> arguments{};
    for (std::size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);  // the program is a script that starts the server
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", 1, 0);
    if (posix_spawnp(&pid_, words[0].c_str(), &actions, &attributes, arguments.data(), environ) != 0) pid_ = -1;
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    if (pid_ > 0) setenv("ROS_DISCOVERY_SERVER", ("127.0.0.1:" + port).c_str(), 1);
  }
  ~DiscoveryServer() {
    setenv("ROS_DISCOVERY_SERVER", "", 1);  // if unset, Fast DDS would keep the last value
    if (pid_ <= 0) return;
    kill(-pid_, SIGTERM);
    waitpid(pid_, nullptr, 0);
  }
  bool is_there() const { return pid_ > 0; }

 private:
  pid_t pid_ = -1;
};

class WithDiscoveryServer : public testing::Test {
 protected:
  void SetUp() override {
    if (!server.is_there()) GTEST_SKIP() << "fast-discovery-server is not installed (Debian: fastdds-tools)";
    bridge = make_dds_bridge({.domain = domain, .profiles = "", .name = "panvo_test"});
    peer = std::make_unique<PeerProcess>(domain);
  }

  DiscoveryServer server;
  const int domain = test_domain();
  Inbox<SamplePtr> inbox;
  std::unique_ptr<Bridge> bridge;
  std::unique_ptr<PeerProcess> peer;
};

TEST_F(WithDiscoveryServer, AMessageOfAnotherProcessComesOnceAndNoneOfThisOne) {
  const auto name = unique_topic("text");
  const auto reader = bridge->open_reader(topic(name, kStringType), inbox.callback());
  const auto writer = bridge->open_writer(topic(name, kStringType));
  peer->ask("open_writer " + name + " " + kStringType + " reliable volatile 10");
  peer->ask("open_reader " + name + " " + kStringType + " reliable volatile 10");
  ASSERT_TRUE(eventually([&] { return reader->matched_writers() == 1 && writer->matched_readers() == 1; }));
  ASSERT_TRUE(peer->matches(name, 1));
  ASSERT_TRUE(eventually([&] { return peer->ask("matched_writers " + name) == "1"; }));
  ASSERT_TRUE(writer->write(text_sample("own")));
  ASSERT_TRUE(writer->wait_for_acknowledgments(kLimit));
  peer->next_received(name);  // the other process has received it
  ASSERT_EQ(peer->ask("write_text " + name + " not"), "written");
  ASSERT_EQ(inbox.wait_for_count(1).size(), 1U);
  EXPECT_EQ(inbox.items().front()->bytes(), text_sample("not")->bytes());
  EXPECT_EQ(reader->matched_writers(), 1U);
  EXPECT_EQ(writer->matched_readers(), 1U);
}

TEST_F(WithDiscoveryServer, TopicsAndNodesOfOthersAreHeardOfWithoutReadingThem) {
  const auto name = unique_topic("unread");
  peer->ask("open_writer " + name + " " + kStringType + " reliable volatile 10");
  peer->ask("set_node talker " + name + " /none");
  const auto is_there = [&] {
    const Graph graph = bridge->graph();
    const bool has_topic = std::ranges::any_of(graph.endpoints, [&](const auto& one) { return one.name == name; });
    return has_topic && graph.nodes.size() == 1 && graph.nodes[0].writers.size() == 1;
  };
  EXPECT_TRUE(eventually(is_there));
}

TEST_F(WithDiscoveryServer, TheServerItselfIsNoParticipantWithoutItsTopics) {
  peer.reset();
  bridge.reset();
  EXPECT_THAT(run_graph_tool(domain, "topic list").said, testing::Not(testing::HasSubstr("settled")));
}

/// An address at which no server listens.
class WithSilentDiscoveryServer : public testing::Test {
 protected:
  WithSilentDiscoveryServer() { setenv("ROS_DISCOVERY_SERVER", address.c_str(), 1); }
  ~WithSilentDiscoveryServer() override { setenv("ROS_DISCOVERY_SERVER", "", 1); }

  const std::string address = "127.0.0.1:" + std::to_string(free_port());
  Inbox<std::string> warnings;
};

TEST_F(WithSilentDiscoveryServer, AProcessSaysThatItDoesNotAnswer) {
  const auto bridge = make_dds_bridge({.domain = test_domain(), .profiles = "", .name = "panvo_test"});
  bridge->on_warning(warnings.callback());
  const auto writer = bridge->open_writer(topic(unique_topic("text"), kStringType));
  EXPECT_TRUE(warnings.wait_for([&](const std::string& text) {
    return text.find("no discovery server has answered at " + address) != std::string::npos;
  }));
}

TEST_F(WithSilentDiscoveryServer, ACommandSaysThatItDoesNotAnswer) {
  EXPECT_THAT(run_graph_tool(test_domain(), "topic list").said,
              testing::HasSubstr("no discovery server has answered at " + address));
}

}  // namespace
}  // namespace panvo::runtime::test
