// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/test_domain.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <string>

namespace panvo::runtime {
namespace {

/// Claims a domain like another process; false if it is taken.
bool take(int domain) {
  const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const std::string name = "panvo_test_domain_" + std::to_string(domain);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  name.copy(address.sun_path + 1, sizeof(address.sun_path) - 1);
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  return ::bind(socket, reinterpret_cast<const sockaddr*>(&address), size) == 0;
}

/// Exit status of a process without a claimed domain: 0 on success.
int claims_one_that_nobody_has() {
  const int would_be_first = 1 + getpid() % 99;
  take(would_be_first);  // or it is taken by another test
  const int own = test_domain();
  if (own < 1 || own > 99 || own == would_be_first) return 1;
  if (test_domain() != own) return 2;
  return take(own) ? 3 : 0;
}

TEST(TestDomain, IsHadByOneProcessAtATime) {
  if (std::getenv("PANVO_TEST_DOMAIN") != nullptr) GTEST_SKIP() << "PANVO_TEST_DOMAIN is set";
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // in a separate process
  EXPECT_EXIT(std::_Exit(claims_one_that_nobody_has()), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace panvo::runtime
