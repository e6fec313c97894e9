// SPDX-License-Identifier: Apache-2.0
#include "panvo/postgres/location.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace panvo::postgres {
namespace {

TEST(Location, IsThatOfAServerOnlyWithItsScheme) {
  EXPECT_TRUE(is_location("postgresql://host/db"));
  EXPECT_TRUE(is_location("postgres:///db"));
  EXPECT_FALSE(is_location("campus.landmarks"));
  EXPECT_FALSE(is_location("/maps/postgresql://x"));
  EXPECT_FALSE(is_location("postgresql:/db"));
  EXPECT_FALSE(is_location(""));
}

TEST(Location, IsShownAsItIsWithoutAPassword) {
  for (const char* location :
       {"postgresql://robot@server/campus", "postgresql:///campus?host=/run/postgresql&user=robot",
        "postgresql://robot@[::1]:5432/campus", "postgresql://a:1,b:2/campus?connect_timeout=3", "campus.landmarks",
        "postgresql://", "postgresql:///campus?application_name=a@b"}) {
    EXPECT_EQ(without_password(location), location);
  }
}

TEST(Location, IsShownWithoutItsPassword) {
  EXPECT_EQ(without_password("postgresql://robot:secret@server:5432/campus"), "postgresql://robot@server:5432/campus");
  EXPECT_EQ(without_password("postgres://robot:se%40cret@a,b/campus?x=1"), "postgres://robot@a,b/campus?x=1");
  EXPECT_EQ(without_password("postgresql://robot:se?cret@server/campus"), "postgresql://robot@server/campus");
  EXPECT_EQ(without_password("postgresql:///campus?user=robot&password=secret&host=/run"),
            "postgresql:///campus?user=robot&host=/run");
  EXPECT_EQ(without_password("postgresql://server/campus?sslpassword=secret"), "postgresql://server/campus");
  EXPECT_EQ(without_password("postgresql://server/campus?pass%77ord=secret"), "postgresql://server/campus");
}

TEST(Location, ThatIsMalformedHidesWhatMayBeAPassword) {
  for (const char* location : {"postgresql://robot:sec/ret@server/campus", "postgresql://robot:sec@ret@server/campus",
                               "postgresql://robot:sec/ret", "postgresql://robot:sec:ret@server",
                               "postgresql://robot:sec?ret@server/campus", "postgresql://robot:ret"}) {
    EXPECT_THAT(without_password(location), testing::Not(testing::HasSubstr("ret"))) << location;
    EXPECT_THAT(without_password(location), testing::StartsWith("postgresql://robot")) << location;
  }
}

}  // namespace
}  // namespace panvo::postgres
