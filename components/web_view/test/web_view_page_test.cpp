// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "panvo/test/temporary_folder.hpp"
#include "web_view_fixture.hpp"

namespace panvo::web_view::test {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class WebViewPage : public WebView {
 protected:
  WebViewPage() { folder_.write("index.html", "<p>hello"); }

  void start_with_page(std::map<std::string, std::string> parameters = {}) {
    parameters.emplace("page", folder_.path().string());
    start(parameters);
  }
  std::string get(const std::string& path, const std::string& headers = "") {
    return http_answer(port(), "GET " + path + " HTTP/1.1\r\nHost: localhost\r\n" + headers + "\r\n");
  }

 private:
  const panvo::test::TemporaryFolder folder_;
};

TEST_F(WebViewPage, IsServedOnThePortOfTheSocket) {
  start_with_page();
  EXPECT_THAT(get("/"),
              AllOf(StartsWith("HTTP/1.1 200 OK\r\n"), HasSubstr("Content-Type: text/html; charset=utf-8\r\n"),
                    HasSubstr("Content-Length: 8\r\n"), EndsWith("\r\n\r\n<p>hello")));
  WebSocketClient client(port());
  EXPECT_EQ(next_text(client, "serverInfo")["name"], "panvo");
}

TEST_F(WebViewPage, AnswersOtherPathsAndMethodsWithAnError) {
  start_with_page();
  for (const char* path :
       {"/none", "/../../../../etc/passwd", "/%2e%2e/%2e%2e/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd"})
    EXPECT_THAT(get(path), AllOf(StartsWith("HTTP/1.1 4"), Not(HasSubstr("root:")))) << path;
  EXPECT_THAT(http_answer(port(), "POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 0\r\n\r\n"),
              StartsWith("HTTP/1.1 405 "));
  EXPECT_THAT(http_answer(port(), "HEAD / HTTP/1.1\r\nHost: localhost\r\n\r\n"),
              AllOf(StartsWith("HTTP/1.1 200 OK\r\n"), HasSubstr("Content-Length: 8\r\n"), EndsWith("\r\n\r\n")));
}

TEST_F(WebViewPage, IsGivenToThoseWithTheTokenAndThenByCookie) {
  start_with_page({{"token", "sesame"}});
  EXPECT_THAT(get("/"), StartsWith("HTTP/1.1 401 "));
  EXPECT_THAT(get("/?token=sesam"), StartsWith("HTTP/1.1 401 "));
  const std::string answer = get("/?token=sesame");
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 200 "));
  const std::string name = "Set-Cookie: ";
  const auto start = answer.find(name);
  ASSERT_NE(start, std::string::npos);
  const std::string cookie = answer.substr(start + name.size(), answer.find(';', start) - start - name.size());
  EXPECT_THAT(get("/", "Cookie: " + cookie + "\r\n"), StartsWith("HTTP/1.1 200 "));
  EXPECT_THAT(get("/", "Cookie: " + cookie.substr(0, cookie.find('=')) + "=\r\n"), StartsWith("HTTP/1.1 401 "));
  const std::string socket = "Sec-WebSocket-Protocol: foxglove.sdk.v1\r\nCookie: " + cookie + "\r\n";
  EXPECT_EQ(WebSocketClient(port(), {.path = "/", .headers = socket}).status(), 101);
}

}  // namespace
}  // namespace panvo::web_view::test
