// SPDX-License-Identifier: Apache-2.0
#include "panvo/recorder/topic_filter.hpp"

#include <gtest/gtest.h>

#include "panvo/recorder/bag_error.hpp"

namespace panvo::recorder {
namespace {

TEST(TopicFilter, AcceptsAllWithoutPatterns) {
  EXPECT_TRUE(TopicFilter().accepts("/tf"));
  EXPECT_TRUE(TopicFilter({""}).accepts("/tf"));
}

TEST(TopicFilter, TakesNamesAndRegularExpressionsForWholeNames) {
  const TopicFilter filter({"/tf", "odom", "/stereo/.*"});
  EXPECT_TRUE(filter.accepts("/tf"));
  EXPECT_TRUE(filter.accepts("/odom"));
  EXPECT_TRUE(filter.accepts("/stereo/left/image_raw"));
  EXPECT_FALSE(filter.accepts("/tf_static"));
  EXPECT_FALSE(filter.accepts("/robot/stereo/left/image_raw"));
}

TEST(TopicFilter, TakesSeveralPatternsInOneText) {
  const TopicFilter filter({"/tf /odom"});
  EXPECT_TRUE(filter.accepts("/tf"));
  EXPECT_TRUE(filter.accepts("/odom"));
  EXPECT_FALSE(filter.accepts("/tf /odom"));
}

TEST(TopicFilter, ExcludesWhatItIncludes) {
  const TopicFilter filter({"/stereo/.*"}, {".*_raw"});
  EXPECT_TRUE(filter.accepts("/stereo/left/image_rect"));
  EXPECT_FALSE(filter.accepts("/stereo/left/image_raw"));
}

TEST(TopicFilter, BearsNamesThatAreLongerThanThatOfAnyTopic) {
  const TopicFilter filter({"/stereo/.*"});
  EXPECT_TRUE(filter.accepts("/stereo/" + std::string(247, 'a')));
  EXPECT_FALSE(filter.accepts("/stereo/" + std::string(1'000'000, 'a')));
}

TEST(TopicFilter, NamesThePatternThatIsNone) {
  try {
    TopicFilter filter({"/stereo/["});
    FAIL();
  } catch (const BagError& error) {
    EXPECT_NE(std::string(error.what()).find("'/stereo/['"), std::string::npos);
  }
}

TEST(TopicFilter, TellsWhichPatternsMatchNothing) {
  EXPECT_EQ(TopicFilter({"/tf", "/stero/.*"}).unmatched({"/tf", "/stereo/left"}),
            std::vector<std::string>{"/stero/.*"});
}

}  // namespace
}  // namespace panvo::recorder
