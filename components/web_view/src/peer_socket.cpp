// SPDX-License-Identifier: Apache-2.0
#include "peer_socket.hpp"

#include <fcntl.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <filesystem>
#include <system_error>

namespace panvo::web_view {
namespace {

struct End {
  std::string address;
  std::string port;
};

using NameOf = int (*)(int, sockaddr*, socklen_t*);

/// One end of a connection; empty if the descriptor is none.
End end_of(int descriptor, NameOf name_of) {
  sockaddr_storage name{};
  socklen_t size = sizeof name;
  auto* const generic = reinterpret_cast<sockaddr*>(&name);
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> service{};
  if (name_of(descriptor, generic, &size) != 0 || getnameinfo(generic, size, host.data(), host.size(), service.data(),
                                                              service.size(), NI_NUMERICHOST | NI_NUMERICSERV) != 0) {
    return {};
  }
  return {host.data(), service.data()};
}

}  // namespace

PeerSocket::PeerSocket(const std::string& address, int port, int own_port) {
  std::error_code error;  // without /proc, nothing is found
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
    const auto name = entry.path().filename().string();
    int number = -1;
    std::from_chars(name.data(), name.data() + name.size(), number);
    // First the copy, then the look at it: another thread may close the descriptor at any time.
    const int copy = fcntl(number, F_DUPFD_CLOEXEC, 0);
    if (copy < 0) continue;
    const auto peer = end_of(copy, getpeername);
    if (peer.address == address && peer.port == std::to_string(port) &&
        end_of(copy, getsockname).port == std::to_string(own_port)) {
      socket_ = copy;
      return;
    }
    ::close(copy);
  }
}

PeerSocket::~PeerSocket() {
  if (socket_ >= 0) ::close(socket_);
}

void PeerSocket::shut_down() noexcept {
  if (socket_ >= 0) ::shutdown(socket_, SHUT_RDWR);
}

}  // namespace panvo::web_view
