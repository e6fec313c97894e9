// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "process.hpp"

namespace panvo::test {

/// Two hosts with a network between them, simulated by network namespaces; each has its own /dev/shm. The destructor
/// removes them.
class TwoHosts {
 public:
  struct Network {
    bool routed = false;  ///< true: two subnets with a router that does not forward multicast; false: one subnet
    double loss = 0;      ///< fraction of lost packets; only with one subnet
    int mtu = 1400;
  };

  /// Reason why the hosts cannot be created on this machine; empty: they can.
  static std::string why_not();

  /// Throws std::runtime_error, naming the failed command.
  explicit TwoHosts(const Network& network);
  ~TwoHosts();
  TwoHosts(const TwoHosts&) = delete;
  TwoHosts& operator=(const TwoHosts&) = delete;

  /// Command that runs `words` on a host.
  static std::vector<std::string> command_on(const std::string& name_space, const std::vector<std::string>& words);
  std::vector<std::string> on_a(const std::vector<std::string>& words) const { return command_on(a_, words); }
  std::vector<std::string> on_b(const std::vector<std::string>& words) const { return command_on(b_, words); }

  const std::string& address_of_a() const noexcept { return address_of_a_; }

  /// Number of lost and of all packets, as text; only for a network with losses.
  std::string say_losses();

 private:
  void join(const std::string& one, const std::string& one_interface, const std::string& other,
            const std::string& other_interface) const;
  void give_address(const std::string& host, const std::string& interface, const std::string& address) const;
  void make_one_subnet();
  void make_two_subnets();

  const Network network_;
  const std::string a_, b_, between_;
  std::string address_of_a_;
  std::unique_ptr<Process> link_;
};

}  // namespace panvo::test
