// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/test_domain.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

namespace panvo::runtime {
namespace {

constexpr int kLastDomain = 99;  // higher domains reach into the ephemeral ports

/// An abstract socket name belongs to one process at a time and to a network namespace, like DDS ports, and is freed
/// however the process ends. The socket stays open on purpose.
bool claim(int domain) {
  const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (socket < 0)
    throw std::runtime_error("cannot create a socket to claim a DDS domain: " + std::string(std::strerror(errno)));
  const std::string name = "panvo_test_domain_" + std::to_string(domain);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  name.copy(address.sun_path + 1, sizeof(address.sun_path) - 1);  // leading zero: abstract name
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  if (::bind(socket, reinterpret_cast<const sockaddr*>(&address), size) == 0) return true;
  ::close(socket);
  return false;
}

int find_domain() {
  if (const char* domain = std::getenv("PANVO_TEST_DOMAIN")) return std::stoi(domain);
  // Each process starts at another domain, to leave time for remains of a domain's last owner to disappear.
  const int first = static_cast<int>(::getpid() % kLastDomain);
  for (int i = 0; i < kLastDomain; ++i) {
    const int domain = 1 + (first + i) % kLastDomain;
    if (claim(domain)) return domain;
  }
  throw std::runtime_error("all DDS domains for tests, 1.." + std::to_string(kLastDomain) +
                           ", are in use; end the tests that still run, or set PANVO_TEST_DOMAIN");
}

}  // namespace

int test_domain() {
  static const int domain = find_domain();
  return domain;
}

}  // namespace panvo::runtime
