// SPDX-License-Identifier: Apache-2.0
#include "access.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace panvo::web_view {
namespace {

TEST(Access, KnowsTheAddressesThatOnlyThisMachineReaches) {
  for (const char* host : {"127.0.0.1", "127.1.2.3", "localhost", "::1", "[::1]"}) EXPECT_TRUE(is_local(host)) << host;
  for (const char* host : {"0.0.0.0", "192.168.1.7", "", "::", "127.example.org"}) EXPECT_FALSE(is_local(host)) << host;
}

TEST(Access, TellsEqualSecretsFromOthers) {
  EXPECT_TRUE(is_equal_secret("secret", "secret"));
  for (const char* given : {"", "secreT", "Secret", "secre", "secretsecret", "secret "})
    EXPECT_FALSE(is_equal_secret("secret", given)) << given;
  EXPECT_FALSE(is_equal_secret("", "secret"));
}

TEST(Access, TrustsPagesOfThisMachineAndOfKnownViewers) {
  const std::vector<std::string> allowed{"https://viewer.example.org"};
  for (const char* origin : {"", "http://localhost", "http://localhost:8080", "https://127.0.0.1:1",
                             "http://[::1]:3000", "https://app.foxglove.dev", "file://", "https://viewer.example.org"})
    EXPECT_TRUE(is_trusted_origin(origin, allowed)) << origin;
  for (const char* origin :
       {"null", "https://example.org", "http://localhost.example.org", "https://app.foxglove.dev.example.org",
        "http://127.0.0.1.example.org", "ftp://localhost", "http://[::1", "localhost", "http://", "https"})
    EXPECT_FALSE(is_trusted_origin(origin, allowed)) << origin;
  EXPECT_TRUE(is_trusted_origin("https://example.org", std::vector<std::string>{"*"}));
}

TEST(Access, ReadsTheTokenOfAHeader) {
  EXPECT_EQ(bearer_token("Bearer abc"), "abc");
  EXPECT_EQ(bearer_token("Basic abc"), "");
  EXPECT_EQ(bearer_token(""), "");
}

}  // namespace
}  // namespace panvo::web_view
