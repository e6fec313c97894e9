// SPDX-License-Identifier: Apache-2.0
// Services between two processes.
#include <algorithm>
#include <atomic>
#include <future>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <thread>

#include "bridge_fixture.hpp"
#include "dds/request_limits.hpp"
#include "dds/same_host.hpp"
#include "service_messages.hpp"

namespace panvo::runtime::test {
namespace {

constexpr std::chrono::milliseconds kShort{50};

std::string as_numbers(const interfaces::Bytes& bytes) {
  std::string text;
  for (const auto byte : bytes) text += " " + std::to_string(byte);
  return text;
}

ServiceDescription service(const std::string& name) { return {name, kServiceType}; }

interfaces::Bytes echo(const interfaces::Bytes& bytes) { return response("here:" + text_of_request(bytes)); }

TEST_F(BetweenProcesses, ARequestIsAnsweredByTheOtherProcess) {
  const auto name = unique_topic("service");
  peer.ask("serve " + name);
  const auto client = bridge->open_client(service(name));
  ASSERT_TRUE(client->wait_for_service(kLimit));
  for (const char* text : {"one", "two", "three"}) {
    const auto answer = client->call(request(text), kLimit);
    ASSERT_TRUE(answer);
    EXPECT_EQ(text_of_response(*answer), std::string("peer:") + text);
  }
}

TEST_F(BetweenProcesses, ARequestOfTheOtherProcessIsAnswered) {
  const auto name = unique_topic("service");
  const auto server = bridge->serve(service(name), echo);
  EXPECT_EQ(peer.ask("call " + name + " one"), "here:one");
  EXPECT_EQ(peer.ask("call " + name + " two"), "here:two");
  // An answer is counted after sending, when the client may already have it.
  EXPECT_TRUE(eventually([&] { return server->counters().answered == 2; }));
  EXPECT_EQ(server->counters().received, 2U);
}

TEST_F(BetweenProcesses, EachClientGetsTheAnswersToItsOwnRequests) {
  const auto name = unique_topic("service");
  const auto server = bridge->serve(service(name), echo);
  PeerProcess second_peer(domain);
  std::future<void> second = std::async(std::launch::async, [&] {
    for (int i = 0; i < 30; ++i)
      EXPECT_EQ(second_peer.ask("call " + name + " b" + std::to_string(i)), "here:b" + std::to_string(i));
  });
  for (int i = 0; i < 30; ++i)
    EXPECT_EQ(peer.ask("call " + name + " a" + std::to_string(i)), "here:a" + std::to_string(i));
  second.get();
  EXPECT_TRUE(eventually([&] { return server->counters().answered == 60; }));
}

TEST_F(BetweenProcesses, ANewClientGetsItsAnswerWhileAnotherAsksAllTheTime) {
  bridge = make_dds_bridge({.domain = domain, .profiles = "", .name = "panvo_test", .requests_per_s = 1e6});
  const auto name = unique_topic("service");
  const auto server = bridge->serve(service(name), echo);
  PeerProcess busy_peer(domain);
  std::atomic<bool> enough = false;
  std::future<void> busy = std::async(std::launch::async, [&] {
    while (!enough) EXPECT_EQ(busy_peer.ask("call " + name + " busy"), "here:busy");
  });
  for (int i = 0; i < 10 && !HasFailure(); ++i) {
    PeerProcess new_peer(domain);
    EXPECT_EQ(new_peer.ask("call " + name + " new"), "here:new");
  }
  enough = true;
  busy.get();
}

TEST_F(BetweenProcesses, ACallThatNobodyAnswersEnds) {
  const auto client = bridge->open_client(service(unique_topic("service")));
  EXPECT_FALSE(client->wait_for_service(kShort));
  EXPECT_FALSE(client->call(request("nobody"), kShort));
}

TEST_F(BetweenProcesses, AServiceThatEndedIsNotFoundAndOneThatComesBackIs) {
  const auto name = unique_topic("service");
  peer.ask("serve " + name);
  const auto client = bridge->open_client(service(name));
  ASSERT_TRUE(client->wait_for_service(kLimit));
  peer.ask("stop_serving " + name);
  EXPECT_TRUE(eventually([&] { return !client->wait_for_service(std::chrono::milliseconds(0)); }));
  peer.ask("serve " + name);
  ASSERT_TRUE(client->wait_for_service(kLimit));
  EXPECT_TRUE(client->call(request("again"), kLimit));
}

/// Lets a peer's raw client send requests until one arrives: a match there does not imply a match here.
bool is_heard(PeerProcess& peer, const std::string& name, const BridgeService& server) {
  return peer.matches(name, 1) && eventually([&] {
           return peer.ask("write_bytes " + name + as_numbers(request("any"))) == "written" &&
                  server.counters().answered > 0;
         });
}

TEST_F(BetweenProcesses, ARequestThatIsNoneIsCountedAndTheNextAnswered) {
  const auto name = unique_topic("service");
  const auto server = bridge->serve(service(name), echo);
  peer.ask("open_raw_client " + name);
  ASSERT_TRUE(is_heard(peer, name, *server));
  ASSERT_EQ(peer.ask("write_bytes " + name + " 0 1 0 0 255 255 255 255"), "written");
  ASSERT_EQ(peer.ask("write_bytes " + name + " 0 3 0 0 1 0 0 0"), "written");
  EXPECT_TRUE(eventually([&] { return server->counters().malformed == 2; }));
  EXPECT_TRUE(is_warned_of(name, "malformed"));
  EXPECT_EQ(peer.ask("call " + name + " next"), "here:next");
}

TEST_F(BetweenProcesses, AClientThatTellsNoReaderOfItsRepliesIsAnsweredAtOnce) {
  const auto name = unique_topic("service");
  const auto server = bridge->serve(service(name), echo);
  peer.ask("open_raw_client " + name);
  EXPECT_TRUE(is_heard(peer, name, *server));
}

TEST_F(BetweenProcesses, AHandlerThatThrowsIsWarnedOfAndTheNextRequestAnswered) {
  const auto name = unique_topic("service");
  const auto server = bridge->serve(service(name), [](const interfaces::Bytes& bytes) {
    if (text_of_request(bytes) == "bad") throw std::runtime_error("out of ideas");
    return echo(bytes);
  });
  peer.ask("open_raw_client " + name);
  ASSERT_TRUE(is_heard(peer, name, *server));
  ASSERT_EQ(peer.ask("write_bytes " + name + as_numbers(request("bad"))), "written");
  EXPECT_TRUE(is_warned_of(name, "out of ideas"));
  EXPECT_EQ(peer.ask("call " + name + " good"), "here:good");
  EXPECT_EQ(server->counters().unanswered, 1U);
}

TEST_F(BetweenProcesses, ASlowHandlerHoldsNoTopicAndWhatComesMeanwhileIsBounded) {
  const auto name = unique_topic("service"), text = unique_topic("text");
  std::promise<void> may_answer;
  const auto open = may_answer.get_future().share();
  const auto server = bridge->serve(service(name), [&](const interfaces::Bytes& bytes) {
    open.wait();
    return echo(bytes);
  });
  const auto reader = bridge->open_reader(topic(text, kStringType), inbox.callback());
  peer.ask("open_raw_client " + name);
  peer.ask("open_writer " + text + " " + kStringType + " reliable volatile 10");
  ASSERT_TRUE(peer.matches(name, 1) && peer.matches(text, 1));
  ASSERT_TRUE(eventually([&] { return reader->matched_writers() == 1; }));
  constexpr std::uint64_t kRequests = 100;
  const auto ask = [&] { return peer.ask("write_bytes " + name + as_numbers(request("slow"))) == "written"; };
  ASSERT_TRUE(eventually([&] { return ask() && server->counters().received > 0; }));  // now matched on both sides
  for (std::uint64_t i = 0; i < kRequests; ++i) ask();
  EXPECT_TRUE(eventually([&] { return server->counters().received >= kRequests; }));
  peer.ask("write_text " + text + " yes");
  EXPECT_EQ(inbox.wait_for_count(1).size(), 1U);

  may_answer.set_value();
  EXPECT_GT(server->counters().dropped, 0U);
  EXPECT_TRUE(eventually([&] {
    const auto counters = server->counters();
    return counters.answered + counters.dropped == counters.received;
  }));
  EXPECT_TRUE(is_warned_of(name, "dropped"));
}

TEST_F(BetweenProcesses, TheHandlerDoesNotRunAnyMoreWhenTheServiceIsGone) {
  const auto name = unique_topic("service");
  std::atomic<bool> gone = false, called_after = false;
  auto server = bridge->serve(service(name), [&](const interfaces::Bytes& bytes) {
    if (gone) called_after = true;
    return echo(bytes);
  });
  peer.ask("open_raw_client " + name);
  ASSERT_TRUE(peer.matches(name, 1));
  for (int i = 0; i < 20; ++i) peer.ask("write_bytes " + name + as_numbers(request("many")));
  server.reset();
  gone = true;
  EXPECT_TRUE(peer.matches(name, 0));
  EXPECT_FALSE(called_after);
}

TEST_F(BetweenProcesses, WhatTheGuardAnswersIsSentInsteadAndCountedAsRefused) {
  const auto name = unique_topic("service");
  const ServiceGuard guard = [](const interfaces::Bytes& bytes, const Caller& caller) {
    return text_of_request(bytes) == "steer"
               ? std::optional(response(caller.is_on_this_host ? "refused here" : "refused elsewhere"))
               : std::nullopt;
  };
  const auto server = bridge->serve(service(name), echo, guard);
  EXPECT_EQ(peer.ask("call " + name + " look"), "here:look");
  EXPECT_EQ(peer.ask("call " + name + " steer"), "refused here");
  EXPECT_EQ(server->counters().refused, 1U);
  EXPECT_TRUE(is_warned_of(name, "was refused"));
}

TEST_F(BetweenProcesses, RequestsThatAreTooLargeOrTooManyAreDroppedAndCounted) {
  const auto name = unique_topic("service");
  const auto strict = make_dds_bridge(
      {.domain = domain, .profiles = "", .name = "panvo_test", .requests_per_s = 1e-6, .max_request = 40});
  strict->on_warning(warnings.callback());
  const auto server = strict->serve(service(name), echo);
  peer.ask("open_raw_client " + name);
  ASSERT_TRUE(peer.matches(name, 1));
  const auto ask = [&](const std::string& text) {
    return peer.ask("write_bytes " + name + as_numbers(request(text))) == "written";
  };
  ASSERT_TRUE(eventually([&] { return ask(std::string(100, 'x')) && server->counters().dropped > 0; }));
  EXPECT_TRUE(is_warned_of(name, "more than 40 bytes"));
  EXPECT_EQ(server->counters().answered, 0U);
  EXPECT_TRUE(eventually([&] { return ask("short") && server->counters().answered > 0; }));
  ASSERT_TRUE(ask("short"));
  EXPECT_TRUE(is_warned_of(name, "requests per second"));
}

TEST(SameHost, IsToldByVendorAndHostAndNeverByAHash) {
  const auto guid = [](std::initializer_list<std::uint8_t> first) {
    dds::rtps::GUID_t made;
    std::copy(first.begin(), first.end(), made.guidPrefix.value);
    return made;
  };
  const auto own = guid({0x01, 0x0f, 0x12, 0x34, 0x56});
  EXPECT_TRUE(dds::is_on_same_host(own, guid({0x01, 0x0f, 0x12, 0x34, 0x99})));
  EXPECT_FALSE(dds::is_on_same_host(own, guid({0x01, 0x0f, 0x12, 0x35, 0x56})));
  EXPECT_FALSE(dds::is_on_same_host(own, guid({0x01, 0x10, 0x12, 0x34, 0x56}))) << "another vendor";
  const auto hashed = guid({0x81, 0x0f, 0x12, 0x34, 0x56});
  EXPECT_FALSE(dds::is_on_same_host(hashed, hashed)) << "keys of one enclave may be on several hosts";
}

TEST_F(BetweenProcesses, AClientThatIsDiscoveredLateGetsItsAnswerAndHoldsUpNobody) {
  const auto name = unique_topic("service");
  const auto server = bridge->serve(service(name), echo);
  peer.ask("open_late_client " + name);
  ASSERT_TRUE(
      eventually([&] { return peer.ask("ask_late " + name + " late") == "asked" && server->counters().received > 0; }));
  EXPECT_EQ(peer.ask("call " + name + " next"), "here:next");
  EXPECT_TRUE(eventually([&] { return server->counters().answered == 1; }));  // the late client is not discovered yet
  EXPECT_EQ(peer.ask("late_reply " + name), "here:late");
}

TEST_F(BetweenProcesses, AServiceOfNoTypeIsRefused) {
  EXPECT_THROW(bridge->serve({"/x", "no type"}, echo), std::runtime_error);
  EXPECT_THROW(bridge->open_client({"/x", "GetParameters"}), std::runtime_error);
}

}  // namespace
}  // namespace panvo::runtime::test
