// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "process.hpp"

namespace panvo::test {

/// Two hosts with a network between them, made of network namespaces; each has a /dev/shm of its own. They go with this object.
class TwoHosts {
 public:
  struct Network {
    bool routed = false;  ///< two subnets with a router between them, which multicast does not pass; else one
    double loss = 0;      ///< share of packets that get lost; one subnet only
    int mtu = 1400;
  };

  /// Why this machine cannot have such hosts; empty: it can.
  static std::string why_not();

  /// Throws std::runtime_error with the command that failed.
  explicit TwoHosts(const Network& network);
  ~TwoHosts();
  TwoHosts(const TwoHosts&) = delete;
  TwoHosts& operator=(const TwoHosts&) = delete;

  /// The command line that runs `words` on host 'a' or 'b'.
  static std::vector<std::string> command_on(const std::string& name_space, const std::vector<std::string>& words);
  std::vector<std::string> on_a(const std::vector<std::string>& words) const { return command_on(a_, words); }
  std::vector<std::string> on_b(const std::vector<std::string>& words) const { return command_on(b_, words); }

  const std::string& address_of_a() const noexcept { return address_of_a_; }

  /// How many packets the network has carried and lost; only where it was made to lose some.
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
