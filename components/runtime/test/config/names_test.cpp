// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/names.hpp"

#include <gtest/gtest.h>

#include "panvo/runtime/errors.hpp"

namespace panvo::runtime {
namespace {

TEST(ResolveTopic, PutsRelativeNamesIntoTheNamespace) {
  EXPECT_EQ(resolve_topic("/ns", "rectifier", {}, "stereo/left/image_rect"), "/ns/stereo/left/image_rect");
  EXPECT_EQ(resolve_topic("ns", "rectifier", {}, "image"), "/ns/image");
  EXPECT_EQ(resolve_topic("/", "rectifier", {}, "image"), "/image");
  EXPECT_EQ(resolve_topic("", "rectifier", {}, "image"), "/image");
}

TEST(ResolveTopic, LeavesAbsoluteNamesAndMakesPrivateOnesTheNodes) {
  EXPECT_EQ(resolve_topic("/ns", "rectifier", {}, "/tf"), "/tf");
  EXPECT_EQ(resolve_topic("/ns", "rectifier", {}, "~/status"), "/ns/rectifier/status");
  EXPECT_EQ(resolve_topic("/", "rectifier", {}, "~/status"), "/rectifier/status");
}

TEST(ResolveTopic, RemapsByTheNameAsWrittenAndAsResolved) {
  EXPECT_EQ(resolve_topic("/ns", "a", {{"image", "camera/image"}}, "image"), "/ns/camera/image");
  EXPECT_EQ(resolve_topic("/ns", "a", {{"/ns/image", "/camera/image"}}, "image"), "/camera/image");
  EXPECT_EQ(resolve_topic("/ns", "a", {{"~/status", "status"}}, "~/status"), "/ns/status");
  EXPECT_EQ(resolve_topic("/ns", "a", {{"/tf", "tf"}}, "/tf"), "/ns/tf");
  EXPECT_EQ(resolve_topic("/ns", "a", {{"/image", "/x"}}, "image"), "/ns/image") << "another topic's rule";
}

TEST(ResolveTopic, RemapsOnceOnly) {
  EXPECT_EQ(resolve_topic("/", "a", {{"left", "right"}, {"right", "left"}}, "left"), "/right");
}

TEST(ResolveTopic, RefusesNamesThatAreNone) {
  for (const char* name :
       {"", "/", "a//b", "a/", "/a/", "9a", "a/9b", "a b", "a-b", "~", "~x", "a/~/b", "\xc3\xa4", "a.b"}) {
    EXPECT_THROW(resolve_topic("/", "n", {}, name), ConfigError) << name;
  }
  EXPECT_THROW(resolve_topic("/", "n", {{"a", "b c"}}, "a"), ConfigError);
  EXPECT_EQ(topic_name_problem(std::string(247, 'a')), std::nullopt);
  EXPECT_NE(topic_name_problem(std::string(248, 'a')), std::nullopt);
}

TEST(ResolveTopic, SaysWhatIsWrongWithAName) {
  try {
    resolve_topic("/", "n", {}, "left image");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "topic name \"left image\" has the character ' '; use letters, digits, '_' and '/' only");
  }
}

TEST(JoinNameSpaces, KeepsAbsoluteOnesAndNestsRelativeOnes) {
  EXPECT_EQ(join_name_spaces("/", ""), "/");
  EXPECT_EQ(join_name_spaces("", ""), "/");
  EXPECT_EQ(join_name_spaces("/", "/"), "/");
  EXPECT_EQ(join_name_spaces("/fleet", ""), "/fleet");
  EXPECT_EQ(join_name_spaces("/fleet", "robot"), "/fleet/robot");
  EXPECT_EQ(join_name_spaces("/fleet", "/robot"), "/robot");
  EXPECT_EQ(join_name_spaces("/", "robot"), "/robot");
}

TEST(NameProblems, TellNodesFromNamespaces) {
  EXPECT_EQ(node_name_problem("rectifier_2"), std::nullopt);
  EXPECT_EQ(node_name_problem("ns/rectifier"), "has a '/'; put the part before it into the key namespace");
  EXPECT_EQ(node_name_problem(""), "is empty");
  EXPECT_EQ(name_space_problem("/fleet/robot"), std::nullopt);
  EXPECT_EQ(name_space_problem(""), std::nullopt);
  EXPECT_NE(name_space_problem("/robot/"), std::nullopt);
}

TEST(NameProblems, APackageIsNamedAsRos2NamesItAndNotByAPath) {
  for (const char* good : {"panvo_stereo_rectifier", "a", "panvo2_x"}) EXPECT_FALSE(package_name_problem(good)) << good;
  for (const char* bad : {"", "/../../evil", "a/b", "a.b", "2panvo", "_a", "Panvo", "a b", "a-b"})
    EXPECT_TRUE(package_name_problem(bad)) << bad;
}

TEST(NameProblems, AClassIsNamedWithOrWithoutNamespaces) {
  for (const char* good : {"StereoRectifierComponent", "panvo::StereoRectifierComponent", "a::b::C"})
    EXPECT_FALSE(class_name_problem(good)) << good;
  for (const char* bad : {"", "::A", "a::", "a:b", "../A", "a/b"}) EXPECT_TRUE(class_name_problem(bad)) << bad;
}

}  // namespace
}  // namespace panvo::runtime
