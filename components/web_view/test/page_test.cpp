// SPDX-License-Identifier: Apache-2.0
#include "page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "panvo/test/temporary_folder.hpp"

namespace panvo::web_view {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::map<std::string, std::string> headers_of(const HttpResponse& response) {
  return {response.headers.begin(), response.headers.end()};
}

HttpRequest request(const std::string& path) { return {path, "localhost:8765", ""}; }

TEST(Page, GivesFilesWithTheirTypeAndProtectsThem) {
  const test::TemporaryFolder folder;
  folder.write("index.html", "<p>hello");
  folder.write("main.js", "run()");
  const Page page(folder.path());
  const auto html = page.get(request("/"));
  EXPECT_EQ(html.status, 200);
  EXPECT_EQ(html.body, "<p>hello");
  EXPECT_EQ(html.content_type, "text/html; charset=utf-8");
  auto headers = headers_of(html);
  EXPECT_THAT(headers["Content-Security-Policy"],
              HasSubstr("default-src 'self'; connect-src 'self' ws://localhost:8765 "));
  EXPECT_EQ(headers["X-Content-Type-Options"], "nosniff");
  EXPECT_EQ(headers["Cache-Control"], "no-cache");
  EXPECT_EQ(page.get(request("/main.js")).content_type, "text/javascript; charset=utf-8");
  EXPECT_EQ(page.get(request("/none.js")).status, 404);
}

TEST(Page, SendsAFileAgainOnlyAfterItChanged) {
  const test::TemporaryFolder folder;
  folder.write("main.js", "old");
  const Page page(folder.path());
  auto again = request("/main.js");
  again.if_none_match = headers_of(page.get(again))["ETag"];
  EXPECT_EQ(page.get(again).status, 304);
  EXPECT_EQ(page.get(again).body, "");
  folder.write("main.js", "longer");
  EXPECT_EQ(page.get(again).body, "longer");
}

TEST(Page, DoesNotRepeatAHostThatIsNone) {
  const Page page({});
  auto hostile = request("/");
  hostile.host = "a\"><script>";
  EXPECT_THAT(page.get(hostile).body, Not(HasSubstr("<script>")));
  hostile.host = "a; script-src *";
  EXPECT_THAT(headers_of(page.get(hostile))["Content-Security-Policy"], Not(HasSubstr("*")));
}

TEST(Page, SaysHowToBuildItWhereItIsMissing) {
  const auto answer = Page({}).get(request("/"));
  EXPECT_EQ(answer.status, 404);
  EXPECT_THAT(answer.body, HasSubstr("panvo build"));
  EXPECT_THAT(answer.body, HasSubstr("ds.url=ws://localhost:8765"));
  auto secure = request("/");
  secure.is_secure = true;
  EXPECT_THAT(Page({}).get(secure).body, HasSubstr("ds.url=wss://localhost:8765"));
  EXPECT_EQ(Page({}).get(request("/main.js")).content_type, "text/plain; charset=utf-8");
}

}  // namespace
}  // namespace panvo::web_view
