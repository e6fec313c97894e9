// SPDX-License-Identifier: Apache-2.0
// A link between two interfaces that loses some packets; replaces the kernel's network emulator (tc netem).
//   panvo_lossy_link INTERFACE INTERFACE SHARE
// Prints `ready` and, at its end on SIGTERM, `lost N of M packets`. Losses are deterministic by packet number.
#include <arpa/inet.h>
#include <linux/if_ether.h>
#include <linux/if_packet.h>
#include <net/if.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

namespace {

volatile std::sig_atomic_t is_asked_to_stop = 0;

void set(int socket, int option, int value) { setsockopt(socket, SOL_PACKET, option, &value, sizeof value); }

int open_interface(const char* name) {
  const int packets = socket(AF_PACKET, SOCK_RAW, htons(ETH_P_ALL));
  // Forwards the offload information (checksums, segmentation), so that the other end can complete the work.
  set(packets, PACKET_VNET_HDR, 1);
  set(packets, PACKET_IGNORE_OUTGOING, 1);
  const int buffer = 64 * 1024 * 1024;  // avoids unintended losses
  setsockopt(packets, SOL_SOCKET, SO_RCVBUFFORCE, &buffer, sizeof buffer);
  setsockopt(packets, SOL_SOCKET, SO_SNDBUFFORCE, &buffer, sizeof buffer);
  sockaddr_ll address{};
  address.sll_family = AF_PACKET;
  address.sll_protocol = htons(ETH_P_ALL);
  address.sll_ifindex = static_cast<int>(if_nametoindex(name));
  if (packets < 0 || bind(packets, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    std::perror(name);
    std::exit(1);
  }
  return packets;
}

}  // namespace

int main(int argc, char** argv) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // no orphans after a crash of the test
  if (argc != 4) return 2;
  struct sigaction stop {};
  stop.sa_handler = [](int) { is_asked_to_stop = 1; };
  sigaction(SIGTERM, &stop, nullptr);

  std::array<pollfd, 2> ends{{{open_interface(argv[1]), POLLIN, 0}, {open_interface(argv[2]), POLLIN, 0}}};
  std::bernoulli_distribution is_lost(std::atof(argv[3]));
  std::minstd_rand random(1);
  std::vector<char> packet(128 * 1024);
  unsigned long carried = 0, lost = 0;
  std::puts("ready");
  std::fflush(stdout);
  while (!is_asked_to_stop) {
    if (poll(ends.data(), ends.size(), -1) <= 0) continue;
    for (std::size_t from = 0; from < ends.size(); ++from) {
      if ((ends.at(from).revents & POLLIN) == 0) continue;
      const ssize_t size = read(ends.at(from).fd, packet.data(), packet.size());
      if (size <= 0) continue;
      ++carried;
      if (is_lost(random)) {
        ++lost;
      } else if (write(ends.at(1 - from).fd, packet.data(), static_cast<std::size_t>(size)) < 0) {
        std::perror("write");
      }
    }
  }
  std::printf("lost %lu of %lu packets\n", lost, carried);
  return 0;
}
