// SPDX-License-Identifier: Apache-2.0
#include "two_hosts.hpp"

#include <sys/types.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <stdexcept>

namespace panvo::test {
namespace {

using Words = std::vector<std::string>;

void ip(const Words& arguments) {
  Words words{find_program("ip")};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const Finished finished = run(words);
  if (finished.status == 0) return;
  std::string command;
  for (const auto& word : words) command += word + " ";
  throw std::runtime_error(command + "failed: " + finished.output);
}

std::string host_name(const char* which) { return "panvo_" + std::to_string(getpid()) + "_" + which; }

/// Names of the interfaces, equal on all hosts.
constexpr const char *kInterface = "net0", *kOtherInterface = "net1";

}  // namespace

std::string TwoHosts::why_not() {
  if (find_program("ip").empty()) return "the program ip is not installed (package iproute2)";
  if (geteuid() != 0) return "network namespaces need root";
  const Words make{find_program("ip"), "netns", "add", host_name("try")};
  if (const Finished made = run(make); made.status != 0) return "cannot create a network namespace: " + made.output;
  const Finished joined = run({find_program("ip"), "-n", host_name("try"), "link", "add", kInterface, "type", "veth",
                               "peer", "name", kOtherInterface});
  ip({"netns", "del", host_name("try")});
  return joined.status == 0 ? "" : "no virtual network can be made: " + joined.output;
}

TwoHosts::TwoHosts(const Network& network)
    : network_(network), a_(host_name("a")), b_(host_name("b")), between_(host_name("between")) {
  for (const auto& name : {a_, b_, between_}) {
    ip({"netns", "add", name});
    std::filesystem::create_directory("/dev/shm/" + name);
    ip({"-n", name, "link", "set", "lo", "up"});
  }
  network.routed ? make_two_subnets() : make_one_subnet();
}

TwoHosts::~TwoHosts() {
  link_.reset();
  for (const auto& name : {a_, b_, between_}) {
    run({find_program("ip"), "netns", "del", name});
    std::filesystem::remove_all("/dev/shm/" + name);
  }
}

void TwoHosts::join(const std::string& one, const std::string& one_interface, const std::string& other,
                    const std::string& other_interface) const {
  const std::string mtu = std::to_string(network_.mtu);
  ip({"link", "add", one_interface, "mtu", mtu, "netns", one, "type", "veth", "peer", "name", other_interface, "mtu",
      mtu, "netns", other});
  ip({"-n", one, "link", "set", one_interface, "up"});
  ip({"-n", other, "link", "set", other_interface, "up"});
}

void TwoHosts::give_address(const std::string& host, const std::string& interface, const std::string& address) const {
  ip({"-n", host, "address", "add", address + "/24", "dev", interface});
}

void TwoHosts::make_one_subnet() {
  address_of_a_ = "10.77.0.1";
  if (network_.loss > 0) {
    join(a_, kInterface, between_, kInterface);
    join(b_, kInterface, between_, kOtherInterface);
    link_ = std::make_unique<Process>(
        command_on(between_, {LOSSY_LINK, kInterface, kOtherInterface, std::to_string(network_.loss)}));
    if (!eventually([this] { return link_->output().starts_with("ready"); })) {
      throw std::runtime_error("the lossy network does not start: " + link_->output());
    }
  } else {
    join(a_, kInterface, b_, kInterface);
  }
  give_address(a_, kInterface, address_of_a_);
  give_address(b_, kInterface, "10.77.0.2");
  for (const auto& host : {a_, b_}) ip({"-n", host, "route", "add", "239.0.0.0/8", "dev", kInterface});
}

void TwoHosts::make_two_subnets() {
  address_of_a_ = "10.77.1.2";
  join(a_, kInterface, between_, kInterface);
  join(b_, kInterface, between_, kOtherInterface);
  give_address(a_, kInterface, address_of_a_);
  give_address(between_, kInterface, "10.77.1.1");
  give_address(b_, kInterface, "10.77.2.2");
  give_address(between_, kOtherInterface, "10.77.2.1");
  ip({"-n", a_, "route", "add", "default", "via", "10.77.1.1"});
  ip({"-n", b_, "route", "add", "default", "via", "10.77.2.1"});
  ip({"netns", "exec", between_, "sh", "-c", "echo 1 > /proc/sys/net/ipv4/ip_forward"});
}

Words TwoHosts::command_on(const std::string& name_space, const Words& words) {
  const std::string begin = "mount --bind /dev/shm/" + name_space + " /dev/shm && exec \"$@\"";
  Words command{find_program("ip"), "netns", "exec", name_space, "sh", "-c", begin, "sh"};
  command.insert(command.end(), words.begin(), words.end());
  return command;
}

std::string TwoHosts::say_losses() {
  link_->signal(SIGTERM);
  link_->wait();
  return link_->output();
}

}  // namespace panvo::test
