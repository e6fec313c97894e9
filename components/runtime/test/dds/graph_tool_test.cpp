// SPDX-License-Identifier: Apache-2.0
// Output of `panvo node`, `param`, `topic`, `service` and `component` for a container in another process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <string>

#include "graph_tool.hpp"
#include "peer_process.hpp"
#include "rcl_interfaces/srv/DescribeParameters.h"
#include "rcl_interfaces/srv/GetParameters.h"
#include "rcl_interfaces/srv/ListParameters.h"
#include "test_messages.hpp"

namespace panvo::runtime::test {
namespace {

using testing::HasSubstr;

class GraphTool : public testing::Test {
 protected:
  ToolResult run(const std::string& arguments) const { return run_graph_tool(domain, arguments); }
  /// The output once it contains `wanted`; discovery can be slow on a busy machine.
  std::string eventually_says(const std::string& arguments, const std::string& wanted) const {
    std::string said;
    EXPECT_TRUE(eventually([&] {
      said = run(arguments).said;
      return said.find(wanted) != std::string::npos;
    })) << arguments
        << ": never said " << wanted;
    return said;
  }

  const int domain = test_domain();
  PeerProcess peer{domain, PANVO_CONTAINER_PEER};
};

TEST_F(GraphTool, ListsNodesTopicsServicesAndContainers) {
  EXPECT_EQ(eventually_says("node list", "/controlled"), "/controlled\n/robot/echo\n");
  EXPECT_THAT(eventually_says("node info robot/echo", "Service Servers"),
              AllOf(HasSubstr("/robot/echoed: std_msgs/msg/String"), HasSubstr("/rosout: rcl_interfaces/msg/Log"),
                    HasSubstr("/parameter_events: rcl_interfaces/msg/ParameterEvent")));
  EXPECT_THAT(eventually_says("topic list -t", "/rosout"), HasSubstr("/robot/to_echo [std_msgs/msg/String]\n"));
  EXPECT_THAT(eventually_says("topic info /robot/to_echo -v", "Node"), HasSubstr("Node: /robot/echo\n"));
  EXPECT_THAT(eventually_says("service list", "list_nodes"), HasSubstr("/controlled/_container/load_node\n"));
  EXPECT_EQ(eventually_says("component running", "echo"), "/controlled\n  1  /robot/echo\n");
}

TEST_F(GraphTool, GetsDescribesAndSetsParameters) {
  EXPECT_THAT(run("param list /robot/echo").said, AllOf(testing::StartsWith("before\nsize\nuse_sim_time\n"),
                                                        HasSubstr("\nqos_overrides./robot/echoed.publisher.depth\n")));
  EXPECT_EQ(run("param get /robot/echo size").said, "3\n");
  EXPECT_EQ(run("param set /robot/echo size 5").said, "set\n");
  EXPECT_EQ(run("param get /robot/echo size").said, "5\n");
  const auto refused = run("param set /robot/echo size 50");
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.said, HasSubstr("must be 1..9"));
  EXPECT_THAT(run("param set /robot/echo size many").said, HasSubstr("size is an integer, but a text was given"));
  EXPECT_THAT(run("param describe /robot/echo size").said, HasSubstr("integer, 1 .. 9, settable"));
  EXPECT_EQ(run("param get /robot/echo nothing").status, 1);
  EXPECT_EQ(run("param set /robot/echo use_sim_time true").said, "set\n");
  eventually_says("node info /robot/echo", "/clock: rosgraph_msgs/msg/Clock");
}

/// Nodes of rclcpp and rclpy give no value at all if one of the requested parameters has none.
TEST_F(GraphTool, DescribesTheOtherParametersOfANodeWithOneThatHasNoValue) {
  using namespace rcl_interfaces::srv;  // NOLINT(google-build-using-namespace): the requests and responses
  const auto bridge = make_dds_bridge({.domain = domain, .profiles = "", .name = "panvo_test"});
  const auto listing =
      bridge->serve({"/talker/list_parameters", "rcl_interfaces/srv/ListParameters"}, [](const interfaces::Bytes&) {
        ListParameters_Response response;
        response.result().names({"empty", "size"});
        return to_bytes(response);
      });
  const auto describing = bridge->serve({"/talker/describe_parameters", "rcl_interfaces/srv/DescribeParameters"},
                                        [](const interfaces::Bytes& request) {
                                          const auto asked = from_bytes<DescribeParameters_Request>(request);
                                          DescribeParameters_Response response;
                                          for (const auto& name : asked.names())
                                            response.descriptors().emplace_back().name(name);
                                          return to_bytes(response);
                                        });
  const auto getting = bridge->serve(
      {"/talker/get_parameters", "rcl_interfaces/srv/GetParameters"}, [](const interfaces::Bytes& request) {
        GetParameters_Response response;
        if (from_bytes<GetParameters_Request>(request).names() == std::vector<std::string>{"size"}) {
          response.values().emplace_back().type(2);  // integer
          response.values()[0].integer_value(3);
        }
        return to_bytes(response);
      });
  const auto described = run("param describe /talker");
  EXPECT_THAT(described.said, AllOf(HasSubstr("empty = not set\n"), HasSubstr("size = 3\n")));
}

TEST_F(GraphTool, LoadsAndUnloads) {
  ASSERT_EQ(eventually_says("component running", "echo"), "/controlled\n  1  /robot/echo\n");  // the peer has started
  const auto loaded = run("component load /controlled panvo_test_relay RelayComponent -n second -p copies:=5");
  EXPECT_EQ(loaded.status, 0);
  EXPECT_EQ(loaded.said, "2  /second\n");
  EXPECT_EQ(run("param get /second copies").said, "5\n");
  EXPECT_EQ(run("component unload /controlled 2").said, "unloaded 2\n");
  const auto refused = run("component load /controlled panvo_nothing Nothing");
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.said, HasSubstr("panvo_nothing has no plugin"));
}

TEST_F(GraphTool, CallsServicesByTypeOfTheirServer) {
  const auto answer = run("service call /robot/echo/get_parameters '{names: [size]}'");
  EXPECT_EQ(answer.status, 0);
  EXPECT_THAT(answer.said, HasSubstr("integer_value: 3\n"));
  EXPECT_EQ(run("service call /robot/echo/get_parameters rcl_interfaces/srv/GetParameters '{names: [size]}'").said,
            answer.said);
  const auto nothing = run("service call /robot/echo/get_parameters rcl_interfaces/srv/GetParameters '{}'");
  EXPECT_EQ(nothing.status, 0) << nothing.said;
  for (const char* same : {"rcl_interfaces/srv/GetParameters", "'{}'", ""}) {
    EXPECT_EQ(run(std::string("service call /robot/echo/get_parameters ") + same).said, nothing.said) << same;
  }
  EXPECT_EQ(run("--timeout 1 service call /robot/echo/get_parameters rcl_interfaces/srv/SetParameters").status, 1);
  EXPECT_EQ(run("service call /robot/echo/get_parameters '{name: [size]}'").status, 2);
}

TEST_F(GraphTool, EchoesAndMeasuresTopics) {
  EXPECT_THAT(run("topic echo /diagnostics --once").said, HasSubstr("  name: 'panvo: echo'\n"));
  EXPECT_THAT(run("topic hz /diagnostics -n 3").said, HasSubstr("average rate: "));
  EXPECT_THAT(run("topic bw /diagnostics -n 1").said, testing::ContainsRegex("KB/s from [12] messages"));
}

TEST_F(GraphTool, SaysThatAPublisherIsGoneInsteadOfItsLastRate) {
  const auto bridge = make_dds_bridge({.domain = domain, .profiles = "", .name = "panvo_test"});
  // Latched: what is written before the tool has discovered the writer is not lost.
  auto writer = bridge->open_writer(test::topic("/leaving", "std_msgs/msg/String",
                                                {.durability = interfaces::Durability::kTransientLocal, .depth = 10}));
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(writer->write(text_sample("text")));
  auto said = std::async(std::launch::async, [&] { return run("topic hz /leaving -n 3").said; });
  ASSERT_TRUE(eventually([&] { return writer->matched_readers() == 1; }));
  ASSERT_TRUE(writer->wait_for_acknowledgments(kLimit));
  writer.reset();
  EXPECT_THAT(said.get(), testing::ContainsRegex("average rate: .*\nthe publisher is gone\nthe publisher is gone\n$"));
}

TEST_F(GraphTool, SaysThatDiscoveryHasNotSettled) {
  EXPECT_THAT(run("--timeout 0.3 topic list").said, HasSubstr("discovery has not settled"));
  EXPECT_THAT(run("topic list").said, testing::Not(HasSubstr("settled")));
}

TEST_F(GraphTool, WritesNothingThatSteersATerminal) {
  // The container accepts any text; the shell creates the escape sequence.
  EXPECT_EQ(run("param set /robot/echo before \"$(printf '\\033[2Jhere\\233')\"").said, "set\n");
  const auto got = run("param get /robot/echo before").said;
  EXPECT_THAT(got, HasSubstr("\\x1b[2Jhere"));
  EXPECT_EQ(got.find_first_of("\033\233"), std::string::npos) << got;
}

TEST_F(GraphTool, SaysWhatIsNotThereAndEndsInTime) {
  const auto missing = run("--timeout 1 topic echo /nothing");
  EXPECT_EQ(missing.status, 1);
  EXPECT_THAT(missing.said, HasSubstr("no publisher of /nothing"));
  EXPECT_EQ(run("--timeout 1 param get /nobody size").status, 1);
  EXPECT_EQ(run("--timeout 1 service call /nothing").status, 1);
  EXPECT_EQ(run("topic").status, 2);
  EXPECT_EQ(run("topic hz --help").status, 0);
}

}  // namespace
}  // namespace panvo::runtime::test
