// SPDX-License-Identifier: Apache-2.0
// /clock of played data, for ROS 2 nodes with use_sim_time.
#include <gtest/gtest.h>

#include <future>

#include "panvo/runtime/container.hpp"
#include "peer_process.hpp"
#include "test_messages.hpp"

namespace panvo::runtime::test {
namespace {

/// A source that plays nothing until stopped.
class Silence final : public Component, public Source {
 public:
  explicit Silence(Context& context) { context.source(*this); }
  std::optional<std::int64_t> next_stamp_ns() override { return stamp_ns_; }
  void emit() override { stamp_ns_ += 1'000'000; }
  Progress progress() const override { return {}; }

 private:
  std::int64_t stamp_ns_ = 1'000'000'000;
};

TEST(Clock, OfWhatIsPlayedLeavesTheProcess) {
  const int domain = test_domain();
  PeerProcess peer(domain);
  peer.ask("open_reader /clock rosgraph_msgs/msg/Clock best_effort volatile 10");
  Container container({.rate = 1,
                       .dds = DdsSettings{.domain = domain, .profiles = ""},
                       .log = [](LogLevel, const std::string&, const std::string&) {}});
  ComponentDescription silence;
  silence.name = "silence";
  silence.name_space = "/";
  container.add(silence, [](Context& context) { return std::make_unique<Silence>(context); });
  auto run = std::async(std::launch::async, [&] { return container.run(); });
  EXPECT_FALSE(peer.next_received("/clock").empty());
  container.request_stop();
  EXPECT_TRUE(run.get().empty());
}

}  // namespace
}  // namespace panvo::runtime::test
