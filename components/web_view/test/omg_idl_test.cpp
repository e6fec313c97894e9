// SPDX-License-Identifier: Apache-2.0
#include "omg_idl.hpp"

#include <gtest/gtest.h>

namespace panvo::web_view {
namespace {

constexpr const char* kDefinition = R"(# A reading.
uint8 GOOD=1
bool IS_NEW=true
string NAME=a "b" # c
float64 LIMIT = -1.5  # metres
std_msgs/Header header  # of the reading
Point[] points
Point[<=3] few
Point first
bool[2] flags
byte raw
float64[36] covariance
string<=8 short_text
string<=8[<=4] short_texts
float32 x 1.5

================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
================================================================================
MSG: my_msgs/Point
float32 x
)";

constexpr const char* kIdl = R"(module builtin_interfaces {
module msg {
struct Time {
  int32 sec;
  uint32 nanosec;
};
};
};
module std_msgs {
module msg {
struct Header {
  builtin_interfaces::msg::Time stamp;
  string frame_id;
};
};
};
module my_msgs {
module msg {
struct Point {
  float x;
};
};
};
module my_msgs {
module msg {
module Reading_Constants {
  const uint8 GOOD = 1;
  const boolean IS_NEW = TRUE;
  const string NAME = "a \"b\" # c";
  const double LIMIT = -1.5;
};
struct Reading {
  std_msgs::msg::Header header;
  sequence<my_msgs::msg::Point> points;
  sequence<my_msgs::msg::Point, 3> few;
  my_msgs::msg::Point first;
  boolean flags[2];
  octet raw;
  double covariance[36];
  string<8> short_text;
  sequence<string<8>, 4> short_texts;
  float x;
};
};
};
)";

TEST(OmgIdl, SaysTheSameAsTheMsgNotation) { EXPECT_EQ(idl_definition("my_msgs/msg/Reading", kDefinition), kIdl); }

TEST(OmgIdl, HasNoEmptyStructs) {
  EXPECT_EQ(idl_name("std_srvs/srv/Trigger_Request"), "std_srvs::srv::Trigger_Request");
  EXPECT_EQ(idl_definition("std_srvs/srv/Trigger_Request", ""),
            "module std_srvs {\nmodule srv {\nstruct Trigger_Request {\n  uint8 structure_needs_at_least_one_member;\n"
            "};\n};\n};\n");
}

}  // namespace
}  // namespace panvo::web_view
