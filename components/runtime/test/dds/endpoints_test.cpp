// SPDX-License-Identifier: Apache-2.0
// Opening and closing of endpoints, and refusals.
#include <atomic>
#include <thread>

#include "bridge_fixture.hpp"
#include "panvo/runtime/errors.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::runtime::test {
namespace {

std::string problem_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST_F(BetweenProcesses, EndpointsComeAndGo200Times) {
  const auto name = unique_topic("text");
  peer.ask("open_writer " + name + " " + kStringType + " reliable transient_local 1");
  peer.ask("write_text " + name + " kept");
  for (int i = 0; i < 200; ++i) {
    const auto writer = bridge->open_writer(topic(unique_topic("mine"), i % 2 ? kImageType : kStringType));
    const auto reader = bridge->open_reader(topic(name, kStringType), inbox.callback());
    ASSERT_TRUE(writer->write(text_sample("unheard")));
  }
  Inbox<SamplePtr> last;
  const auto reader = bridge->open_reader(
      topic(name, kStringType, {.durability = interfaces::Durability::kTransientLocal, .depth = 1}), last.callback());
  EXPECT_EQ(last.wait_for_count(1).size(), 1U);
}

TEST_F(BetweenProcesses, AReaderIsNotCalledAfterItIsClosed) {
  const auto name = unique_topic("text");
  peer.ask("open_writer " + name + " " + kStringType + " reliable volatile 10");
  for (int i = 0; i < 20; ++i) {
    std::atomic<bool> closed = false, called_after = false;
    std::atomic<int> calls = 0;
    auto reader = bridge->open_reader(topic(name, kStringType), [&](const SamplePtr&) {
      if (closed) called_after = true;
      ++calls;
    });
    ASSERT_TRUE(peer.matches(name, 1));
    std::thread writing([&] {
      for (int k = 0; k < 20; ++k) peer.ask("write_text " + name + " x");
    });
    const bool called = eventually([&] { return calls > 0; });
    reader.reset();
    closed = true;
    writing.join();
    ASSERT_TRUE(called);
    ASSERT_FALSE(called_after);
    ASSERT_TRUE(peer.matches(name, 0));
  }
}

TEST(DdsBridge, SharesATopicBetweenItsEndpointsAndRefusesASecondType) {
  const auto bridge = make_dds_bridge({.domain = test_domain(), .profiles = "", .name = "panvo_test"});
  const auto name = unique_topic("text");
  auto first = bridge->open_writer(topic(name, kStringType));
  const auto second = bridge->open_writer(topic(name, kStringType));
  const auto problem = problem_of([&] { bridge->open_writer(topic(name, kImageType)); });
  EXPECT_NE(problem.find(name), std::string::npos) << problem;
  EXPECT_NE(problem.find(kStringType), std::string::npos) << problem;
  EXPECT_NE(problem.find(kImageType), std::string::npos) << problem;
  first.reset();
  EXPECT_TRUE(second->write(text_sample("still open")));
}

TEST(DdsBridge, OutlivedByItsEndpointsLeavesThemUsable) {
  auto bridge = make_dds_bridge({.domain = test_domain(), .profiles = "", .name = "panvo_test"});
  const auto writer = bridge->open_writer(topic(unique_topic("text"), kStringType));
  const auto reader = bridge->open_reader(topic(unique_topic("text"), kStringType), [](const SamplePtr&) {});
  bridge.reset();
  EXPECT_TRUE(writer->write(text_sample("nobody listens")));
}

TEST(DdsBridge, RefusesADomainOutOfRange) {
  EXPECT_NE(problem_of([] { make_dds_bridge({.domain = 233, .profiles = "", .name = ""}); }).find("ROS_DOMAIN_ID"),
            std::string::npos);
}

TEST(DdsBridge, RefusesATypeNameOfAnotherForm) {
  const auto bridge = make_dds_bridge({.domain = test_domain(), .profiles = "", .name = "panvo_test"});
  const auto problem = problem_of([&] { bridge->open_writer(topic("/text", "String")); });
  EXPECT_NE(problem.find("package/msg/Type"), std::string::npos) << problem;
}

TEST(DdsBridge, NamesAProfileFileThatIsMissingOrWrong) {
  const auto missing =
      problem_of([] { make_dds_bridge({.domain = test_domain(), .profiles = "/no/such.xml", .name = ""}); });
  EXPECT_NE(missing.find("/no/such.xml"), std::string::npos) << missing;

  const panvo::test::TemporaryFolder folder;
  for (const char* content :
       {"no xml at all",
        "<profiles><participant profile_name='p'><rtps><noSuchThing/></rtps></participant></profiles>"}) {
    const auto file = folder.write("profile.xml", content);
    const auto wrong =
        problem_of([&] { make_dds_bridge({.domain = test_domain(), .profiles = file.string(), .name = ""}); });
    EXPECT_NE(wrong.find(file.string()), std::string::npos) << content << ": " << wrong;
  }
}

TEST_F(BetweenProcesses, WithTheExampleProfileMeetsOneWithoutAProfile) {
  const auto name = unique_topic("text");
  const auto profiled = make_dds_bridge(
      {.domain = domain, .profiles = std::string(PANVO_DDS_PROFILES) + "/fastdds_udp.xml", .name = "profiled"});
  const auto reader = profiled->open_reader(topic(name, kImageType), inbox.callback());
  peer.ask("open_writer " + name + " " + kImageType + " reliable volatile 5");
  ASSERT_TRUE(peer.matches(name, 1));
  ASSERT_EQ(peer.ask("write_image " + name + " 1000000 3"), "written");
  ASSERT_EQ(inbox.wait_for_count(1).size(), 1U);
  EXPECT_EQ(inbox.items().front()->bytes(), image_sample(1000000, 3)->bytes());
}

}  // namespace
}  // namespace panvo::runtime::test
