// SPDX-License-Identifier: Apache-2.0
#include "config/suggestion.hpp"

#include <gtest/gtest.h>

namespace panvo::runtime {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(edit_distance("", ""), 0U);
  EXPECT_EQ(edit_distance("abc", ""), 3U);
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("gian", "gain"), 1U);
  EXPECT_EQ(edit_distance("max_feature", "max_features"), 1U);
}

TEST(Suggestion, IsTheNearestName) {
  EXPECT_EQ(suggestion("nmae", {"plugin", "namespace", "name"}), "; did you mean \"name\"?");
  EXPECT_EQ(suggestion("max_feature", {"tracker.max_features"}), "; did you mean \"tracker.max_features\"?");
  EXPECT_EQ(suggestion("traker.gain", {"matcher.gain", "tracker.gain"}), "; did you mean \"tracker.gain\"?");
}

TEST(Suggestion, ListsAllNamesWhenNoneIsNear) {
  EXPECT_EQ(suggestion("x", {"alpha", "beta"}), "; known names: alpha, beta");
  const auto many = suggestion("x", std::vector<std::string>(23, "alpha"));
  EXPECT_TRUE(many.ends_with(", alpha, and 3 more")) << many;
  EXPECT_EQ(suggestion("x", {}), "; there are none");
}

}  // namespace
}  // namespace panvo::runtime
