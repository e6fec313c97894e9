// SPDX-License-Identifier: Apache-2.0
#include "own_network.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace panvo::aravis_camera::testing {
namespace {

bool write(const char* file, const std::string& text) {
  std::ofstream stream(file);
  stream << text;
  return static_cast<bool>(stream.flush());
}

/// A request for an interface and an address.
ifreq request(const char* interface, const char* address) {
  ifreq request{};
  std::strncpy(request.ifr_name, interface, IFNAMSIZ - 1);
  sockaddr_in socket_address{};
  socket_address.sin_family = AF_INET;
  inet_pton(AF_INET, address, &socket_address.sin_addr);
  std::memcpy(&request.ifr_addr, &socket_address, sizeof socket_address);
  return request;
}

std::string bring_up_loopback() {
  const int control = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  auto first = request("lo", "127.0.0.1"), second = request("lo:1", "127.0.0.2");
  ifreq up{};
  std::strncpy(up.ifr_name, "lo", IFNAMSIZ - 1);
  bool ok = ioctl(control, SIOCGIFFLAGS, &up) == 0;
  up.ifr_flags = static_cast<short>(up.ifr_flags | IFF_UP | IFF_RUNNING);
  ok = ok && ioctl(control, SIOCSIFFLAGS, &up) == 0 && ioctl(control, SIOCSIFADDR, &first) == 0 &&
       ioctl(control, SIOCSIFADDR, &second) == 0;
  const std::string why = ok ? "" : std::string("the loopback interface cannot be set up: ") + std::strerror(errno);
  close(control);
  return why;
}

}  // namespace

std::string enter_own_network() {
  static const std::string result = [] {
    const uid_t user = getuid();
    const gid_t group = getgid();
    if (unshare(CLONE_NEWUSER | CLONE_NEWNET) == 0) {
      write("/proc/self/setgroups", "deny");
      if (!write("/proc/self/uid_map", fmt::format("0 {} 1", user)) ||
          !write("/proc/self/gid_map", fmt::format("0 {} 1", group)))
        return std::string("user namespaces cannot be mapped here");
    } else if (unshare(CLONE_NEWNET) != 0) {
      return std::string("network namespaces cannot be created here: ") + std::strerror(errno);
    }
    return bring_up_loopback();
  }();
  return result;
}

}  // namespace panvo::aravis_camera::testing
