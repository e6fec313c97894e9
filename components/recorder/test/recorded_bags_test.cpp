// SPDX-License-Identifier: Apache-2.0
/// Bags written by ROS 2's tools: each opens and contains the expected number of messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "panvo/recorder/bag_reader.hpp"
#include "panvo/test/recorded_data.hpp"
#include "test_bag.hpp"

namespace panvo::recorder {
namespace {

using namespace test;

struct Expected {
  const char* bag;
  std::uint64_t messages;
  const char* warning;  ///< nullptr: none
};

class RecordedBag : public testing::TestWithParam<Expected> {};

TEST_P(RecordedBag, IsReadWhole) {
  const auto folder = panvo::test::recorded_data("bags");
  PANVO_NEEDS_RECORDING(folder);
  const auto& [bag, count, warning] = GetParam();
  BagReader reader(folder / bag);
  if (warning) {
    EXPECT_TRUE(any_contains(reader.warnings(), warning));
  } else {
    EXPECT_THAT(reader.warnings(), testing::IsEmpty());
  }
  EXPECT_EQ(reader.metadata().message_count, count);
  std::uint64_t by_topic = 0;
  for (const auto& topic : reader.metadata().topics) {
    by_topic += topic.message_count;
  }
  EXPECT_EQ(by_topic, count);
  const auto messages = read_all(reader);
  EXPECT_EQ(messages.size(), count);
  EXPECT_TRUE(std::is_sorted(messages.begin(), messages.end(),
                             [](const Read& a, const Read& b) { return a.timestamp_ns < b.timestamp_ns; }));
  EXPECT_EQ(reader.lost_messages(), 0u);
}

#define ROS2 "ros2_rosbag2/"
INSTANTIATE_TEST_SUITE_P(
    Sqlite, RecordedBag,
    testing::Values(Expected{"rosbag2_test", 4695, nullptr}, Expected{"tf_example", 518, nullptr},
                    Expected{"test_bag_sqlite3", 188, nullptr}, Expected{"sample.db3", 5, nullptr},
                    Expected{ROS2 "ros2bag/test/resources/empty_bag", 0, nullptr},
                    Expected{ROS2 "rosbag2_cpp/test/rosbag2_cpp/bags/topics_and_services.db3", 13, nullptr},
                    Expected{ROS2 "rosbag2_py/test/resources/sqlite3/convert_a", 150, nullptr},
                    Expected{ROS2 "rosbag2_py/test/resources/sqlite3/convert_b", 75, nullptr},
                    Expected{ROS2 "rosbag2_py/test/resources/sqlite3/reindex_test_bags/multiple_files", 3177,
                             "metadata.yaml: is missing"},
                    Expected{ROS2 "rosbag2_py/test/resources/sqlite3/talker", 20, nullptr},
                    // Its metadata.yaml states the last file's times for the whole bag.
                    Expected{ROS2 "rosbag2_py/test/resources/sqlite3/wbag", 6074, "metadata.yaml: lists"},
                    Expected{ROS2 "rosbag2_tests/resources/sqlite3/bag_with_topics_and_service_events", 10, nullptr},
                    Expected{ROS2 "rosbag2_tests/resources/sqlite3/cdr_test", 7, nullptr},
                    Expected{ROS2 "rosbag2_tests/resources/sqlite3/wrong_rmw_test", 7, nullptr},
                    Expected{ROS2 "rosbag2_transport/test/resources/sqlite3/rewriter_a", 150, nullptr},
                    Expected{ROS2 "rosbag2_transport/test/resources/sqlite3/rewriter_b", 75, nullptr},
                    Expected{ROS2 "rosbag2_transport/test/resources/sqlite3/test_bag_for_seek", 5, nullptr}));

INSTANTIATE_TEST_SUITE_P(
    Mcap, RecordedBag,
    testing::Values(Expected{"nav2_turtlebot.mcap", 8197, nullptr}, Expected{"test_bag_mcap", 188, nullptr},
                    Expected{ROS2 "rosbag2_cpp/test/rosbag2_cpp/bags/only_services.mcap", 12, nullptr},
                    Expected{ROS2 "rosbag2_cpp/test/rosbag2_cpp/bags/only_topics.mcap", 7, nullptr},
                    Expected{ROS2 "rosbag2_cpp/test/rosbag2_cpp/bags/topics_and_services.mcap", 13, nullptr},
                    // Their writer treated time 0 as no time.
                    Expected{ROS2 "rosbag2_py/test/resources/mcap/convert_a", 150, "metadata.yaml: lists"},
                    Expected{ROS2 "rosbag2_py/test/resources/mcap/convert_b", 75, nullptr},
                    Expected{ROS2 "rosbag2_py/test/resources/mcap/reindex_test_bags/multiple_files", 3177,
                             "metadata.yaml: is missing"},
                    Expected{ROS2 "rosbag2_py/test/resources/mcap/talker", 20, nullptr},
                    Expected{ROS2 "rosbag2_py/test/resources/mcap/wbag", 6074, "metadata.yaml: lists"},
                    Expected{ROS2 "rosbag2_tests/resources/mcap/bag_with_topics_and_service_events", 10, nullptr},
                    Expected{ROS2 "rosbag2_tests/resources/mcap/cdr_test", 7, nullptr},
                    Expected{ROS2 "rosbag2_tests/resources/mcap/wrong_rmw_test", 7, nullptr},
                    Expected{ROS2 "rosbag2_transport/test/resources/mcap/rewriter_a", 150, "metadata.yaml: lists"},
                    Expected{ROS2 "rosbag2_transport/test/resources/mcap/rewriter_b", 75, nullptr},
                    Expected{ROS2 "rosbag2_transport/test/resources/mcap/test_bag_for_seek", 5, nullptr}));

}  // namespace
}  // namespace panvo::recorder
